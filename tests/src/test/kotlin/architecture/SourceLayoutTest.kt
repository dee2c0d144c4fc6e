package stillwater.architecture

import org.junit.jupiter.api.Test
import kotlin.test.assertEquals
import kotlin.test.assertNull
import kotlin.test.assertTrue

/** Rules for every source of every module: small files, and a package that says where the file is. */
class SourceLayoutTest {
    private val sources =
        mavenBuild(Repository.root).modules.keys.flatMap { KotlinSource.of(it, "main") + KotlinSource.of(it, "test") }

    @Test
    fun noFileIsAboveTheLimit() {
        val found = sources.filter { lines(it.text) > LINES }.map { "${it.path}: ${lines(it.text)} lines" }
        assertTrue(found.isEmpty(), found.joinToString("\n", prefix = "At most $LINES lines a file:\n"))
    }

    @Test
    fun packageIsTheDirectory() {
        val found = sources.mapNotNull(::misplaced)
        assertTrue(found.isEmpty(), found.joinToString("\n", prefix = "Directories leave the root package out:\n"))
    }

    /** One that is not, in the same process, has Kotlin ask for Android's version outside of any, and all after it fail. */
    @Test
    fun everyTestOfTheAppRunsInAnAndroid() {
        val tests = KotlinSource.of("android-app", "test").filter { "@Test" in it.code }
        val found = tests.filter { "@RunWith(RobolectricTestRunner::class)" !in it.code }.map { it.path }
        assertTrue(tests.size > 10 && found.isEmpty(), found.joinToString("\n"))
    }

    @Test
    fun aMisplacedFileIsFound() {
        assertEquals(
            "a/B.kt: package stillwater.plan, expected stillwater.model",
            misplaced(KotlinSource("a/B.kt", "model", "package stillwater.plan\n")),
        )
        assertEquals(
            "a/B.kt: package none, expected stillwater.model.grid",
            misplaced(KotlinSource("a/B.kt", "model/grid", "val x = 1")),
        )
        assertNull(misplaced(KotlinSource("a/B.kt", "model", "// package other\npackage stillwater.model\n")))
        assertEquals(2, lines("one\ntwo\n"))
    }

    private fun lines(text: String): Int = text.removeSuffix("\n").lines().size

    private fun misplaced(source: KotlinSource): String? {
        val expected = "stillwater.${source.directory.replace('/', '.')}".removeSuffix(".")
        return if (source.packageName == expected) {
            null
        } else {
            "${source.path}: package ${source.packageName ?: "none"}, expected $expected"
        }
    }

    private companion object {
        const val LINES = 400
    }
}
