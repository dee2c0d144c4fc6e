package stillwater.correct

import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonArray
import kotlinx.serialization.json.JsonElement
import stillwater.io.AnnotatedLog
import stillwater.report.OutputDirectory

/**
 * Writes the corrections of one log: corrected.csv for all of its quantities, and the other files of each.
 *
 * @param parts one for each quantity, at least one.
 */
class CorrectOutput(private val parts: List<CorrectFiles>) {
    private var drawing = emptyList<List<String>>()

    /** Writes all files into [directory], which the caller commits. */
    fun write(directory: OutputDirectory) {
        val log = AnnotatedLog(parts.map { it.addedColumns() })
        val others = directory.stream("corrected.csv") { log.write(it) }
        drawing = parts.mapIndexed { i, part -> part.write(directory, others[i]) }
    }

    /** The summary for machines: an object, or a list of one for each quantity where there are several. */
    fun json(): String {
        val each = parts.mapIndexed { i, part -> part.summaryJson(drawing[i]) }
        return FORMAT.encodeToString(JsonElement.serializer(), each.singleOrNull() ?: JsonArray(each))
    }

    /** Lines for the terminal. */
    fun lines(): List<String> = parts.singleOrNull()?.lines()
        ?: parts.flatMap { part -> listOf("${part.quantity}, as ${part.columns[0]}") + part.lines().map { "  $it" } }

    /** Warnings for the user, one line each. */
    val warnings: List<String>
        get() = parts.flatMapIndexed { i, part ->
            (part.warnings + drawing[i]).map { if (parts.size == 1) it else "${part.quantity}: $it" }
        }

    private companion object {
        val FORMAT = Json { prettyPrint = true }
    }
}
