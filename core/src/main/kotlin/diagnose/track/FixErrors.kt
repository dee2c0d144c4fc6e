package stillwater.diagnose.track

import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.sqrt

/**
 * How far fixes may be off after smoothing, from how they scatter: an error that keeps to itself for T fixes, an
 * Ornstein-Uhlenbeck process, is followed by the parabolas through 2 [reach] + 1 of them in part, which leave the more of
 * it the longer T is.
 *
 * How much parabolas through seven fixes miss over what those through five do is more for such an error than for one that
 * is new with each fix, and still more where the boat turns: what would be more than was found cannot be.
 *
 * Fixes jitter and wander at once. Where those about parabolas through five and about far wider ones are both known, each time
 * has a variance of both kinds.
 *
 * @property reach fixes on either side. @property scatter standard deviation of a fix about them on either axis, m. @param
 *   ratio that about seven fixes over that about five. @param period from fix to fix, s. @param near that about five, m, beside
 *   which [scatter] is about far more; null where only how these follow each other is asked.
 */
internal class FixErrors(
    val reach: Int,
    val scatter: Double,
    ratio: Double,
    private val period: Double,
    private val near: Double? = null,
) {
    /**
     * An error on either axis of [variance], m², that keeps to itself for [time], s: what is left in the course of an error of
     * the fixes themselves of [fixes], m, that does for [fixTime], s, a fix at the least.
     */
    class Likely(val variance: Double, val time: Double, val fixes: Double, val fixTime: Double)

    /** Whether the course leaves more of the errors than fixes say by themselves: nothing quick of them is left in it. */
    val isWide: Boolean = near != null
    private val narrow = Parabola(NARROW)
    private val wide = Parabola(WIDE)
    private val used = Parabola(reach)

    /** What is left of the errors of fixes that explain how these scatter, those that are soon others first. */
    val likely: List<Likely> by lazy {
        val two = if (near != null) LONG_TIMES.mapNotNull { beside(it, near * near) } else emptyList()
        val times = if (near != null) TIMES.take(1) else TIMES
        val keep = times.filter { it == TIMES[0] || wide.left(it) / narrow.left(it) < SLACK * ratio * ratio }
        if (scatter > 0) two.ifEmpty { keep.map { likely(it, alone(it)) } } else emptyList()
    }

    /** The variance of errors that keep to themselves for [time] fixes, where there are no others, m². */
    private fun alone(time: Double) = scatter * scatter / used.left(time)

    /**
     * The same beside errors that are new with each fix, which with them scatter by the variance [close], m², about parabolas
     * through five fixes; null where no such two explain both scatters.
     */
    private fun beside(time: Double, close: Double): Likely? {
        val fresh = TIMES[0]
        val far = scatter * scatter
        val whole = narrow.left(fresh) * used.left(time) - narrow.left(time) * used.left(fresh)
        val variance = (narrow.left(fresh) * far - used.left(fresh) * close) / whole
        val new = (used.left(time) * close - narrow.left(time) * far) / whole
        val isPossible = whole > 0 && variance > 0 && new * narrow.left(fresh) > (1 - SLACK) * close
        return if (isPossible) likely(time, variance) else null
    }

    private fun likely(time: Double, variance: Double): Likely {
        val own = used.followed(time, 0)
        // As long as an Ornstein-Uhlenbeck process whose correlations have the same sum.
        val lags = (LONGEST * (time + reach)).toInt()
        val sum = 0.5 + (1..lags).sumOf { used.followed(time, it) } / own
        return Likely(variance * own, sum * period, sqrt(variance), maxOf(time, 1.0) * period)
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

        /** The same that only far wider parabolas show. */
        val LONG_TIMES = listOf(4.0, 8.0, 16.0, 32.0, 64.0, 128.0)

        /** How much more than the ratio of variances found one may be that is expected. */
        const val SLACK = 1.15

        /** So many times as long there is next to no correlation left. */
        const val LONGEST = 4.0
    }
}
