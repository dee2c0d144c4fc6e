package stillwater.docs

import stillwater.architecture.Repository
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Maven's commands on the pages, which nothing here can run: what is known to fail in a fresh clone. */
class MavenCommandsTest {
    /** In a module's directory Maven looks for the other modules where only `install` puts them. */
    @Test
    fun noneIsRunInTheDirectoryOfAModule() {
        val pages = listOf("README.md", "CONTRIBUTING.md", "docs", "core/docs").map(Repository::file)
            .flatMap { place -> place.walkTopDown().filter { it.extension == "md" }.toList() }
        val commands = pages.flatMap { page -> page.readLines().filter { "mvn " in it }.map { "${page.name}: $it" } }
        assertTrue(commands.size > 10, "$commands")
        assertEquals(emptyList(), commands.filter { Regex("""\bcd [\w-]+ && mvn """).containsMatchIn(it) })
    }
}
