package stillwater.io

/** What the fields of a table say besides numbers: nothing, a time, a remark, a summary. */
internal object CellText {
    private val MISSING = setOf("", "nan", "-nan", "na", "n/a", "#n/a", "#na", "null", "none", "missing", "1.#qnan")
    private val SUMMARIES = setOf(
        "mean", "average", "avg", "median", "min", "minimum", "max", "maximum", "std", "sd", "stdev", "std dev",
        "standard deviation", "mean value", "total", "sum", "count", "end", "end of file", "end of data", "eof",
    )
    private val TIME =
        Regex("""\d{1,4}([-/.])(\d{1,2}|[A-Za-z]{3,9})\1\d{1,4}(?!\d).*|\d{1,2}:(\d{2}|\d:\d{1,2})(?!\d).*""")

    /** Whether [text] is what loggers write where they have no reading: nothing, NaN, NA, null, dashes, asterisks. */
    fun isMissing(text: String): Boolean {
        val trimmed = text.trim()
        return trimmed.all { it == '-' || it == '*' || it == '+' } || trimmed.lowercase() in MISSING
    }

    /** What loggers, and the exchange files of cruises (WOCE, SeaDataNet), write where they have no number. */
    private val CODES = setOf(-999.0, -9999.0, -99_999.0, -999_999.0)

    /** Whether [number] is what is written where there is none. */
    fun isCode(number: Double): Boolean = number in CODES

    /** Whether [text] begins a line that sums up a column, or ends a file: such a line is no reading. */
    fun isSummary(text: String): Boolean = text.trim().trimEnd(':', '.').lowercase() in SUMMARIES

    /** Whether a line that begins with [first] is a remark. */
    fun isRemark(first: Char): Boolean = first == '#' || first == '%' || first == '/'

    /** Whether [line] is a remark: it begins with #, % or /. */
    fun isRemark(line: String): Boolean {
        val begin = line.trimStart()
        return begin.isNotEmpty() && isRemark(begin[0])
    }

    /** Whether [text] is a number, with a decimal point or, if [comma], a decimal comma. */
    fun isNumber(text: String, comma: Boolean): Boolean =
        !DecimalText.parse(if (comma) text.replace(',', '.') else text).isNaN()

    /** Whether [text] looks like a date or a time of day. */
    fun isTime(text: String): Boolean = TIME.matches(text.trim())
}
