package stillwater.apk

import org.junit.jupiter.api.io.TempDir
import java.io.File
import java.util.zip.ZipEntry
import java.util.zip.ZipFile
import java.util.zip.ZipOutputStream
import javax.tools.ToolProvider
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertNotEquals
import kotlin.test.assertNull
import kotlin.test.assertTrue

/** The packager on made-up jars: what a library brings for the run time, and what nothing leads to. */
class PackagerTest {
    @TempDir
    private lateinit var directory: File

    @Test
    fun serviceListsAreJoinedResourcesComeAlongAndWhatNothingLeadsToStaysOut() {
        val app = compile(
            "app",
            "Main" to "class Main { Object part = new Used(); }",
            "Used" to "class Used {}",
        )
        val files = mapOf(SERVICE to "One\n", "words/one.txt" to "one", "META-INF/LICENSE" to "mine")
        val first = jar("first", files, "One", "Idle")
        val second = jar("second", mapOf(SERVICE to "Two # the other\n"), "Two")
        assertEquals(0, packaged(app, first, second).first)
        ZipFile(apk).use { zip ->
            fun text(name: String) = zip.getEntry(name)?.let { zip.getInputStream(it).reader().readText() }
            assertEquals(listOf("One", "Two # the other"), text(SERVICE)?.lines()?.filter { it.isNotBlank() })
            assertEquals("one", text("words/one.txt"))
            assertNull(text("META-INF/LICENSE"), "for people, not for the phone")
            val dex = String(zip.getInputStream(zip.getEntry("classes.dex")).readBytes(), Charsets.ISO_8859_1)
            for (name in listOf("LMain;", "LUsed;", "LOne;", "LTwo;")) assertTrue(name in dex, name)
            assertTrue("LIdle;" !in dex, "nothing leads to it")
        }
    }

    @Test
    fun aClassThatIsNowhereAndTwoContentsOfOneNameFail() {
        val app = compile("app", "Main" to "class Main { Object part = new Gone(); }", "Gone" to "class Gone {}")
        app.resolve("Gone.class").delete()
        val (status, said) = packaged(app)
        assertNotEquals(0, status)
        assertTrue("classes that are nowhere, and who names them: {Gone=Main}" in said, said)
        val whole = compile("whole", "Main" to "class Main {}")
        val (other, told) = packaged(
            whole,
            jar("first", mapOf("words/one.txt" to "one")),
            jar("second", mapOf("words/one.txt" to "two")),
        )
        assertNotEquals(0, other)
        assertTrue("two jars have different contents for words/one.txt" in told, told)
        assertTrue(!apk.exists(), "no APK is left that somebody might install")
    }

    private val apk get() = directory.resolve("made.apk")

    /** Runs the packager as the build does; its exit status, and what it said. */
    private fun packaged(vararg program: File): Pair<Int, String> {
        val target = Built.app.resolve("target")
        val resources = Built.existing(target.resolve("resources.apk"), "`mvn package`")
        val key = Built.existing(target.resolve("debug.p12"), "`mvn package`")
        val tools = listOf("com/android/tools/r8", "com/android/tools/build/apksig").map(::library)
        val android = library("org/robolectric/android-all")
        val process = ProcessBuilder(
            File(System.getProperty("java.home"), "bin/java").path, "-XX:TieredStopAtLevel=1",
            "-cp", tools.joinToString(File.pathSeparator),
            Built.app.resolve("packaging/PackageApk.java").path,
            resources.path, apk.path, "26", android.path, key.path, program.joinToString(File.pathSeparator),
        ).redirectErrorStream(true).start()
        val said = process.inputStream.bufferedReader().readText()
        return process.waitFor() to said
    }

    /**
     * The jar of an artifact in the repository that the tests' own libraries are in; the newest, as the build has one.
     */
    private fun library(artifact: String): File {
        val kotlin = KotlinVersion::class.java.protectionDomain.codeSource.location
        val path = File(kotlin.toURI()).invariantSeparatorsPath
        val folder = File(path.substringBefore("/org/jetbrains/kotlin/"), artifact)
        val jars = folder.walk().filter { it.extension == "jar" && "sources" !in it.name && "javadoc" !in it.name }
        return Built.existing(jars.maxByOrNull { it.parentFile.name } ?: folder.resolve("jar"), "`mvn package`")
    }

    /** A folder with the classes of [sources], each a name and its text. */
    private fun compile(name: String, vararg sources: Pair<String, String>): File {
        val folder = directory.resolve(name).apply { mkdirs() }
        val files = sources.map { (type, text) -> folder.resolve("$type.java").apply { writeText(text) }.path }
        val compiler = ToolProvider.getSystemJavaCompiler()
        val status = compiler.run(null, null, null, "--release", "17", "-d", folder.path, *files.toTypedArray())
        assertEquals(0, status)
        files.forEach { File(it).delete() }
        return folder
    }

    /** A jar with [files] and empty classes [types]. */
    private fun jar(name: String, files: Map<String, String>, vararg types: String): File {
        val classes = types.map { compile("$name-$it", it to "class $it {}").resolve("$it.class") }
        val all = files.mapValues { it.value.toByteArray() } + classes.associate { it.name to it.readBytes() }
        return directory.resolve("$name.jar").apply {
            ZipOutputStream(outputStream()).use { zip ->
                for ((path, bytes) in all) {
                    zip.putNextEntry(ZipEntry(path))
                    zip.write(bytes)
                }
            }
        }
    }

    private companion object {
        const val SERVICE = "META-INF/services/stillwater.Part"
    }
}
