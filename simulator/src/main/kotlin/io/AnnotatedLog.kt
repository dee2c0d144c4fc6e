package stillwater.io

import de.siegmar.fastcsv.writer.CsvWriter
import de.siegmar.fastcsv.writer.LineDelimiter
import java.io.OutputStream
import java.io.OutputStreamWriter

/**
 * Writes a log again as CSV, byte for byte as it is, with some more columns behind its own.
 *
 * @param log the log. @param names the columns added. @param times times of the readings that [log] yields, s. Not
 * modified.
 */
internal class AnnotatedLog(
    private val log: SurveyLog,
    private val names: List<String>,
    private val times: DoubleArray,
    private val xs: DoubleArray,
    private val ys: DoubleArray,
    private val values: DoubleArray,
) {
    /**
     * Writes all rows to [out], which is closed; [cells] gives what is added to reading k, null for nothing. Logs
     * that are
     * not CSV get a row a reading with the columns time_s, x_m, y_m and the quantity.
     *
     * @return number of rows written that are no reading; their added cells are empty.
     */
    fun write(out: OutputStream, cells: (Int) -> List<String?>?): Long =
        if (log is CsvSurvey) csv(log, out, cells) else plain(out, cells)

    private fun plain(out: OutputStream, cells: (Int) -> List<String?>?): Long {
        writer(out).use { writer ->
            writer.writeRecord(listOf("time_s", "x_m", "y_m", log.quantity) + names)
            for (k in times.indices) {
                val own = listOf(times[k], xs[k], ys[k], values[k]).map { it.toString() }
                writer.writeRecord(own + (cells(k) ?: empty))
            }
        }
        return 0
    }

    private val empty = List<String?>(names.size) { null }

    /** All bytes of the log as they are, the added cells before the line ends. */
    private fun csv(survey: CsvSurvey, out: OutputStream, cells: (Int) -> List<String?>?): Long {
        var next = 0
        var other = 0L
        out.use {
            survey.content.raw { mark, text ->
                out.write(mark)
                val records = RawRecords(text, survey.content.charset, survey.separator)
                var width = NO_HEADER
                while (records.next()) {
                    val fields = records.fields
                    val added = when {
                        fields.all { it.isBlank() } -> emptyList()
                        width == NO_HEADER -> names.also { width = fields.size }
                        next < times.size && isRow(survey, fields, next) -> cells(next++) ?: empty
                        else -> {
                            other++
                            // A row of another width or a remark is not made wider: nothing in it would stand in place.
                            if (fields.size == width) empty else emptyList()
                        }
                    }
                    out.write(records.bytes(records.text))
                    for (cell in added) out.write(records.bytes(survey.separator + cell.orEmpty()))
                    out.write(records.bytes(records.lineEnd))
                }
            }
        }
        check(next == times.size) { "${times.size - next} readings of ${log.file} were not found again" }
        return other
    }

    private fun isRow(survey: CsvSurvey, fields: List<String>, k: Int): Boolean {
        val time = fields.getOrNull(survey.columns.time)?.let { DecimalText.parse(it) } ?: return false
        val value = fields.getOrNull(survey.columns.value)?.let { DecimalText.parse(it) } ?: return false
        return time == times[k] && value == values[k] && isPlace(survey.columns, fields, k)
    }

    /** Degrees are compared by being there only: a row left out for its place may be the next one's twin. */
    private fun isPlace(columns: CsvColumns, fields: List<String>, k: Int): Boolean {
        fun number(column: Int) = fields.getOrNull(column)?.let { DecimalText.parse(it) } ?: Double.NaN
        if (columns.latitude != CsvColumns.NONE) {
            val latitude = number(columns.latitude)
            val longitude = number(columns.longitude)
            return latitude.isFinite() && longitude.isFinite() && (latitude != 0.0 || longitude != 0.0)
        }
        return number(columns.x) == xs[k] && (columns.y == CsvColumns.NONE || number(columns.y) == ys[k])
    }

    private fun writer(out: OutputStream) =
        CsvWriter.builder().lineDelimiter(LineDelimiter.LF).build(OutputStreamWriter(out, Charsets.UTF_8))

    companion object {
        private const val NO_HEADER = -1

        /**
         * Refuses [log] if it has one of the columns that are to be added.
         *
         * @throws LogProblem if so.
         */
        fun requireNewNames(log: SurveyLog, names: List<String>) {
            val survey = log as? CsvSurvey ?: return
            val taken = names.firstOrNull { it in survey.columns.names } ?: return
            throw LogProblem(
                log.file,
                survey.headerLine,
                taken,
                "a log without this column, which is added",
                "one with it",
            )
        }
    }
}
