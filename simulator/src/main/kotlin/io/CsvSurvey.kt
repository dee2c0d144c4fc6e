package stillwater.io

import de.siegmar.fastcsv.reader.CsvParseException
import de.siegmar.fastcsv.reader.CsvReader
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import stillwater.report.counted
import java.io.UncheckedIOException
import java.nio.file.Path
import kotlin.math.abs

/**
 * A survey log as comma, semicolon or tab separated values with a header line.
 *
 * Rows need a time, times that grow, and latitudes and longitudes that exist and lie within 1000 km of the first. A
 * reading or position that is missing, and says so, is no error: such rows are left out and counted. Positions of
 * exactly 0, 0 degrees are a receiver's way of saying that it has no fix. What stands before the table, and how it is
 * written, is found by [CsvLayout] and [CsvTimes]. A Sea-Bird `.cnv` is such a table by [SeaBirdTable].
 */
internal class CsvSurvey internal constructor(
    internal val content: LogContent,
    internal val layout: CsvLayout,
    internal val columns: CsvColumns,
    internal val times: CsvTimes,
    private val skipBadRows: Boolean,
    private val keepsUnread: Boolean = false,
) : SurveyLog {
    override val file: Path get() = content.file
    override val format = kind()
        .plus(listOfNotNull("text in Windows-1252".takeIf { content.isOneByte }))
        .plus(times.notes)
        .plus(columns.notes())
        .joinToString()
    override val quantity: String = columns.names[columns.value]
    override val hasPlaces = columns.latitude != CsvColumns.NONE || columns.x != CsvColumns.NONE
    override val oneDimensional = columns.x != CsvColumns.NONE && columns.y == CsvColumns.NONE
    override val xName: String = if (columns.x == CsvColumns.NONE) "x_m" else columns.names[columns.x]
    override var frame: LocalFrame? = HeadPlaces.afterWildOnes(layout, columns)
        private set

    // Sea-Bird's programs mark scans there, as one in which the instrument was drawn back through its own wake.
    private val flag = if (content.seaBird == null) CsvColumns.NONE else columns.names.indexOf("flag")

    private val conditionNames = columns.conditions.keys.toList()
    private val slots = slots()

    // A condition taken from a column that serves otherwise too is found in that one's slot.
    private val conditionSlots = IntArray(conditionNames.size) { i ->
        slots[columns.conditions.getValue(conditionNames[i])]
    }

    private fun kind(): List<String> =
        content.seaBird?.let { listOf("Sea-Bird .cnv") + it.notes() } ?: (listOf(layout.kind) + layout.notes())

    /** Reads the fields of one pass; a log that is written plainly needs none, and is read faster without. */
    internal fun fieldReader() = FieldReader(layout.decimalComma, times.form)

    // Then a word such as Max is the name of something.
    private val beginsWithWords = layout.sample.firstOrNull().orEmpty().let { it.isNotEmpty() && it[0].isLetter() }

    private val isPlain = !layout.decimalComma && times.form.kind == TimeForm.Kind.PLAIN

    override fun read(progress: (Long) -> Unit, sink: ReadingSink): LogPass {
        val before = layout.headerLine - 1
        val fields = if (isPlain) null else fieldReader()
        val pass = Pass(sink, fields)
        val isZoned = times.form.isZoned
        val row = CsvRow(slots, SLOTS + conditionNames.size, layout.separator, TIME, DATE, fields, isZoned, before)
        val reader = CsvReader.builder()
            .fieldSeparator(layout.separator)
            .skipEmptyLines(false)
            .allowExtraFields(true)
            .allowMissingFields(true)
            .maxBufferSize(ParserWording.LONGEST_FIELD)
            .build(row, EndMark(content.reader(before, progress)))
        reader.use { rows -> inLogTerms { for (row in rows) pass.take(row) } }
        return pass.end()
    }

    private inline fun inLogTerms(work: () -> Unit) {
        try {
            work()
        } catch (failure: CsvParseException) {
            throw generateSequence<Throwable>(failure) { it.cause }.firstNotNullOfOrNull { it as? LogProblem }
                ?: ParserWording.of(failure, layout.headerLine, columns.names.size) { line, expected, found ->
                    problem(line, null, expected, found, null)
                }
        } catch (_: UncheckedIOException) {
            throw problem(null, null, "a log file", "a file that cannot be read", null)
        }
    }

    private fun slots() = IntArray(columns.names.size) { CsvColumns.NONE }.also { slots ->
        // A later assignment wins, so the columns that rows cannot do without come last.
        if (flag != CsvColumns.NONE) slots[flag] = FLAG
        conditionNames.forEachIndexed { i, name -> slots[columns.conditions.getValue(name)] = SLOTS + i }
        val inDegrees = columns.latitude != CsvColumns.NONE
        slots[columns.value] = VALUE
        if (!inDegrees && columns.y != CsvColumns.NONE) slots[columns.y] = NORTH
        val east = if (inDegrees) columns.longitude else columns.x
        if (east != CsvColumns.NONE) slots[east] = EAST
        if (inDegrees) slots[columns.latitude] = NORTH
        if (columns.date != CsvColumns.NONE) slots[columns.date] = DATE
        slots[columns.time] = TIME
    }

    private fun problem(line: Long?, column: Int?, expected: String, found: String, skippable: String?) =
        LogProblem(file, line, column?.let { columns.names[it] }, expected, found, skippable)

    /** One reading of the file from its beginning. */
    private inner class Pass(private val sink: ReadingSink, private val fields: FieldReader?) {
        private val skips = SkipCounts()
        private val nights = Nights()
        private val codes = ConditionCodes(columns)
        private var readings = 0L
        private var rows = 0L
        private var headerSeen = false
        private val jumps = PositionJumps(speedUnit)
        private val far = FarFixes(::hand)
        private val inTime =
            RowTimes(times.rounding, { row, other, fault -> refuse(timeProblem(row, other, fault)) }, ::use)
        private val local = DoubleArray(2)
        private val inDegrees = columns.latitude != CsvColumns.NONE
        private val northColumn = if (inDegrees) columns.latitude else columns.y
        private val eastColumn = if (inDegrees) columns.longitude else columns.x

        /** Whether places are metres both ways; a transect's may be in any unit. */
        private val isFlat = northColumn != CsvColumns.NONE && eastColumn != CsvColumns.NONE

        fun take(row: CsvRow) {
            if (row.isEnd) return
            if (row.blank) {
                skips.count("blank lines")
            } else if (!headerSeen) {
                headerSeen = true
                quoteProblem(row)?.let { throw it }
                if (row.fields != columns.names.size || row.widestBreak >= 0) {
                    throw problem(row.line, null, "a header in one line", "a line break inside quotes", null)
                }
            } else if (row.line < layout.bodyLine) {
                skips.count("lines of units")
            } else {
                rows++
                if (fields != null) nights.take(row.line, fields)
                val reason = withoutReading(row)
                val problem = if (reason == null) problemOf(row) else null
                when {
                    reason != null -> passOver(row, reason)
                    problem == null -> inTime.read(placed(row))
                    else -> refuse(problem)
                }
            }
        }

        private fun passOver(row: CsvRow, reason: String) {
            skips.count(reason)
            // Where times were cut to units, a row without a reading still shows the time of those around it; where each
            // sensor has a row of its own, it has what was measured beside the reading.
            val isOfUse = keepsUnread || times.rounding != null || conditionNames.isNotEmpty()
            if (!isOfUse || reason !in UnreadRows.REASONS) return
            row.numbers[VALUE] = 0.0
            if (problemOf(row) == null) inTime.missed(placed(row))
        }

        /** Why [row] is right and yet holds no reading; null where it holds one, or is wrong. */
        private fun withoutReading(row: CsvRow): String? = when {
            row.isOpen || row.widestBreak >= 0 || row.zeros > 0 -> null
            row.word.isNotEmpty() && !beginsWithWords && CellText.isSummary(row.word) -> SUMMARY
            row.isWhole && row.fields == columns.names.size -> code(row)
            else -> withoutReading(row, row.textOf(columns.time))
        }

        private fun withoutReading(row: CsvRow, time: String): String? = when {
            CellText.isRemark(row.first) -> "remarks"
            row.numbers[TIME].isNaN() && CellText.isSummary(time) -> SUMMARY
            row.fields != columns.names.size -> null
            row.isUnreadable(flag) && CellText.isMissing(row.textOf(flag)) -> "scans marked bad"
            isEmpty(row, columns.time) && isEmpty(row, northColumn, eastColumn, columns.value) -> "empty rows"
            !row.numbers[TIME].isFinite() -> null
            isMissing(row, northColumn, NORTH) || isMissing(row, eastColumn, EAST) -> NO_PLACE
            !isGiven(northColumn, row.numbers[NORTH]) || !isGiven(eastColumn, row.numbers[EAST]) -> null
            isMissing(row, columns.value, VALUE) -> UnreadRows.MISSING
            else -> code(row)
        }

        /** What a number in [row] that stands for nothing leaves it without. */
        private fun code(row: CsvRow): String? = when {
            CellText.isCode(row.numbers[NORTH]) || CellText.isCode(row.numbers[EAST]) -> NO_PLACE
            CellText.isCode(row.numbers[VALUE]) -> UnreadRows.CODES
            else -> null
        }

        private fun isEmpty(row: CsvRow, vararg used: Int) =
            used.all { it == CsvColumns.NONE || (row.isUnreadable(it) && row.textOf(it).isBlank()) }

        private fun isMissing(row: CsvRow, column: Int, slot: Int) = column != CsvColumns.NONE &&
            row.numbers[slot].isNaN() && CellText.isMissing(row.textOf(column))

        private fun isGiven(column: Int, number: Double) = column == CsvColumns.NONE || number.isFinite()

        private fun refuse(problem: LogProblem) {
            if (!skipBadRows || problem.skippable == null) throw problem
            skips.count(problem.skippable)
        }

        /** Rows swallowed by a quote are lost without a count, so skipping is no help. */
        private fun quoteProblem(row: CsvRow): LogProblem? {
            val found = when {
                row.isOpen -> "none to the end of the file"
                row.widestBreak >= columns.names.size - 1 -> "none before the next row"
                else -> return null
            }
            return problem(row.line, null, "a closing quote", found, null)
        }

        private fun problemOf(row: CsvRow): LogProblem? {
            quoteProblem(row)?.let { return it }
            if (row.zeros > 0) {
                val bytes = counted(minOf(row.zeros, ShortZeros.MOST).toLong() * content.unit, "zero byte")
                val found = if (row.zeros > ShortZeros.MOST) "more than $bytes" else bytes
                return problem(row.line, null, "a row of text", found, "rows with zero bytes")
            }
            if (row.fields != columns.names.size) {
                val expected = "${columns.names.size} fields as in the header"
                val why = if (splitsDecimals(row)) " (decimal commas need another separator)" else ""
                val found = "${row.fields}$why"
                return problem(row.line, null, expected, found, "rows with a wrong number of fields")
            }
            return numberProblem(row, TIME, columns.time)
                ?: numberProblem(row, NORTH, northColumn)
                ?: numberProblem(row, EAST, eastColumn)
                ?: numberProblem(row, VALUE, columns.value)
                ?: conditionProblem(row)
                ?: rangeProblem(row)
                ?: reachProblem(row)
        }

        private fun numberProblem(row: CsvRow, slot: Int, column: Int): LogProblem? {
            if (column == CsvColumns.NONE || row.numbers[slot].isFinite()) return null
            if (slot == TIME && columns.date != CsvColumns.NONE && !row.isUnreadable(column)) {
                val found = quoted(row.textOf(columns.date))
                return problem(row.line, columns.date, times.expectedDate, found, "rows without a date")
            }
            val text = row.textOf(column)
            val reason = if (text.isBlank()) "rows with an empty field" else "rows with text where a number belongs"
            val hint = when {
                text.trim() == columns.names[column] -> ", the header again: is this another log glued onto the first?"
                row.numbers[slot].isInfinite() -> " (too large)"
                else -> (if (slot == TIME) times.zoneHint(text) else "") + layout.commaHint(text)
            }
            val expected = if (slot == TIME) times.expected else "a finite number"
            return problem(row.line, column, expected, quoted(text) + hint, reason)
        }

        /** Whether the row has about as many fields more as it would if commas stood in its numbers. */
        private fun splitsDecimals(row: CsvRow) = layout.separator == ',' &&
            row.fields > columns.names.size + 1 && row.fields <= 2 * columns.names.size

        private fun conditionProblem(row: CsvRow): LogProblem? {
            for (i in conditionNames.indices) {
                val column = columns.conditions.getValue(conditionNames[i])
                val slot = conditionSlots[i]
                if (slot < SLOTS) continue
                if (row.numbers[slot].isFinite()) {
                    sizeProblem(row, slot, column, SquareReach.LARGEST)?.let { return it }
                    continue
                }
                val text = row.textOf(column)
                if (CellText.isMissing(text)) continue
                val reason = "rows with text where a number belongs"
                return problem(row.line, column, "a number or nothing", quoted(text), reason)
            }
            return null
        }

        private fun rangeProblem(row: CsvRow): LogProblem? {
            val latitude = row.numbers[NORTH]
            val longitude = row.numbers[EAST]
            val reason = "positions off the globe"
            timeSizeProblem(row)?.let { return it }
            sizeProblem(row, VALUE, columns.value, SquareReach.LARGEST)?.let { return it }
            return when {
                !inDegrees -> sizeProblem(row, EAST, eastColumn, LARGEST_METRES)
                    ?: sizeProblem(row, NORTH, northColumn, LARGEST_METRES)
                latitude !in LatLon.LATITUDES_DEG ->
                    problem(row.line, northColumn, "a latitude within -90..90", "$latitude", reason)
                longitude !in LatLon.LONGITUDES_DEG ->
                    problem(row.line, eastColumn, "a longitude within -180..360", "$longitude", reason)
                latitude == 0.0 && longitude == 0.0 -> null
                // Any row, or the second reading, which has a frame already, would take what the first has left out.
                !LocalFrame.canStartAt(latitude) ->
                    problem(row.line, northColumn, "a latitude short of the pole", "$latitude", reason)
                else -> null
            }
        }

        private fun timeSizeProblem(row: CsvRow): LogProblem? {
            val time = row.numbers[TIME]
            if (abs(time) <= LARGEST_SECONDS) return null
            if (abs(time) < CsvTimes.LATEST) return problem(row.line, columns.time, CsvTimes.A_DATE, "$time s", WILD)
            val found = "$time" + if (abs(time) < LARGEST_MILLIS) ": milliseconds? --time-unit ms" else ""
            return problem(row.line, columns.time, "seconds", found, WILD)
        }

        private fun sizeProblem(row: CsvRow, slot: Int, column: Int, largest: Double): LogProblem? {
            if (column == CsvColumns.NONE || abs(row.numbers[slot]) <= largest) return null
            val expected = "a number within -$largest..$largest"
            return problem(row.line, column, expected, "${row.numbers[slot]}", WILD)
        }

        private fun reachProblem(row: CsvRow): LogProblem? {
            val origin = (if (inDegrees) frame else null) ?: return null
            val latitude = row.numbers[NORTH]
            val longitude = row.numbers[EAST]
            if (latitude == 0.0 && longitude == 0.0) return null
            origin.toLocal(latitude, longitude, local)
            if (FixReach.holds(origin.origin, latitude, longitude, local[0], local[1])) return null
            return problem(row.line, northColumn, FixReach.EXPECTED, "$latitude, $longitude", FixReach.REASON)
        }

        private fun timeProblem(row: TimedRow, other: TimedRow, fault: TimeFault): LogProblem {
            val wording = TimeWording(times, layout.sample.getOrNull(columns.time).orEmpty())
            val expected = wording.expected(row.seconds, other.seconds, fault)
            return problem(row.line, columns.time, expected, wording.of(row.seconds), fault.reason)
        }

        private fun placed(row: CsvRow): TimedRow {
            val numbers = row.numbers
            var x = if (eastColumn == CsvColumns.NONE) 0.0 else numbers[EAST]
            var y = if (northColumn == CsvColumns.NONE) 0.0 else numbers[NORTH]
            if (inDegrees) {
                // With a frame, the look at the reach has put the place into local.
                val isFix = x != 0.0 || y != 0.0
                if (isFix && frame == null) frame = LocalFrame(LatLon(y, x)).also { it.toLocal(y, x, local) }
                x = if (isFix) local[0] else Double.NaN
                y = if (isFix) local[1] else y
            }
            return TimedRow(row.line, numbers[TIME], x, y, numbers[VALUE], conditions(row))
        }

        private fun use(row: TimedRow) {
            when {
                row.value.isNaN() && !keepsUnread -> Unit
                row.x.isNaN() -> skips.count("positions without a fix (0, 0)")
                isFlat -> far.take(row)
                else -> hand(row)
            }
        }

        private fun hand(row: TimedRow) {
            jumps.take(row.line, row.seconds, row.x, row.y)
            sink.take(BoatTime(row.seconds), row.x, row.y, row.value, row.conditions)
            if (!row.value.isNaN()) readings++
        }

        private fun conditions(row: CsvRow): Conditions {
            if (conditionNames.isEmpty()) return Conditions.NONE
            val measured = LinkedHashMap<String, Double>()
            conditionNames.forEachIndexed { i, name ->
                val number = row.numbers[conditionSlots[i]]
                when {
                    CellText.isCode(number) -> codes.count(i)
                    number.isFinite() -> measured[name] = number
                }
            }
            return Conditions(measured)
        }

        fun end(): LogPass {
            if (rows == 0L) throw problem(null, null, "rows after the header", "none", null)
            inTime.end()
            far.end()
            repeat(far.count.toInt()) { skips.count("fixes far off") }
            val notes = inTime.notes + listOfNotNull(nights.note, far.note, jumps.note) + codes.notes()
            return LogPass(readings, skips.toMap(), notes, jumps.count)
        }
    }

    companion object {
        private const val SUMMARY = "lines that sum up"
        private const val WILD = "rows with a number out of all bounds"
        private const val NO_PLACE = "rows without a position"
        private const val LARGEST_METRES = 1e9

        /** The year 5138, or 1973 in milliseconds. */
        private const val LARGEST_SECONDS = 1e11
        private const val LARGEST_MILLIS = 1e14

        // Where a row's numbers are kept; conditions follow.
        private const val TIME = 0
        private const val NORTH = 1
        private const val EAST = 2
        private const val VALUE = 3
        private const val DATE = 4
        private const val FLAG = 5
        private const val SLOTS = 6
    }
}
