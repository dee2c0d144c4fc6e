package stillwater.io

/**
 * How the times of a CSV log are read.
 *
 * @property form how they are written. @property notes what was taken for what, for people.
 * @property expected what a time must be, for messages. @property expectedDate what a date must be, likewise.
 * @property rounding what they were cut to; null where they are as good as they are written. @property label column
 * that tells rows of one time apart; null where none does.
 */
internal class CsvTimes(
    val form: TimeForm,
    val notes: List<String>,
    val expected: String,
    val expectedDate: String = "",
    val rounding: TimeRounding? = null,
    val label: String? = null,
) {
    /**
     * The same with its [rounding], or [label], told from the head of the log; [clock] is what the column of times of a
     * Sea-Bird file was made of, null for other files.
     */
    fun rounded(layout: CsvLayout, columns: CsvColumns, clock: SeaBirdHeader.Clock?): CsvTimes {
        val reader = FieldReader(layout.decimalComma, form)
        val rows = layout.body()
        val times = rows.map { row ->
            val day = if (columns.date == CsvColumns.NONE) 0.0 else reader.day(row.getOrNull(columns.date).orEmpty())
            reader.time(row.getOrNull(columns.time).orEmpty()) + day
        }
        val label = RowLabels.column(rows, times, columns)
        if (label != null) return CsvTimes(form, notes, expected, expectedDate, label = columns.names[label])
        val own = clock?.takeIf { it.name == columns.names[columns.time] }
        fun isRead(row: Int) = !CellText.isMissing(rows[row].getOrNull(columns.value).orEmpty())
        val found = TimeRounding.of(times, form, own, ::isRead) ?: return this
        if (RowLabels.areApart(rows, times, columns, FASTEST * maxOf(1.0, found.unit), reader::number)) return this
        return CsvTimes(form, notes + "times in ${found.words}", expected, expectedDate, found)
    }

    /** What to add to a message about [text], which is no time: whether the name of a zone makes it none. */
    fun zoneHint(text: String): String {
        val name = ZONE.find(text)?.groupValues?.get(1) ?: return ""
        if (name.lowercase() in READ) return ""
        val isYearFirst = DateText.parts(text)?.order == DateOrder.YEAR_FIRST
        return " (names of zones are not read, only ${if (isYearFirst) "Z or an offset as -05:00" else "UTC or none"})"
    }

    companion object {
        /** Seconds from 1970 to the end of the year 9999, the last that ISO 8601 writes in four digits. */
        const val LATEST: Double = 253_402_300_800.0

        /** No boat goes faster between two rows, m/s. */
        private const val FASTEST = 20.0

        /** What such a date must be. */
        const val A_DATE = "a time before the year 5138"

        /** What a time in seconds or ISO 8601 must be. */
        const val PLAIN = "seconds or a time as 2025-06-01T12:00:00Z"

        /** What one in ISO 8601 must be where the first has an offset, and where it has none. */
        private const val ZONED = "a time as 2025-06-01T12:00:00Z, with Z or an offset as the first has"
        private const val NAIVE = "a time as 2025-06-01T12:00:00, without an offset as the first"

        /** Letters behind a time of day: a zone, such as EST or Europe/Berlin, or what is [READ]. */
        private val ZONE = Regex("""(?i):\d{2}(?:[.,]\d+)?\s*(?:[ap]\.?m\.?)?\s*\[?([a-z][a-z_/]+)]?\s*$""")
        private val READ = setOf("am", "pm", "utc", "gmt")

        /** Names of times without hours, which are read as hours and minutes if nobody looks. */
        private val MINUTES = Regex("""(?i)(?<!h:|hh)mm:ss""")

        /**
         * Looks at the column's name, the first row and, where dates are written in numbers, as many rows as it takes.
         *
         * @throws LogProblem if the log leaves the order of its dates open.
         */
        fun of(content: LogContent, layout: CsvLayout, columns: CsvColumns, choice: LogChoice): CsvTimes {
            val name = columns.names[columns.time]
            val text = layout.sample.getOrNull(columns.time).orEmpty()
            val number = FieldReader(layout.decimalComma, TimeForm(TimeForm.Kind.PLAIN)).number(text)
            val isZoned = IsoTime.isZoned(text)
            val isIso = isZoned != null
            if (choice.date != null && (isIso || !number.isNaN())) {
                throw problem(content, layout, name, "a time of day as 12:00:00 beside --date", quoted(text))
            }
            if (MINUTES.containsMatchIn(name) && number.isNaN()) {
                throw problem(content, layout, name, "times as 08:00:00, or a name without mm:ss", quoted(text))
            }
            if (choice.timeUnit != null && number.isNaN()) {
                throw problem(content, layout, name, "a number, as --time-unit says", quoted(text))
            }
            if (choice.overnight != null && (columns.date != CsvColumns.NONE || DateText.ofDay(text).isNaN())) {
                val found = quoted(text) + if (columns.date == CsvColumns.NONE) "" else " and a date beside it"
                throw problem(content, layout, name, "a time of day without a date, as --overnight says", found)
            }
            val isUndated = columns.date == CsvColumns.NONE && !DateText.ofDay(text).isNaN()
            val isOrdered = isIso && choice.dateOrder != DateOrder.YEAR_FIRST
            if (choice.dateOrder != null && (!number.isNaN() || isUndated || isOrdered)) {
                throw problem(content, layout, name, "a date such as 05/06/2025, as --date-order says", quoted(text))
            }
            return when {
                !number.isNaN() -> NumberTimes(content, layout, columns).of(text, number, choice.timeUnit)
                isZoned != null -> iso(isZoned)
                columns.date != CsvColumns.NONE -> {
                    val date = columns.names[columns.date]
                    val found = DateDecision.of(content, layout, columns.date, date, choice.dateOrder)
                    CsvTimes(
                        TimeForm(TimeForm.Kind.OF_DAY, order = found.order),
                        listOf("times from $date and $name") + listOf(found.why).filter { it.isNotEmpty() },
                        "a time of day as 12:00:00 or 12:00:00 PM",
                        dates(found.order),
                    )
                }
                !DateText.ofDay(text).isNaN() -> CsvTimes(
                    TimeForm(TimeForm.Kind.OF_ANY_DAY, overnight = choice.overnight),
                    listOf("times of day without a date"),
                    "a time of day as 12:00:00 or 12:00:00 PM",
                )
                DateText.parts(text) != null -> {
                    val found = DateDecision.of(content, layout, columns.time, name, choice.dateOrder)
                    val form = TimeForm(TimeForm.Kind.DATE, order = found.order)
                    CsvTimes(form, listOf(found.why).filter { it.isNotEmpty() }, dates(found.order) + " with the time")
                }
                else -> CsvTimes(TimeForm(TimeForm.Kind.PLAIN), emptyList(), PLAIN)
            }
        }

        /** Times in ISO 8601, all with an offset or all without: where both are, what those without are is a guess. */
        private fun iso(isZoned: Boolean) = CsvTimes(
            TimeForm(TimeForm.Kind.PLAIN, isZoned = isZoned),
            emptyList(),
            if (isZoned) ZONED else NAIVE,
        )

        private fun problem(content: LogContent, layout: CsvLayout, name: String, expected: String, found: String) =
            LogProblem(content.file, layout.bodyLine.toLong(), name, expected, found)

        private fun dates(order: DateOrder?) = "a date as " + (order ?: DateOrder.YEAR_FIRST).words
    }
}
