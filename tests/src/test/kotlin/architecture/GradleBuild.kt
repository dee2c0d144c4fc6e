package stillwater.architecture

import java.io.File
import java.util.Properties

/** Gradle asks for it by name; Maven's surefire brings its own. */
private const val TEST_LAUNCHER = "testRuntimeOnly(libs.junit.launcher)"

private val includedModule = Regex("""":([\w-]+)"""")
private val dependencyBlock = Regex("""(?ms)^dependencies \{\n(.*?)^}""")
private val dependencyLine = Regex("""(\w+)\((?:libs\.([\w.]+)|project\(":([\w-]+)"\))\)""")

/** What the settings script, the catalogue, gradle.properties and the modules' scripts say, read from [root]. */
internal fun gradleBuild(root: File): BuildFacts {
    val catalogue = VersionCatalogue(root.resolve("gradle/libs.versions.toml").readText())
    val properties = Properties().apply { root.resolve("gradle.properties").reader().use(::load) }
    val settings = root.resolve("settings.gradle.kts").readText()
    return BuildFacts(
        projectVersion = properties.getProperty("version"),
        versions = catalogue.versions,
        modules =
        includedModule.findAll(settings).map { it.groupValues[1] }.associateWith { module ->
            dependenciesOf(root.resolve("$module/build.gradle.kts").readText(), catalogue)
        },
    )
}

/** The dependencies of one build script; a line that is not understood is an error, not nothing. */
internal fun dependenciesOf(script: String, catalogue: VersionCatalogue): Set<Dependency> {
    val block = checkNotNull(dependencyBlock.find(script)) { "no dependencies block" }
    return block.groupValues[1]
        .lines()
        .map { it.substringBefore("//").trim() }
        .filter { it.isNotEmpty() && it != TEST_LAUNCHER }
        .map { line ->
            val match = checkNotNull(dependencyLine.matchEntire(line)) { "not understood: $line" }
            val (configuration, accessor, module) = match.destructured
            val scope = Scope.entries.single { configuration in it.gradle }
            if (module.isEmpty()) catalogue.dependency(accessor, scope) else Dependency("module $module", scope, null)
        }.toSet()
}

/** A version catalogue, of TOML's many ways to write one only ours: one line an entry. */
internal class VersionCatalogue(toml: String) {
    val versions: Map<String, String>
    private val libraries: Map<String, Pair<String, String>>

    init {
        val versions = mutableMapOf<String, String>()
        val libraries = mutableMapOf<String, Pair<String, String>>()
        var section = ""
        for (line in toml.lines().map { it.trim() }.filter { it.isNotEmpty() && !it.startsWith("#") }) {
            val header = sectionLine.matchEntire(line)
            when {
                header != null -> section = header.groupValues[1]
                section == "versions" -> read(versionLine, line).let { (name, version) -> versions[name] = version }
                section == "libraries" ->
                    read(libraryLine, line).let { (alias, name, version) ->
                        libraries[alias.replace('-', '.')] = name to version
                    }
                else -> check(section == "plugins") { "section [$section] not understood" }
            }
        }
        this.versions = versions
        this.libraries = libraries
    }

    /** The library that a script names `libs.<accessor>`. */
    fun dependency(accessor: String, scope: Scope): Dependency {
        val (name, version) = checkNotNull(libraries[accessor]) { "libs.$accessor is not in the catalogue" }
        return Dependency(name, scope, version)
    }

    private fun read(pattern: Regex, line: String): MatchResult.Destructured =
        checkNotNull(pattern.matchEntire(line)) { "not understood: $line" }.destructured

    private companion object {
        val sectionLine = Regex("""\[([\w-]+)]""")
        val versionLine = Regex("""([\w-]+) = "([^"]+)"""")
        val libraryLine = Regex("""([\w-]+) = \{ module = "([^"]+)", version\.ref = "([^"]+)" }""")
    }
}
