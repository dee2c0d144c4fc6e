package stillwater.io

/**
 * Reads decimal numbers out of a character buffer without making strings.
 *
 * Grammar: blanks, sign, digits with at most one point, exponent, blanks. Up to 15 digits with a power of ten up to
 * 22 both are exact doubles, and so is the one rounding of their product or quotient (Clinger 1990,
 * doi:10.1145/93548.93557, the fast path); all else goes to the standard library. The result is the same as
 * [String.toDouble] in every case but one: a zero byte is no blank, since it stands where data were lost.
 */
internal object DecimalText {
    private const val EXACT_DIGITS = 15
    private const val LARGEST_EXPONENT = 9999
    private val POWERS = DoubleArray(23).also { powers ->
        powers[0] = 1.0
        for (i in 1 until powers.size) powers[i] = powers[i - 1] * 10
    }

    /** The number in [text] at [offset] of [length] characters, or NaN where there is none. Allocates rarely. */
    fun parse(text: CharArray, offset: Int, length: Int): Double {
        var start = offset
        var end = offset + length
        while (start < end && isBlank(text[start])) start++
        while (end > start && isBlank(text[end - 1])) end--
        var i = start
        val negative = i < end && text[i] == '-'
        if (negative || (i < end && text[i] == '+')) i++
        var mantissa = 0L
        var digits = 0
        var significant = 0
        var scale = 0
        var point = false
        while (i < end) {
            val digit = text[i] - '0'
            if (digit in 0..9) {
                digits++
                if (significant > 0 || digit != 0) significant++
                if (significant <= EXACT_DIGITS) mantissa = mantissa * 10 + digit
                if (point) scale--
            } else if (text[i] == '.' && !point) {
                point = true
            } else {
                break
            }
            i++
        }
        if (digits == 0) return Double.NaN
        if (i < end) {
            val exponent = exponent(text, i, end)
            if (exponent == NO_EXPONENT) return Double.NaN
            scale += exponent
        }
        if (significant > EXACT_DIGITS || scale !in -22..22) return String(text, start, end - start).toDouble()
        val magnitude = if (scale < 0) mantissa / POWERS[-scale] else mantissa * POWERS[scale]
        return if (negative) -magnitude else magnitude
    }

    /** The number in [text], or NaN where there is none. */
    fun parse(text: String): Double = parse(text.toCharArray(), 0, text.length)

    /** The exponent `e[+-]digits` that fills [start] until [end], or [NO_EXPONENT]; huge ones are cut, keeping the sign. */
    private fun exponent(text: CharArray, start: Int, end: Int): Int {
        var i = start
        if (text[i] != 'e' && text[i] != 'E') return NO_EXPONENT
        i++
        val negative = i < end && text[i] == '-'
        if (negative || (i < end && text[i] == '+')) i++
        if (i == end) return NO_EXPONENT
        var exponent = 0
        while (i < end) {
            val digit = text[i] - '0'
            if (digit !in 0..9) return NO_EXPONENT
            exponent = minOf(exponent * 10 + digit, LARGEST_EXPONENT)
            i++
        }
        return if (negative) -exponent else exponent
    }

    private fun isBlank(char: Char) = char <= ' ' && char != '\u0000'

    private const val NO_EXPONENT = Int.MIN_VALUE
}
