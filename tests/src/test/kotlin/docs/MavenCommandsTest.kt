package stillwater.docs

import java.io.File
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Maven's commands on the pages, which nothing here can run: what is known to fail in a fresh clone. */
class MavenCommandsTest {
    private val root =
        generateSequence(File("").absoluteFile) { it.parentFile }.first { it.resolve("settings.gradle.kts").isFile }

    /** In a module's directory Maven looks for the other modules where only `install` puts them. */
    @Test
    fun noneIsRunInTheDirectoryOfAModule() {
        val pages = listOf(root, root.resolve("docs"), root.resolve("core/docs"))
            .flatMap { it.listFiles { file -> file.extension == "md" }.orEmpty().toList() }
        val commands = pages.flatMap { page -> page.readLines().filter { "mvn " in it }.map { "${page.name}: $it" } }
        assertTrue(commands.size > 10, "$commands")
        assertEquals(emptyList(), commands.filter { Regex("""\bcd [\w-]+ && mvn """).containsMatchIn(it) })
    }
}
