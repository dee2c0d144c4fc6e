package stillwater.diagnose

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
 * @property times of the rows, s. @property share φ, dimensionless, within 0..1. @property time τ, s, above 0. @property used whether a row counts.
 * @property shocks add what is not known of the sensor's state after a gap: a second process, filtered with the first.
 */
internal class CorrelatedNoise(
    val times: DoubleArray,
    val share: Double,
    val time: Double,
    val used: BooleanArray,
    val shocks: UnknownTruth.Shocks? = null,
) {
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
        var sum = 0.0
        var fresh = 0.0
        filter(times, share, time, used, shocks) { i, fade, gained, scaled, shaken, logarithm ->
            keep[i] = fade
            if (used[i]) {
                gain[i] = gained
                scale[i] = scaled
                if (shocks != null) second[i] = shaken
                sum += logarithm
                fresh += (1 - share) * scaled * scaled
            }
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
        private const val SAME = 1e-9
        private const val SAME_VARIANCE = 1e-13
        private const val TINY = 1e-290
        private val SHARES = doubleArrayOf(0.0, 0.2, 0.5, 0.8, 0.95, 0.99)
        private val STEPS = doubleArrayOf(1.5, 4.0, 10.0, 25.0, 60.0, 150.0)
        private const val REFINEMENTS = 4

        /** White noise. */
        fun white(scales: Scales, used: BooleanArray) =
            CorrelatedNoise(scales.series.times, 0.0, 1.0, used, scales.shocks)

        private fun twiceLogLikelihood(squares: Double, rows: Int, logDeterminant: Double) =
            -rows * ln(maxOf(squares, TINY) / maxOf(rows, 1)) - logDeterminant

        /**
         * The Kalman filter of the noise, which tells [row] of each row i what is left of the process since the one before and,
         * of one in use, its gain, one over the innovation's deviation, the gain of what [shocks] leave open, and ln of
         * the innovation's variance.
         */
        private inline fun filter(
            times: DoubleArray,
            share: Double,
            time: Double,
            used: BooleanArray,
            shocks: UnknownTruth.Shocks?,
            row: (i: Int, keep: Double, gain: Double, scale: Double, second: Double, logarithm: Double) -> Unit,
        ) {
            var variance = share
            var both = 0.0
            var shaken = 0.0
            var step = Double.NaN
            var factor = 1.0
            var gain = 0.0
            var second = 0.0
            var lastInnovation = 0.0
            var scale = 0.0
            var logarithm = 0.0
            var isStill = false
            for (i in times.indices) {
                val dt = if (i == 0) 0.0 else times[i] - times[i - 1]
                // Even times differ by a rounding error.
                if (!(abs(dt - step) < SAME * dt)) {
                    factor = exp(-dt / time)
                    step = dt
                    isStill = false
                }
                // Among even rows the filter soon stands still, to the last bit: all is as in the row before.
                if (!isStill || !used[i]) {
                    val before = variance
                    variance = factor * factor * variance + share * (1 - factor * factor)
                    if (shocks != null) {
                        both *= factor * shocks.keep[i]
                        shaken = shocks.keep[i] * shocks.keep[i] * shaken + shocks.variance[i]
                    }
                    if (used[i]) {
                        val innovation = variance + 2 * both + shaken + 1 - share + SMALLEST
                        val first = variance + both
                        gain = first / innovation
                        if (abs(innovation - lastInnovation) > SAME_VARIANCE * innovation) {
                            lastInnovation = innovation
                            scale = 1 / sqrt(innovation)
                            logarithm = ln(innovation)
                        }
                        variance -= gain * first
                        if (shocks != null) {
                            second = (both + shaken) / innovation
                            both -= gain * (both + shaken)
                            shaken -= second * (second * innovation)
                        }
                    }
                    isStill = used[i] && shocks == null && variance == before
                }
                row(i, factor, gain, scale, second, logarithm)
            }
        }

        /** Twice the log-likelihood of [residuals], less a constant, under noise of which nothing is kept. */
        private fun score(
            residuals: DoubleArray,
            times: DoubleArray,
            share: Double,
            time: Double,
            used: BooleanArray,
            shocks: UnknownTruth.Shocks?,
        ): Double {
            var state = 0.0
            var open = 0.0
            var squares = 0.0
            var sum = 0.0
            var rows = 0
            filter(times, share, time, used, shocks) { i, keep, gain, scale, second, logarithm ->
                state *= keep
                if (shocks != null) open *= shocks.keep[i]
                if (used[i]) {
                    val innovation = residuals[i] - state - open
                    val white = innovation * scale
                    squares += white * white
                    state += gain * innovation
                    if (shocks != null) open += second * innovation
                    sum += logarithm
                    rows++
                }
            }
            return twiceLogLikelihood(squares, rows, sum)
        }

        /**
         * The noise under which [residuals] are likeliest; correlation times reach [longest] s. Looked for everywhere,
         * or near [guess] alone. Not modified.
         */
        fun of(
            scales: Scales,
            residuals: DoubleArray,
            used: BooleanArray,
            longest: Double,
            guess: CorrelatedNoise? = null,
        ): CorrelatedNoise {
            val series = scales.series
            val shocks = scales.shocks
            var bestShare = 0.0
            var bestTime = series.period
            var bestScore = score(residuals, series.times, bestShare, bestTime, used, shocks)
            fun offer(anyShare: Double, anyTime: Double) {
                val share = anyShare.coerceIn(0.0, 1.0)
                val time = anyTime.coerceIn(series.period / 2, longest)
                val score = score(residuals, series.times, share, time, used, shocks)
                if (score > bestScore) {
                    bestShare = share
                    bestTime = time
                    bestScore = score
                }
            }
            if (guess != null) offer(guess.share, guess.time)
            if (guess == null || guess.share == 0.0) {
                for (share in SHARES) for (step in STEPS) if (share > 0) offer(share, step * series.period)
            }
            var width = if (guess == null) 1.0 else 0.5
            repeat(if (guess == null) REFINEMENTS else REFINEMENTS - 1) {
                val share = bestShare.coerceIn(0.01, 0.999)
                val odds = ln(share / (1 - share))
                for (s in -1..1) {
                    for (t in -1..1) {
                        if (s == 0 && t == 0) continue
                        offer(1 / (1 + exp(-(odds + s * width))), bestTime * exp(t * width / 2))
                    }
                }
                width /= 2
            }
            return CorrelatedNoise(series.times, bestShare, bestTime, used, shocks)
        }
    }
}

/** Sum of squares. */
internal fun squares(numbers: DoubleArray): Double {
    var sum = 0.0
    for (number in numbers) sum += number * number
    return sum
}
