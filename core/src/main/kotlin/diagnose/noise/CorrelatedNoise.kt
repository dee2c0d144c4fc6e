package stillwater.diagnose.noise

import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * Noise of which a share φ is correlated over a time τ and the rest is white, on the log's own times.
 *
 * e = c + w; c is an Ornstein-Uhlenbeck process of variance φ and correlation exp(−Δt/τ), w white of variance 1 − φ;
 * all times an unknown σ². Whitening is the Kalman filter of c, whose gains do not depend on the data, so that a column
 * costs O(n). Rows not in use are passed over.
 *
 * Source: Jones 1981, Fitting a continuous time autoregression to discrete data, in Applied Time Series Analysis II.
 *
 * @property times of the rows, s, kept. @property share φ, dimensionless, within 0..1. @property time τ, s, above 0. @param used whether a row counts.
 * @property shocks add what is not known of the sensor's state after a gap: a second process, filtered with the first.
 */
internal class CorrelatedNoise(
    val times: DoubleArray,
    val share: Double,
    val time: Double,
    used: BooleanArray,
    val shocks: Shocks? = null,
) {
    /** Whether a row counts; a copy, so that the noise stays what it is. */
    val used: BooleanArray = used.copyOf()

    private val keep = DoubleArray(times.size)
    private val gain = DoubleArray(times.size)
    private val scale = DoubleArray(times.size)
    private val second = if (shocks == null) gain else DoubleArray(times.size)

    /** Number of rows in use. */
    val rows: Int = used.count { it }

    /** Sum over the rows in use of ln of the innovation's variance. */
    val logDeterminant: Double

    /** The part of the innovations' variance, on average, that is white noise of the row itself; dimensionless. */
    val freshShare: Double

    init {
        var variance = share
        var both = 0.0
        var shaken = 0.0
        var step = Double.NaN
        var factor = 1.0
        var lastInnovation = 0.0
        var inverse = 0.0
        var logarithm = 0.0
        var sum = 0.0
        var fresh = 0.0
        for (i in times.indices) {
            val dt = if (i == 0) 0.0 else times[i] - times[i - 1]
            // Even times differ by a rounding error.
            if (!(abs(dt - step) < SAME * dt)) {
                factor = exp(-dt / time)
                step = dt
            }
            keep[i] = factor
            variance = factor * factor * variance + share * (1 - factor * factor)
            if (shocks != null) {
                both *= factor * shocks.keep[i]
                shaken = shocks.keep[i] * shocks.keep[i] * shaken + shocks.variance[i]
            }
            if (!used[i]) continue
            val innovation = variance + 2 * both + shaken + 1 - share + SMALLEST
            val first = variance + both
            // Among even rows the filter soon stands still.
            if (abs(innovation - lastInnovation) > SAME_VARIANCE * innovation) {
                lastInnovation = innovation
                inverse = 1 / sqrt(innovation)
                logarithm = ln(innovation)
            }
            gain[i] = first / innovation
            scale[i] = inverse
            variance -= gain[i] * first
            if (shocks != null) {
                second[i] = (both + shaken) / innovation
                both -= gain[i] * (both + shaken)
                shaken -= second[i] * (second[i] * innovation)
            }
            sum += logarithm
            fresh += (1 - share) * inverse * inverse
        }
        logDeterminant = sum
        freshShare = (fresh / maxOf(rows, 1)).coerceIn(0.0, 1.0)
    }

    /** Whitens [column] into [out], which may be the same, both of length n; rows not in use become 0. */
    fun whiten(column: DoubleArray, out: DoubleArray) {
        if (shocks != null) return whiten(column, out, shocks.keep)
        var state = 0.0
        for (i in column.indices) {
            state *= keep[i]
            if (used[i]) {
                val innovation = column[i] - state
                out[i] = innovation * scale[i]
                state += gain[i] * innovation
            } else {
                out[i] = 0.0
            }
        }
    }

    /** Whitens [columns], which are modified, two at a time. */
    fun whitenAll(columns: List<DoubleArray>) {
        for (k in 1 until columns.size step 2) whitenBoth(columns[k - 1], columns[k])
        if (columns.size % 2 == 1) whiten(columns.last(), columns.last())
    }

    /** Whitens [one] and [two], which are modified, at the price of little more than one. */
    fun whitenBoth(one: DoubleArray, two: DoubleArray) {
        if (shocks != null) return whitenBoth(one, two, shocks.keep)
        var state = 0.0
        var stateTwo = 0.0
        for (i in one.indices) {
            state *= keep[i]
            stateTwo *= keep[i]
            if (used[i]) {
                val innovation = one[i] - state
                val innovationTwo = two[i] - stateTwo
                one[i] = innovation * scale[i]
                two[i] = innovationTwo * scale[i]
                state += gain[i] * innovation
                stateTwo += gain[i] * innovationTwo
            } else {
                one[i] = 0.0
                two[i] = 0.0
            }
        }
    }

    private fun whitenBoth(one: DoubleArray, two: DoubleArray, fade: DoubleArray) {
        var state = 0.0
        var stateTwo = 0.0
        var shaken = 0.0
        var shakenTwo = 0.0
        for (i in one.indices) {
            state *= keep[i]
            stateTwo *= keep[i]
            shaken *= fade[i]
            shakenTwo *= fade[i]
            if (used[i]) {
                val innovation = one[i] - state - shaken
                val innovationTwo = two[i] - stateTwo - shakenTwo
                one[i] = innovation * scale[i]
                two[i] = innovationTwo * scale[i]
                state += gain[i] * innovation
                stateTwo += gain[i] * innovationTwo
                shaken += second[i] * innovation
                shakenTwo += second[i] * innovationTwo
            } else {
                one[i] = 0.0
                two[i] = 0.0
            }
        }
    }

    /**
     * Writes Wᵀ [whitened] into [out], which may be the same, where whitening is W: what [whitened] is with a whitened
     * column is what [out] is with the column.
     */
    fun turned(whitened: DoubleArray, out: DoubleArray) {
        if (shocks != null) return turned(whitened, out, shocks.keep)
        var state = 0.0
        for (i in whitened.indices.reversed()) {
            val innovation = if (used[i]) gain[i] * state + scale[i] * whitened[i] else 0.0
            out[i] = innovation
            state = keep[i] * (state - innovation)
        }
    }

    private fun turned(whitened: DoubleArray, out: DoubleArray, fade: DoubleArray) {
        var state = 0.0
        var shaken = 0.0
        for (i in whitened.indices.reversed()) {
            val innovation =
                if (used[i]) gain[i] * state + second[i] * shaken + scale[i] * whitened[i] else 0.0
            out[i] = innovation
            state = keep[i] * (state - innovation)
            shaken = fade[i] * (shaken - innovation)
        }
    }

    private fun whiten(column: DoubleArray, out: DoubleArray, fade: DoubleArray) {
        var state = 0.0
        var shaken = 0.0
        for (i in column.indices) {
            state *= keep[i]
            shaken *= fade[i]
            if (used[i]) {
                val innovation = column[i] - state - shaken
                out[i] = innovation * scale[i]
                state += gain[i] * innovation
                shaken += second[i] * innovation
            } else {
                out[i] = 0.0
            }
        }
    }

    /**
     * What says of each row that its reading alone is off, in the unit of [whitened]: Wᵀz over the length of We, where e is
     * 1 in that row; 0 of rows not in use. Noise that wanders has two innovations of a wild reading, there and back.
     */
    fun impulses(whitened: DoubleArray): DoubleArray {
        val out = DoubleArray(whitened.size).also { turned(whitened, it) }
        // The square sum of the innovations from row i on of states (s, t) is a s² + 2 b s t + c t² before it.
        var a = 0.0
        var b = 0.0
        var c = 0.0
        for (i in out.indices.reversed()) {
            val fade = shocks?.keep?.get(i) ?: 0.0
            if (used[i]) {
                val g = gain[i]
                val h = if (shocks == null) 0.0 else second[i]
                val square = scale[i] * scale[i]
                val later = a * g * g + 2 * b * g * h + c * h * h
                out[i] /= sqrt(square + later)
                val first = a * g + b * h
                val other = b * g + c * h
                a += square + later - 2 * first
                b += square + later - first - other
                c += square + later - 2 * other
            }
            a *= keep[i] * keep[i]
            b *= keep[i] * fade
            c *= fade * fade
        }
        return out
    }

    /** Whether [other], of the same log, whitens in the same way. */
    fun isSame(other: CorrelatedNoise): Boolean =
        share == other.share && time == other.time && shocks === other.shocks && used.contentEquals(other.used)

    /** The same noise where [rows] alone are in use. */
    fun over(rows: BooleanArray) = CorrelatedNoise(times, share, time, rows, shocks)

    /**
     * Twice the log-likelihood, less a constant, of whitened residuals with the square sum [squares]; σ² is profiled.
     */
    fun twiceLogLikelihood(squares: Double): Double = twiceLogLikelihood(squares, rows, logDeterminant)

    companion object {
        /** Part of the variance that is added to each innovation's, so that none is 0. */
        const val SMALLEST = 1e-9

        /** Part of a step by which another one differs by rounding alone. */
        const val SAME = 1e-9
        private const val SAME_VARIANCE = 1e-13
        private const val TINY = 1e-290

        /**
         * Twice the log-likelihood, less a constant, of the whitened residuals of so many [rows] with the square sum
         * [squares]; σ² is profiled.
         */
        fun twiceLogLikelihood(squares: Double, rows: Int, logDeterminant: Double): Double =
            -rows * ln(maxOf(squares, TINY) / maxOf(rows, 1)) - logDeterminant
    }
}
