package stillwater.architecture

import org.w3c.dom.Element
import java.io.File
import javax.xml.parsers.DocumentBuilderFactory

private const val VERSION_SUFFIX = ".version"
private const val OWN_GROUP = "stillwater"

/** Packaging of a module without code; type of a dependency on nothing but the module's being built. */
private const val POM = "pom"

/** The Kotlin plug-in adds it to a Gradle module unasked. */
private const val STANDARD_LIBRARY = "org.jetbrains.kotlin:kotlin-stdlib"

/**
 * What pom.xml and the modules' pom.xml say; all files are read from [root].
 *
 * Modules and dependencies of type pom are left out: there is no code in the ones, the others put nothing on a class
 * path and only say what is built before what, which Gradle has no need of.
 */
internal fun mavenBuild(root: File): BuildFacts {
    val parent = pom(root.resolve("pom.xml"))
    val bills = parent.child("dependencyManagement").child("dependencies").children("dependency")
    val shared = parent.dependencies(bills)
    return BuildFacts(
        projectVersion = parent.text("version"),
        versions = pomVersions(root.resolve("pom.xml")),
        modules =
        modulePoms(root)
            .filterValues { it.optionalText("packaging") != POM }
            .mapValues { (_, own) ->
                (shared + own.dependencies(bills)).filter { it.name != STANDARD_LIBRARY }.toSet()
            },
    )
}

/** Which modules wait for which in Maven's build, by all that they depend on, directly or through others. */
internal fun mavenOrder(root: File): Map<String, Set<String>> {
    val direct =
        modulePoms(root).mapValues { (_, own) ->
            own
                .child("dependencies")
                .children("dependency")
                .filter { it.text("groupId") == OWN_GROUP }
                .map { it.text("artifactId") }
        }

    fun waitsFor(module: String): Set<String> = direct.getValue(module).flatMap { waitsFor(it) + it }.toSet()

    return direct.mapValues { (module, _) -> waitsFor(module) }
}

private fun modulePoms(root: File): Map<String, Element> {
    val parent = pom(root.resolve("pom.xml"))
    return parent.child("modules").children("module").associate { module ->
        val name = module.textContent.trim()
        val own = pom(root.resolve("$name/pom.xml"))
        val ownParent = own.child("parent").text("version")
        check(ownParent == parent.text("version")) { "$name/pom.xml: parent's version is $ownParent" }
        name to own
    }
}

/** The properties of a pom that are named `<library>.version`, by library. */
internal fun pomVersions(file: File): Map<String, String> =
    pom(file)
        .child("properties")
        ?.children()
        .orEmpty()
        .filter { it.tagName.endsWith(VERSION_SUFFIX) }
        .associate { it.tagName.removeSuffix(VERSION_SUFFIX) to it.textContent.trim() }

private fun pom(file: File): Element =
    DocumentBuilderFactory
        .newInstance()
        .newDocumentBuilder()
        .parse(file)
        .documentElement

private fun Element.dependencies(bills: List<Element>): Set<Dependency> =
    child("dependencies")
        .children("dependency")
        .filter { it.optionalText("type") != POM }
        .map { it.dependency(bills) }
        .toSet()

private fun Element.dependency(bills: List<Element>): Dependency {
    val (group, artifact) = text("groupId") to text("artifactId")
    val mavenScope = optionalText("scope") ?: "compile"
    val scope = Scope.entries.single { it.maven == mavenScope }
    if (group == OWN_GROUP) return Dependency("module $artifact", scope, version = null)
    // Without a version of its own it has that of the bill of materials for its family: kotlinx-serialization-bom's
    // for kotlinx-serialization-json.
    val version = optionalText("version") ?: bills.single { artifact.startsWith(it.family()) }.text("version")
    return Dependency("$group:$artifact", scope, version.removePrefix("\${").removeSuffix("$VERSION_SUFFIX}"))
}

private fun Element.family(): String = text("artifactId").removeSuffix("bom")

private fun Element.children(): List<Element> =
    (0 until childNodes.length).mapNotNull { childNodes.item(it) as? Element }

private fun Element?.children(tag: String): List<Element> = this?.children().orEmpty().filter { it.tagName == tag }

private fun Element?.child(tag: String): Element? = children(tag).singleOrNull()

private fun Element?.optionalText(tag: String): String? = child(tag)?.textContent?.trim()

private fun Element?.text(tag: String): String = checkNotNull(optionalText(tag)) { "no <$tag> in <${this?.tagName}>" }
