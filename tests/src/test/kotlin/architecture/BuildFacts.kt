package stillwater.architecture

/** A library that a module is built with; [version] is the name of a version both builds define, null for a module. */
internal data class Dependency(val name: String, val scope: Scope, val version: String?) {
    override fun toString(): String = "$name ($scope${version?.let { ", version $it" } ?: ""})"
}

/** Who sees a dependency: the names that the two builds have for one thing. */
internal enum class Scope(val maven: String, val gradle: Set<String>) {
    MAIN("compile", setOf("api", "implementation")),
    COMPILE_ONLY("provided", setOf("compileOnly")),
    RUNTIME("runtime", setOf("runtimeOnly")),
    TEST("test", setOf("testImplementation")),
    ;

    override fun toString(): String = name.lowercase().replace('_', ' ')
}

/**
 * What one of the two builds says.
 *
 * @property projectVersion of every module.
 * @property versions of libraries and plug-ins, by name.
 * @property modules with their dependencies.
 */
internal data class BuildFacts(
    val projectVersion: String,
    val versions: Map<String, String>,
    val modules: Map<String, Set<Dependency>>,
)

/** One line for each thing that the Maven and the Gradle build say differently. */
internal fun differences(maven: BuildFacts, gradle: BuildFacts): List<String> =
    buildList {
        if (maven.projectVersion != gradle.projectVersion) {
            add("project version: Maven ${maven.projectVersion}, Gradle ${gradle.projectVersion}")
        }
        for (name in (maven.versions.keys + gradle.versions.keys).sorted()) {
            val (inMaven, inGradle) = maven.versions[name] to gradle.versions[name]
            if (inMaven != inGradle) add("version $name: Maven ${inMaven ?: "none"}, Gradle ${inGradle ?: "none"}")
        }
        for (module in (maven.modules.keys + gradle.modules.keys).sorted()) {
            val (inMaven, inGradle) = maven.modules[module] to gradle.modules[module]
            when {
                inMaven == null -> add("module $module: in the Gradle build only")
                inGradle == null -> add("module $module: in the Maven build only")
                else -> {
                    (inMaven - inGradle).forEach { add("$module: $it: in pom.xml, not so in build.gradle.kts") }
                    (inGradle - inMaven).forEach { add("$module: $it: in build.gradle.kts, not so in pom.xml") }
                }
            }
        }
    }
