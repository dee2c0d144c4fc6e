package stillwater.io

/** In which order a date in numbers names day, month and year. */
enum class DateOrder(
    /** As on the command line. */
    val flag: String,
    /** For people. */
    val words: String,
) {
    DAY_FIRST("dmy", "day/month/year"),
    MONTH_FIRST("mdy", "month/day/year"),
    YEAR_FIRST("ymd", "year/month/day"),
    ;

    /** Whether three numbers can be a date in this order; a year of two digits may be any. */
    internal fun fits(a: Int, b: Int, c: Int): Boolean = when (this) {
        DAY_FIRST -> a in DAYS && b in MONTHS
        MONTH_FIRST -> a in MONTHS && b in DAYS
        YEAR_FIRST -> b in MONTHS && c in DAYS
    }

    internal companion object {
        private val DAYS = 1..31
        private val MONTHS = 1..12
        private val IN_NAME = mapOf(
            Regex("""(?i)\bdd?\W?mm?\W?yy""") to DAY_FIRST,
            Regex("""(?i)\bmm?\W?dd?\W?yy""") to MONTH_FIRST,
            Regex("""(?i)\byy(yy)?\W?mm?\W?dd?\b""") to YEAR_FIRST,
        )

        /** The order that a column's [name] states, as "Date (MM/DD/YYYY)" does; null where it states none. */
        fun stated(name: String): DateOrder? = IN_NAME.entries.firstOrNull { it.key.containsMatchIn(name) }?.value
    }
}
