package stillwater.architecture

import org.junit.jupiter.api.Test
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

/** Two builds of one project stay one project only while something compares them. */
class BuildParityTest {
    private val maven = mavenBuild(Repository.root)
    private val gradle = gradleBuild(Repository.root)

    /** Where the app's two builds cannot be the same, and why. */
    private val androidsOwn =
        mapOf(
            "version android-gradle-plugin: Maven none, Gradle 9.5.0" to
                "Maven has the plug-in's tools one by one",
            "android-app: org.robolectric:android-all (compile only, version android-all): " +
                "in pom.xml, not so in build.gradle.kts" to
                "Gradle has the Android SDK",
            "android-app: com.github.mik3y:usb-serial-for-android (main, version usb-serial-for-android): " +
                "in build.gradle.kts, not so in pom.xml" to
                "not in the repositories that Maven asks; src/usb-serial declares what is called of it",
        )

    @Test
    fun mavenAndGradleSayTheSame() {
        val found = differences(maven, gradle)
        val unexpected = found - androidsOwn.keys
        assertTrue(unexpected.isEmpty(), unexpected.joinToString("\n", prefix = "The two builds differ:\n"))
        assertEquals(emptySet(), androidsOwn.keys - found.toSet(), "said to differ, and do not")
    }

    @Test
    fun bothBuildTheAppForTheSameAndroids() {
        val pom = Repository.text("android-app/pom.xml")
        val script = Repository.text("android-app/build.gradle.kts")
        val pairs =
            mapOf("min.sdk" to "minSdk", "target.sdk" to "targetSdk", "version.code" to "versionCode") +
                mapOf("application.id" to "applicationId")
        for ((property, name) in pairs) {
            val inMaven = pom.substringAfter("<$property>").substringBefore("</$property>")
            val inGradle = script.substringAfter(" $name = ").substringBefore("\n").trim('"')
            assertEquals(inMaven, inGradle, "$property in android-app/pom.xml, $name in its build.gradle.kts")
        }
    }

    @Test
    fun theGradleCheckCompilesWithTheProjectsKotlin() {
        val check = pomVersions(Repository.file("gradle/check/pom.xml"))
        assertEquals(maven.versions["kotlin"], check["kotlin"], "kotlin.version in gradle/check/pom.xml")
        assertTrue(
            "gradle-${check["gradle"]}-bin.zip" in Repository.text("gradle/wrapper/gradle-wrapper.properties"),
            "the wrapper is not the one gradle/check/pom.xml writes: Gradle ${check["gradle"]}",
        )
    }

    @Test
    fun whatTestsLookAtIsBuiltBeforeAndStyleHidesNone() {
        val order = mavenOrder(Repository.root)
        // Modules are built side by side, and ApkTest, PackagerTest and PhoneLogTest look into android-app/target.
        assertEquals(setOf("core", "simulator", "android-app"), order["tests"])
        // A module that fails stops those that wait for it, also with --fail-at-end.
        assertTrue(order.none { (_, before) -> "style" in before }, "waits for style: $order")
        val classPath = maven.modules.getValue("tests").map { it.name }
        assertTrue("module android-app" !in classPath, "the app on the tests' class path")
    }

    @Test
    fun theBuildsAreReallyRead() {
        // Guards the two readers: a comparison of nothing with nothing would pass.
        assertTrue(
            maven.modules.keys.containsAll(listOf("core", "simulator", "tests")),
            "modules ${maven.modules.keys}",
        )
        assertEquals("2.4.10", maven.versions["kotlin"])
        val json = Dependency("org.jetbrains.kotlinx:kotlinx-serialization-json", Scope.MAIN, "kotlinx-serialization")
        assertTrue(json in maven.modules.getValue("core"), "core's dependencies ${maven.modules["core"]}")
        assertTrue(Dependency("module core", Scope.TEST, null) in gradle.modules.getValue("tests"))
    }

    @Test
    fun everyKindOfDifferenceIsNamed() {
        val library = Dependency("a:b", Scope.MAIN, "b")
        val one = BuildFacts("1", mapOf("x" to "1", "y" to "1"), mapOf("core" to setOf(library), "app" to emptySet()))
        val other =
            BuildFacts(
                "2",
                mapOf("x" to "2", "z" to "1"),
                mapOf("core" to setOf(library.copy(scope = Scope.TEST)), "tool" to emptySet()),
            )
        assertEquals(
            listOf(
                "project version: Maven 1, Gradle 2",
                "version x: Maven 1, Gradle 2",
                "version y: Maven 1, Gradle none",
                "version z: Maven none, Gradle 1",
                "module app: in the Maven build only",
                "core: a:b (main, version b): in pom.xml, not so in build.gradle.kts",
                "core: a:b (test, version b): in build.gradle.kts, not so in pom.xml",
                "module tool: in the Gradle build only",
            ),
            differences(one, other),
        )
        assertTrue(differences(one, one).isEmpty())
    }

    @Test
    fun aLineThatIsNotUnderstoodIsAnError() {
        val catalogue =
            VersionCatalogue("[versions]\nb = \"1\"\n[libraries]\nb = { module = \"a:b\", version.ref = \"b\" }")
        val understood = "dependencies {\n    api(libs.b) // why\n}"
        assertEquals(setOf(Dependency("a:b", Scope.MAIN, "b")), dependenciesOf(understood, catalogue))
        listOf("api(\"a:b:1\")", "api(libs.c)", "api(libs.b) { isTransitive = false }").forEach { line ->
            assertFailsWith<IllegalStateException>(line) { dependenciesOf("dependencies {\n    $line\n}", catalogue) }
        }
        assertFailsWith<IllegalStateException> { VersionCatalogue("[libraries]\nb = \"a:b:1\"") }
    }
}
