package stillwater.architecture

import org.junit.jupiter.api.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** A document that names a test names one that is there: a table of evidence does not outlive what it points at. */
class NamedTestsTest {
    private val modules = mavenBuild(Repository.root).modules.keys
    private val tests = modules.flatMap { KotlinSource.of(it, "test") }.filter { it.path.endsWith("Test.kt") }
    private val functionsOf =
        tests.associate { source ->
            val name = source.path.substringAfterLast('/').removeSuffix(".kt")
            name to function.findAll(source.code).map { it.groupValues[1] }.toSet()
        }

    @Test
    fun everyTestThatADocumentNamesIsThere() {
        val folders = listOf("", "docs") + modules.map { "$it/docs" }
        val documents =
            folders.flatMap { Repository.file(it).listFiles().orEmpty().toList() }.filter { it.extension == "md" }
        val found = documents.flatMap { file -> missing(file.readText()).map { "${file.name}: $it" } }
        assertTrue(found.isEmpty(), found.joinToString("\n"))
        assertTrue(documents.sumOf { named(it.readText()).size } > 50, "names are found at all")
    }

    @Test
    fun eachOfTheFieldProblemsHasATestThatShowsIt() {
        val rows = Repository.text("docs/app.md").lines().filter { problem.containsMatchIn(it) }
        assertEquals((1..15).toList(), rows.map { problem.find(it)!!.groupValues[1].toInt() })
        for (row in rows) assertTrue(named(shownBy(row)).isNotEmpty(), row)
    }

    @Test
    fun aNameOfNothingIsFound() {
        val text = "see `NoSuchTest`, `NamedTestsTest.aNameOfNothingIsFound`, `NamedTestsTest.noSuchName`"
        assertEquals(listOf("NoSuchTest", "NamedTestsTest.noSuchName"), missing(text))
        val row = "| 3. A problem | `setParameters` is called | `NamedTestsTest.aNameOfNothingIsFound`, `andAnother` |"
        assertEquals(listOf("NamedTestsTest.andAnother"), missing(row))
    }

    private fun missing(text: String): List<String> =
        named(text).filter { (test, name) ->
            val functions = functionsOf[test]
            functions == null || (name != null && name !in functions)
        }.map { (test, name) -> listOfNotNull(test, name).joinToString(".") }

    /** Tests, with a function where one is named; in a table a function alone belongs to the test before it. */
    private fun named(text: String): List<Pair<String, String?>> =
        text.lines().flatMap { line ->
            var last: String? = null
            val cell = if (problem.containsMatchIn(line)) shownBy(line) else line
            quoted.findAll(cell).mapNotNull { match ->
                val (test, function, alone) = match.destructured
                if (test.isNotEmpty()) last = test
                when {
                    test.isNotEmpty() -> test to function.ifEmpty { null }
                    problem.containsMatchIn(line) -> last.orEmpty() to alone
                    else -> null
                }
            }.toList()
        }

    private fun shownBy(row: String) = row.trimEnd().removeSuffix("|").substringAfterLast('|')

    private companion object {
        val function = Regex("""\bfun (\w+)\(""")
        val problem = Regex("""^\| (\d+)\. """)
        val quoted = Regex("""`(?:([A-Z]\w*Test)(?:\.(\w+))?|([a-z]\w*))`""")
    }
}
