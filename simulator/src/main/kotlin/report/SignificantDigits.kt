package stillwater.report

import java.math.BigDecimal
import java.math.MathContext
import java.math.RoundingMode
import kotlin.math.abs

/**
 * Writes numbers for people: a fixed count of significant digits, a decimal point in every locale.
 *
 * @property digits significant digits, 1 to 17; trailing zeros are kept, since they say how exact a number is.
 */
public class SignificantDigits(public val digits: Int) {
    private val context: MathContext

    init {
        require(digits in 1..MOST) { "digits ($digits) must be 1 to $MOST" }
        context = MathContext(digits, RoundingMode.HALF_EVEN)
    }

    /** [value] as text; NaN is `–`, very large and very small numbers are written with a power of ten (`1.20e-7`). */
    public fun format(value: Double): String = when {
        value.isNaN() -> MISSING
        value.isInfinite() -> if (value > 0) "∞" else "−∞"
        value == 0.0 -> "0"
        abs(value) >= LARGE || abs(value) < SMALL -> scientific(BigDecimal(value).round(context))
        else -> plain(BigDecimal(value))
    }

    private fun plain(exact: BigDecimal): String {
        // Rounded before counting, since 9.999 becomes 10.0. Whole digits stay even if there are more than asked for.
        val rounded = exact.round(context)
        val decimals = maxOf(0, digits - (rounded.precision() - rounded.scale()))
        return exact.setScale(decimals, RoundingMode.HALF_EVEN).toPlainString()
    }

    private fun scientific(rounded: BigDecimal): String {
        val power = rounded.precision() - rounded.scale() - 1
        val mantissa = rounded.movePointLeft(power).setScale(digits - 1, RoundingMode.HALF_EVEN)
        return "${mantissa.toPlainString()}e$power"
    }

    public companion object {
        /** What stands for a number that is missing. */
        public const val MISSING: String = "–"

        private const val MOST = 17
        private const val LARGE = 1e7
        private const val SMALL = 1e-4
    }
}
