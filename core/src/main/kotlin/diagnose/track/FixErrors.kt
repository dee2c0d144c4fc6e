package stillwater.diagnose.track

import kotlin.math.abs
import kotlin.math.exp

/**
 * How far fixes may be off after smoothing, from how they scatter: an error that keeps to itself for T fixes, an
 * Ornstein-Uhlenbeck process, is followed by the parabolas through 2 [reach] + 1 of them in part, which leave the more of
 * it the longer T is.
 *
 * How much parabolas through seven fixes miss over what those through five do is more for such an error than for one that
 * is new with each fix, and still more where the boat turns: what would be more than was found cannot be.
 *
 * @param reach fixes on either side. @property scatter standard deviation of a fix about them on either axis, m. @param
 *   ratio that about seven fixes over that about five. @param period from fix to fix, s.
 */
internal class FixErrors(private val reach: Int, val scatter: Double, ratio: Double, private val period: Double) {
    /** An error on either axis of [variance], m², that keeps to itself for [time], s. */
    class Likely(val variance: Double, val time: Double)

    private val narrow = Parabola(NARROW)
    private val wide = Parabola(WIDE)
    private val used = Parabola(reach)

    /** What is left of the errors of fixes that explain how these scatter, those that are soon others first. */
    val likely: List<Likely> = if (scatter > 0) {
        TIMES.filter { it == TIMES[0] || wide.left(it) / narrow.left(it) < SLACK * ratio * ratio }.map(::likely)
    } else {
        emptyList()
    }

    private fun likely(time: Double): Likely {
        val own = used.followed(time, 0)
        // As long as an Ornstein-Uhlenbeck process whose correlations have the same sum.
        val lags = (LONGEST * (time + reach)).toInt()
        val sum = 0.5 + (1..lags).sumOf { used.followed(time, it) } / own
        return Likely(scatter * scatter / used.left(time) * own, sum * period)
    }

    /**
     * What a parabola through [reach] even fixes on either side makes of errors of unit variance that keep to themselves for
     * some fixes (Savitzky and Golay 1964).
     */
    private class Parabola(private val reach: Int) {
        private val weights = run {
            val all = -reach..reach
            val second = all.sumOf { (it * it).toDouble() }
            val fourth = all.sumOf { (it * it).toDouble() * it * it }
            val count = 2.0 * reach + 1
            DoubleArray(2 * reach + 1) {
                val k = it - reach
                (fourth - second * k * k) / (count * fourth - second * second)
            }
        }

        /** Sums of the products of weights so many fixes apart. */
        private val products = DoubleArray(weights.size) { apart ->
            (apart until weights.size).sumOf { weights[it] * weights[it - apart] }
        }

        /** What it leaves of the error in its middle. */
        fun left(time: Double): Double =
            1 - 2 * weights.indices.sumOf { weights[it] * exp(-abs(it - reach) / time) } + followed(time, 0)

        /** The covariance of what it follows of the error, [apart] fixes apart. */
        fun followed(time: Double, apart: Int): Double =
            products[0] * exp(-apart / time) + (1 until products.size).sumOf {
                products[it] * (exp(-abs(it - apart) / time) + exp(-(it + apart) / time))
            }
    }

    private companion object {
        const val NARROW = 2
        const val WIDE = 3

        /** Times that errors may keep to themselves, fixes. */
        val TIMES = listOf(0.2, 0.6, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0)

        /** How much more than the ratio of variances found one may be that is expected. */
        const val SLACK = 1.15

        /** So many times as long there is next to no correlation left. */
        const val LONGEST = 4.0
    }
}
