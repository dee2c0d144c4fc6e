package stillwater.wire

/**
 * Reads decimal numbers out of bytes, exactly and without allocating where they have up to 15 digits.
 *
 * A number of up to 15 digits and a power of ten up to 22 are both exact doubles, so that one multiplication or division
 * rounds once: the nearest double, as Java's own. Longer numbers go through it. Source: W. D. Clinger (1990), "How to
 * read floating point numbers accurately", doi:10.1145/93542.93557.
 */
internal object Decimal {
    private const val EXACT_DIGITS = 15
    private const val LONGEST = 40
    private val POWERS = DoubleArray(23).also { powers ->
        powers[0] = 1.0
        for (i in 1 until powers.size) powers[i] = 10 * powers[i - 1]
    }

    /** The number that fills [bytes] from [start] until [end]; NaN where it is none, not finite or absurdly long. */
    fun parse(bytes: ByteArray, start: Int, end: Int): Double {
        if (end - start > LONGEST) return Double.NaN
        var at = start
        val negative = at < end && bytes[at] == '-'.code.toByte()
        if (negative || (at < end && bytes[at] == '+'.code.toByte())) at++
        var mantissa = 0L
        var digits = 0
        var significant = 0
        var point = -1
        while (at < end) {
            val byte = bytes[at].toInt()
            val digit = byte - ZERO
            if (digit in 0..9) {
                digits++
                if (mantissa > 0 || digit > 0) significant++
                if (significant <= EXACT_DIGITS) mantissa = 10 * mantissa + digit
            } else if (byte == POINT && point < 0) {
                point = digits
            } else {
                break
            }
            at++
        }
        val decimals = if (point < 0) 0 else digits - point
        if (digits == 0) return Double.NaN
        if (at < end || significant > EXACT_DIGITS || decimals >= POWERS.size) return parseSlowly(bytes, start, at, end)
        val magnitude = if (mantissa == 0L) 0.0 else mantissa / POWERS[decimals]
        return if (negative) -magnitude else magnitude
    }

    /** For exponents and long numbers: [at] is where the digits end. */
    private fun parseSlowly(bytes: ByteArray, start: Int, at: Int, end: Int): Double {
        if (at < end) {
            if (bytes[at] != 'e'.code.toByte() && bytes[at] != 'E'.code.toByte()) return Double.NaN
            var digit = at + 1
            if (digit < end && (bytes[digit] == '-'.code.toByte() || bytes[digit] == '+'.code.toByte())) digit++
            if (digit == end) return Double.NaN
            for (i in digit until end) if (bytes[i] - ZERO !in 0..9) return Double.NaN
        }
        val value = String(bytes, start, end - start, Charsets.ISO_8859_1).toDouble()
        return if (value.isFinite()) value else Double.NaN
    }

    private const val ZERO = '0'.code
    private const val POINT = '.'.code
}
