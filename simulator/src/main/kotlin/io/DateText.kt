package stillwater.io

import java.time.DateTimeException
import java.time.LocalDate

/**
 * Dates and times of day as people and loggers write them: `14/07/2025 08:00:00`, `7/14/25 8:00:00 AM`, `14.07.2025`,
 * `14-Jul-2025 8:00`, `08:00:00.5`, `2025-07-14 08:00 UTC`. Which number is the day is not guessed: see [DateOrder].
 */
internal object DateText {
    private const val DAY_SECONDS = 86_400.0
    private const val YEAR_DIGITS = 4
    private const val NOON = 12
    private const val MINUTE = 60
    private const val SIXTY = 60.0
    private const val LATEST_TWO_DIGITS = 69
    private val DATE = Regex("""\s*(\d{1,4})([-/. ])(\d{1,2}|[A-Za-z]{3,9})\2(\d{1,4})(?:[T,\s]+(.*))?""")
    private const val CLOCK = """\s*(\d{1,2}):(\d{2}|\d(?=:))(?::(\d{1,2}(?:[.,]\d+)?))?\s*"""
    private val TIME = Regex(CLOCK + """(?:([AaPp])\.?[Mm]\.?)?\s*(?:Z|UTC|GMT)?\s*""")
    private val MONTHS = listOf("jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec")

    /**
     * The three numbers of a date.
     *
     * @property a the first. @property b the second; the month where that is a name. @property c the third.
     * @property order the only order that the form allows, or null where the numbers must decide.
     * @property shortYear whether the year has two digits, so that it may be the first number or the last.
     * @property rest what follows the date.
     */
    class Parts(val a: Int, val b: Int, val c: Int, val order: DateOrder?, val shortYear: Boolean, val rest: String) {
        /** Orders in which these numbers can be a date. */
        fun orders(): List<DateOrder> = when {
            order != null -> listOf(order).filter { it.fits(a, b, c) }
            else -> DateOrder.entries.filter { (shortYear || it != DateOrder.YEAR_FIRST) && it.fits(a, b, c) }
        }

        /** Seconds since 1970 at the beginning of the day, or NaN where there is no such day. */
        fun day(wanted: DateOrder?): Double {
            val by = order ?: wanted ?: return Double.NaN
            if (by !in orders()) return Double.NaN
            val (year, month, day) = when (by) {
                DateOrder.DAY_FIRST -> Triple(full(c), b, a)
                DateOrder.MONTH_FIRST -> Triple(full(c), a, b)
                DateOrder.YEAR_FIRST -> Triple(full(a), b, c)
            }
            return try {
                LocalDate.of(year, month, day).toEpochDay() * DAY_SECONDS
            } catch (_: DateTimeException) {
                Double.NaN
            }
        }

        private fun full(year: Int) = when {
            !shortYear -> year
            year <= LATEST_TWO_DIGITS -> 2000 + year
            else -> 1900 + year
        }
    }

    /** The date that [text] begins with, or null where it begins with none. */
    fun parts(text: String): Parts? {
        val match = DATE.matchEntire(text) ?: return null
        val groups = match.groupValues.drop(1)
        val (first, _, second) = groups
        val (third, rest) = groups.takeLast(2)
        val month = MONTHS.indexOf(second.take(3).lowercase()) + 1
        if (month == 0 && !second[0].isDigit()) return null
        val b = if (month > 0) month else second.toInt()
        val isYearFirst = first.length == YEAR_DIGITS && third.length <= 2
        val isShort = first.length <= 2 && third.length == 2
        if (!isYearFirst && !isShort && !(first.length <= 2 && third.length == YEAR_DIGITS)) return null
        val order = when {
            isYearFirst -> DateOrder.YEAR_FIRST
            month > 0 -> DateOrder.DAY_FIRST
            else -> null
        }
        return Parts(first.toInt(), b, third.toInt(), order, isShort, rest)
    }

    /** Seconds since 1970, UTC, of the date and time of day in [text], or NaN where it is none. */
    fun seconds(text: String, order: DateOrder?): Double {
        val parts = parts(text) ?: return Double.NaN
        return parts.day(order) + if (parts.rest.isBlank()) 0.0 else ofDay(parts.rest)
    }

    /** Seconds since midnight of the time of day that [text] is, or NaN where it is none. */
    fun ofDay(text: String): Double {
        val match = TIME.matchEntire(text) ?: return Double.NaN
        val (hour, minute, second) = match.groupValues.drop(1)
        val half = match.groupValues.last()
        val seconds = if (second.isEmpty()) 0.0 else second.replace(',', '.').toDouble()
        var hours = hour.toInt()
        if (half.isNotEmpty()) {
            if (hours !in 1..NOON) return Double.NaN
            hours = hours % NOON + if (half.lowercase() == "p") NOON else 0
        }
        if (hours >= 2 * NOON || minute.toInt() >= MINUTE || seconds >= SIXTY) return Double.NaN
        return (hours * MINUTE + minute.toInt()) * SIXTY + seconds
    }
}
