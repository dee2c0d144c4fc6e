package stillwater.architecture

import java.io.File

/** The checkout that the tests run in. */
internal object Repository {
    val root: File =
        generateSequence(File("").absoluteFile) { it.parentFile }
            .first { it.resolve("settings.gradle.kts").isFile }

    fun file(path: String): File = root.resolve(path)

    fun text(path: String): String = file(path).readText()
}

/**
 * One Kotlin source.
 *
 * @property path from the repository's root, for messages.
 * @property directory from the source root, "" for the source root itself.
 * @property text as it stands in the file.
 */
internal class KotlinSource(val path: String, val directory: String, val text: String) {
    /** The text without comments and the contents of strings; line breaks stay, and with them the line numbers. */
    val code: String by lazy { notCode.replace(text) { match -> "\n".repeat(match.value.count { it == '\n' }) } }

    /** The package as the file declares it, null where it declares none. */
    val packageName: String? by lazy { packageLine.find(code)?.groupValues?.get(1) }

    /** The 1-based line of an index into [code]. */
    fun lineOf(index: Int): Int = code.substring(0, index).count { it == '\n' } + 1

    companion object {
        private val packageLine = Regex("""(?m)^package ([\w.]+)""")
        private val notCode =
            Regex(
                listOf(
                    "\"\"\"[\\s\\S]*?\"\"\"",
                    """"(?:\\.|[^"\\\n])*"""",
                    """'(?:\\.|[^'\\\n])+'""",
                    """/\*[\s\S]*?\*/""",
                    """//[^\n]*""",
                ).joinToString("|"),
            )

        /** The sources of one module: its main ones, its test ones, or those of any other source root in it. */
        fun of(module: String, sourceSet: String): List<KotlinSource> {
            val sourceRoot = Repository.file("$module/src/$sourceSet/kotlin")
            return sourceRoot
                .walkTopDown()
                .filter { it.isFile && it.extension == "kt" }
                .sorted()
                .map { file ->
                    KotlinSource(
                        path = file.relativeTo(Repository.root).invariantSeparatorsPath,
                        directory = file.parentFile.relativeTo(sourceRoot).invariantSeparatorsPath,
                        text = file.readText(),
                    )
                }.toList()
        }
    }
}
