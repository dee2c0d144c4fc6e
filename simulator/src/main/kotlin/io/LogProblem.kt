package stillwater.io

import stillwater.report.counted
import java.nio.file.Path

/**
 * A log that cannot be used as it is: where, what was expected and what was found, in one line.
 *
 * @property file the log.
 * @property line physical line, counted from 1, or null where no single line is at fault.
 * @property column name of the column, or null where no single column is at fault.
 * @property expected what would have been right.
 * @property found what is there.
 * @property skippable reason under which `--skip-bad-rows` counts such rows, or null where skipping rows is no help.
 */
class LogProblem(
    val file: Path,
    val line: Long?,
    val column: String?,
    val expected: String,
    val found: String,
    val skippable: String? = null,
) : Exception(
    buildString {
        append(file)
        if (line != null) append(':').append(line)
        append(": ")
        if (column != null) append("column ").append(column).append(": ")
        append("expected ").append(expected).append(", found ").append(found)
        if (skippable != null) append(" (--skip-bad-rows skips and counts such rows)")
    },
)

/** [text] fit for a one-line message: in quotes, without control characters, cut to a readable length. */
internal fun quoted(text: String): String {
    if (text.isBlank()) return "nothing"
    if (text.all { it == '\u0000' }) return counted(text.length.toLong(), "zero byte")
    val clean = text.trim().map { if (it.isISOControl()) '?' else it }.joinToString("")
    return if (clean.length <= LONGEST_QUOTE) "'$clean'" else "'${clean.take(LONGEST_QUOTE)}...'"
}

/** Columns' [names] fit for a one-line message: long ones cut, and of very many the first. */
internal fun listed(names: List<String>): String {
    val more = if (names.size > MOST_NAMES) " and ${names.size - MOST_NAMES} more" else ""
    return names.take(MOST_NAMES).joinToString(", ") {
        if (it.length <= LONGEST_QUOTE) it else it.take(LONGEST_QUOTE) + "..."
    } + more
}

private const val LONGEST_QUOTE = 48
private const val MOST_NAMES = 100
