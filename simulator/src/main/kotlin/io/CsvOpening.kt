package stillwater.io

import de.siegmar.fastcsv.reader.CsvParseException
import de.siegmar.fastcsv.reader.CsvReader
import de.siegmar.fastcsv.reader.CsvRecord
import java.util.Locale

/** Finds out how a log that is a table is written, and what is where in it. */
internal object CsvOpening {
    /**
     * The log [content] as [choice] wants it.
     *
     * @throws LogProblem if it is no table, or [choice] does not fit it.
     */
    fun open(content: LogContent, choice: LogChoice): CsvSurvey {
        val header = content.seaBird ?: return ofTable(content, choice)
        val short = header.short(choice)
        val timed = short.time?.let { content.timedBy(it) } ?: content
        if (short.time == null && timed.seaBird?.clock == null) {
            throw LogProblem(
                content.file,
                header.endLine.toLong(),
                null,
                "a column timeS, timeM, timeH, timeK, timeQ or, with a start_time, timeJ; or an interval in seconds",
                header.names.joinToString(", "),
            )
        }
        val clock = timed.seaBird?.clock
        val isTimed = timed !== content || clock?.name == short.time
        if (choice.timeUnit != null && (isTimed || short.time == null)) {
            val expected = "no --time-unit, for a Sea-Bird file states its own (${clock?.note})"
            val found = "--time-unit ${choice.timeUnit.flag}"
            throw LogProblem(content.file, header.endLine.toLong(), null, expected, found)
        }
        return ofTable(timed, if (isTimed) short.copy(time = null) else short)
    }

    private fun ofTable(content: LogContent, choice: LogChoice): CsvSurvey {
        if (choice.maxPoseAge != null) {
            val found = "a table, in which each reading has its place"
            throw LogProblem(content.file, null, null, "a Platypus log for --max-pose-age", found)
        }
        val layout = CsvLayout.of(content, choice.named)
        val line = content.head[layout.headerLine - 1]
        fun problem(column: String?, expected: String, found: String) =
            LogProblem(content.file, layout.headerLine.toLong(), column, expected, found)

        val header = fields(layout.header, layout.separator)
            ?: throw problem(null, "a header line with column names", quoted(line))
        if ('\uFFFD' in line) throw problem(null, "text in UTF-8 or Windows-1252", "another encoding")
        if (2 * header.count { !DecimalText.parse(it).isNaN() } > header.size) {
            throw problem(null, "a header line with column names", quoted(line))
        }
        header.indexOfFirst { name -> name.any { it.isISOControl() } }.takeIf { it >= 0 }?.let { index ->
            val code = header[index].first { it.isISOControl() }.code
            val found = "U+%04X in the name of column %d".format(Locale.ROOT, code, index + 1)
            throw problem(null, "a header without control characters", found)
        }
        val columns = CsvColumns.of(CsvColumns.distinct(header), layout, choice, ::problem)
        CsvUnits(content, layout, columns.names).check(columns, choice.x != null)
        val times = CsvTimes.of(content, layout, columns, choice).rounded(layout, columns, content.seaBird?.clock)
        return CsvSurvey(content, layout, columns, times, choice.skipBadRows, choice.keepsUnread)
    }

    private fun fields(line: String, separator: Char): List<String>? = try {
        CsvReader.builder().fieldSeparator(separator).ofSingleCsvRecord(line)
            .let { record: CsvRecord -> record.fields.map { it.trim() } }
    } catch (_: CsvParseException) {
        null
    }
}
