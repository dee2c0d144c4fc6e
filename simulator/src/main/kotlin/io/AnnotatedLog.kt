package stillwater.io

import de.siegmar.fastcsv.writer.CsvWriter
import de.siegmar.fastcsv.writer.LineDelimiter
import java.io.OutputStream
import java.io.OutputStreamWriter

/**
 * What is added to the rows of a log that hold a reading of one quantity.
 *
 * @param log the log as it yields these readings. @property names the columns added.
 * @property times times of the readings, s, length n. Not modified. @property xs their places, m, length n. Not
 * modified. @property ys likewise. @property values the readings, sensor units, length n. Not modified.
 * @property cells what is added to reading k, one for each of [names]; null for an empty cell.
 */
internal class AddedColumns(
    log: SurveyLog,
    val names: List<String>,
    val times: DoubleArray,
    val xs: DoubleArray,
    val ys: DoubleArray,
    val values: DoubleArray,
    val cells: (Int) -> List<String?>,
) {
    /** The log as it stands in its file. */
    val log: SurveyLog = log.asWritten
}

/**
 * Writes a log again as CSV, byte for byte as it is, with some more columns behind its own; a Sea-Bird `.cnv` as
 * [SeaBirdTable] has it.
 *
 * @param parts what is added, all of the same log; of a log that is not CSV one part only.
 */
internal class AnnotatedLog(private val parts: List<AddedColumns>) {
    init {
        require(parts.isNotEmpty()) { "parts must not be empty" }
        require(parts.size == 1 || parts[0].log is CsvSurvey) { "only a CSV log has rows that hold several readings" }
    }

    /** Where the writing of one part is. */
    private class Place(val part: AddedColumns) {
        val survey = part.log as CsvSurvey
        val empty = List<String?>(part.names.size) { null }
        val reader = survey.fieldReader()
        var next = 0
        var other = 0L

        fun time(fields: List<String>) = reader.time(fields.getOrNull(survey.columns.time).orEmpty())
    }

    /**
     * Writes all rows to [out], which is closed. Logs that are not CSV get a row a reading with the columns time_s,
     * lat_deg and lon_deg where the log knows them, x_m, y_m and the quantity.
     *
     * @return for each part the number of rows written that are no reading of it; what it adds to them is empty.
     */
    fun write(out: OutputStream): List<Long> = if (parts[0].log is CsvSurvey) csv(out) else plain(out, parts[0])

    private fun plain(out: OutputStream, part: AddedColumns): List<Long> {
        val globe = GlobeColumns(part.log.frame)
        writer(out).use { writer ->
            writer.writeRecord(listOf("time_s") + globe.names + listOf("x_m", "y_m", part.log.quantity) + part.names)
            for (k in part.times.indices) {
                val place = globe.cells(part.xs[k], part.ys[k])
                val own = listOf(part.xs[k], part.ys[k], part.values[k]).map { it.toString() }
                writer.writeRecord(listOf(part.times[k].toString()) + place + own + part.cells(k))
            }
        }
        return listOf(0)
    }

    /** All bytes of the log as they are, the added cells before the line ends. */
    private fun csv(out: OutputStream): List<Long> {
        val places = parts.map { Place(it) }
        val survey = places[0].survey
        val layout = survey.layout
        out.use {
            survey.content.raw { mark, text ->
                out.write(mark)
                val records = RawRecords(text, survey.content.charset, layout.separator)
                repeat(layout.headerLine - 1) {
                    records.nextLine()
                    out.write(records.bytes(records.text))
                    out.write(records.bytes(records.lineEnd))
                }
                var width = NO_HEADER
                while (records.next()) {
                    val fields = records.fields
                    val isHeader = width == NO_HEADER
                    val added = when {
                        isHeader -> emptyList<String?>().also { width = fields.size }
                        fields.size < width && fields.all { it.isBlank() } -> emptyList()
                        fields.size == width -> places.flatMap { added(it, fields) }
                        // A row of another width or a remark is not made wider: nothing in it would stand in place.
                        else -> emptyList<String?>().also { places.forEach { other(it, fields) } }
                    }
                    out.write(records.bytes(records.text))
                    if (isHeader) out.write(header(survey).toByteArray(survey.content.charset))
                    for (cell in added) out.write(records.bytes(layout.separator + written(cell, layout)))
                    out.write(records.bytes(records.lineEnd))
                }
            }
        }
        for (place in places) {
            val left = place.part.times.size - place.next
            check(left == 0) { "$left readings of ${survey.file} were not found again" }
        }
        return places.map { it.other }
    }

    /** [cell] as this log writes numbers. */
    private fun written(cell: String?, layout: CsvLayout) =
        if (layout.decimalComma) cell.orEmpty().replace('.', ',') else cell.orEmpty()

    /** The new names, each behind a separator: quoted where they hold what ends a field, as the log's own may. */
    private fun header(survey: CsvSurvey) = parts.flatMap { it.names }.joinToString("") { name ->
        val isPlain = name.none { it == survey.layout.separator || it == '"' || it == '\n' || it == '\r' }
        survey.layout.separator + if (isPlain) name else "\"${name.replace("\"", "\"\"")}\""
    }

    private fun added(place: Place, fields: List<String>): List<String?> {
        val time = place.time(fields)
        val isNext = place.next < place.part.times.size && isRow(place, fields, time)
        if (isNext) return place.part.cells(place.next++)
        place.other++
        return place.empty
    }

    /** Its time is read as the first reading of the log did: a time of day may be what the next ones hang on. */
    private fun other(place: Place, fields: List<String>) {
        place.time(fields)
        place.other++
    }

    private fun isRow(place: Place, fields: List<String>, ofRow: Double): Boolean {
        val columns = place.survey.columns
        val part = place.part
        fun text(column: Int) = fields.getOrNull(column).orEmpty()
        val day = if (columns.date == CsvColumns.NONE) 0.0 else place.reader.day(text(columns.date))
        val time = ofRow + day
        val value = place.reader.number(text(columns.value))
        val isTime = part.times[place.next] in time..time + (place.survey.times.rounding?.unit ?: 0.0)
        return isTime && value == part.values[place.next] && isPlace(place, fields)
    }

    /** Degrees are compared by being there only: a row left out for its place may be the next one's twin. */
    private fun isPlace(place: Place, fields: List<String>): Boolean {
        val columns = place.survey.columns
        fun number(column: Int) =
            fields.getOrNull(column)?.let { place.reader.number(it) }?.takeUnless(CellText::isCode) ?: Double.NaN
        if (columns.latitude != CsvColumns.NONE) {
            val latitude = number(columns.latitude)
            val longitude = number(columns.longitude)
            return latitude.isFinite() && longitude.isFinite() && (latitude != 0.0 || longitude != 0.0)
        }
        val part = place.part
        return (columns.x == CsvColumns.NONE || number(columns.x) == part.xs[place.next]) &&
            (columns.y == CsvColumns.NONE || number(columns.y) == part.ys[place.next])
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
            val survey = log.asWritten as? CsvSurvey ?: return
            val taken = names.firstOrNull { it in survey.columns.names } ?: return
            throw LogProblem(
                log.file,
                survey.layout.headerLine.toLong(),
                taken,
                "a log without this column, which is added",
                "one with it",
            )
        }
    }
}
