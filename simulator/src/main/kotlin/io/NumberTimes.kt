package stillwater.io

import java.util.Locale

/** Finds out in which unit the times in the column [CsvColumns.time] of a log are, where they are numbers. */
internal class NumberTimes(
    private val content: LogContent,
    private val layout: CsvLayout,
    private val columns: CsvColumns,
) {
    private val name = columns.names[columns.time]

    /**
     * How the times are read, of which the first is [first], as a number [number], in [asked] where that is given.
     *
     * @throws LogProblem if they may as well be in another unit than they seem to be.
     */
    fun of(first: String, number: Double, asked: TimeUnit?): CsvTimes {
        if (asked != null) return inUnits(asked.seconds, "as asked for")
        val below = layout.unit(columns.time)
        val named = ColumnNames.unit(name) ?: 1.0.takeIf { ColumnNames.statesSeconds(name) }
        val unit = named ?: if (ColumnNames.isNone(below)) null else ofLine(below)
        return when {
            unit == 1.0 -> CsvTimes(TimeForm(TimeForm.Kind.PLAIN), emptyList(), CsvTimes.PLAIN)
            unit != null -> inUnits(unit, "by the " + if (named == null) "line of units" else "column's name")
            DATE.containsMatchIn(name) && number in ExcelDays.RANGE -> CsvTimes(
                TimeForm(TimeForm.Kind.NUMBER, ExcelDays.FACTOR, ExcelDays.ZERO),
                listOf("times as a spreadsheet's days"),
                "a number of days",
            )
            else -> seconds(first, number)
        }
    }

    private fun inUnits(unit: Double, why: String) =
        CsvTimes(TimeForm(TimeForm.Kind.NUMBER, unit), listOf("times in units of $unit s, $why"), "a number")

    private fun ofLine(unit: String): Double {
        val bracketed = "t ($unit)"
        return ColumnNames.unit(bracketed) ?: 1.0.takeIf { ColumnNames.statesSeconds(bracketed) }
            ?: throw LogProblem(content.file, layout.headerLine + 1L, name, "a unit of time", quoted(unit))
    }

    private fun seconds(first: String, number: Double): CsvTimes {
        val isBesideDate = ColumnNames.dates(columns.names).any { it != columns.time } && number in 0.0..LATEST
        val isOfDay = SIX.matches(first) && first[0] == '0'
        if (isOfDay || isBesideDate) throw problem(first, "a time of day as 08:00:00, or $STATED")
        val times = layout.numbers(columns.time).filter { it.isFinite() }
        val steps = times.zipWithNext { a, b -> b - a }.filter { it > 0 }.sorted()
        if (steps.size > 1 && steps[steps.size / 2] < LEAST_STEP) {
            throw problem(first, "$STATED, for the steps are below a millisecond in seconds")
        }
        val speed = HeadSpeed.of(layout, columns)
        if (speed > FASTEST) {
            val found = "%.0f m/s between the first rows if they are seconds".format(Locale.ROOT, speed)
            throw LogProblem(content.file, layout.bodyLine.toLong(), name, STATED, found)
        }
        return CsvTimes(TimeForm(TimeForm.Kind.PLAIN), listOf("times taken for seconds"), CsvTimes.PLAIN)
    }

    private fun problem(found: String, expected: String) =
        LogProblem(content.file, layout.bodyLine.toLong(), name, expected, quoted(found))

    private companion object {
        const val STATED = "numbers whose unit the name states, as Time (s) does, or --time-unit"

        /** No boat that surveys goes faster, m/s; one that does 0.25 m/s in minutes would. */
        const val FASTEST = 15.0
        const val LEAST_STEP = 0.9e-3

        /** The last second of a day as a number of six digits. */
        const val LATEST = 235_959.999
        val SIX = Regex("""\d{6}([.,]\d*)?""")
        val DATE = Regex("""(?i)(?<![a-z])date""")
    }
}
