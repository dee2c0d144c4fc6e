package stillwater.report

import java.math.BigDecimal
import java.math.MathContext
import kotlin.math.abs

/**
 * The shortest decimal number that reads back as the same double, the same on every Java.
 *
 * Java before 19 sometimes writes a digit too many (JDK-4511638), so its text cannot be compared byte by byte
 * between machines. A normal double holds any 15 digits, so that the shortest text is the number rounded to 15 digits
 * (without trailing zeros), or else to 16, or else to 17, which always suffice.
 */
public object ShortestNumber {
    /** Subnormal numbers (below 2.3e-308) may need fewer than 15 digits. */
    private fun fewDigits(value: Double, exact: BigDecimal): BigDecimal? =
        if (abs(value) >= java.lang.Double.MIN_NORMAL) {
            null
        } else {
            (1 until FIFTEEN).firstNotNullOfOrNull { n ->
                exact.round(MathContext(n)).takeIf { it.toDouble() == value }
            }
        }

    private const val FIFTEEN = 15
    private val fifteen = MathContext(FIFTEEN)
    private val sixteen = MathContext(16)
    private val seventeen = MathContext(17)
    private const val WHOLE = 1e15
    private const val LARGE = 1e16
    private const val SMALL = 1e-5

    /** [value] in digits, `0.1` or `1e-7`; not finite ones as `NaN`, `Infinity`, `-Infinity`; whole without `.0`. */
    public fun text(value: Double): String {
        if (!value.isFinite()) return value.toString()
        if (abs(value) < WHOLE && value == Math.rint(value)) return if (value == 0.0) "0" else value.toLong().toString()
        val exact = BigDecimal(value)
        val digits = fewDigits(value, exact)
            ?: exact.round(fifteen).takeIf { it.toDouble() == value }
            ?: exact.round(sixteen).takeIf { it.toDouble() == value }
            ?: exact.round(seventeen)
        val short = digits.stripTrailingZeros()
        if (abs(value) < LARGE && abs(value) >= SMALL) return short.toPlainString()
        val power = short.precision() - short.scale() - 1
        return "${short.movePointLeft(power).toPlainString()}e$power"
    }
}
