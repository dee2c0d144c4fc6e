package stillwater.diagnose.response

import stillwater.diagnose.noise.CorrelatedNoise
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.ln

/**
 * Finds the [CorrelatedNoise] under which residuals are likeliest.
 *
 * Of a correlation time the likelihoods of several shares are found in one pass: each filter waits for its own row
 * before, and the others go on meanwhile.
 *
 * @param scales of the log, and what is not known of the sensor's state. @param residuals as long as the log; not modified. @param used whether a row counts. @param longest longest
 * correlation time, s.
 */
internal class NoiseSearch(
    private val scales: Scales,
    private val residuals: DoubleArray,
    private val used: BooleanArray,
    private val longest: Double,
) {
    private val series = scales.series
    private val shocks = scales.shocks
    private var share = 0.0
    private var time = series.period

    /** Twice the log-likelihood, less a constant, of the noise that [near] found. */
    var score: Double = Double.NEGATIVE_INFINITY
        private set

    /** The likeliest noise, looked for everywhere, or near [guess] alone. */
    fun near(guess: CorrelatedNoise?): CorrelatedNoise {
        score = Double.NEGATIVE_INFINITY
        offer(series.period, 0.0)
        if (guess != null) offer(guess.time, guess.share)
        if (guess == null || guess.share == 0.0) for (step in STEPS) offer(step * series.period, *SHARES)
        var width = if (guess == null) 1.0 else 0.5
        repeat(if (guess == null) REFINEMENTS else REFINEMENTS - 1) {
            refine(width)
            width /= 2
        }
        return CorrelatedNoise(series.times, share, time, used, shocks)
    }

    /** Offers what is beside the likeliest so far: log odds [width] away, correlation times by half of it as a logarithm. */
    private fun refine(width: Double) {
        val middle = share.coerceIn(0.01, 0.999)
        val odds = ln(middle / (1 - middle))
        val shares = DoubleArray(3) { 1 / (1 + exp(-(odds + (it - 1) * width))) }
        val center = time
        offer(center, shares.first(), shares.last())
        for (t in intArrayOf(-1, 1)) offer(center * exp(t * width / 2), *shares)
    }

    private fun offer(anyTime: Double, vararg shares: Double) {
        val near = anyTime.coerceIn(series.period / 2, longest)
        val scores = scores(near, shares)
        for (k in shares.indices) {
            if (!(scores[k] > score)) continue
            share = shares[k]
            time = near
            score = scores[k]
        }
    }

    /**
     * Twice the log-likelihood, less a constant, of the residuals under noise of which [shares] are correlated over
     * [time] s.
     */
    fun scores(time: Double, shares: DoubleArray): DoubleArray {
        val filters = Array(shares.size) { Filter(shares[it]) }
        var step = Double.NaN
        var fade = 1.0
        var rows = 0
        for (i in residuals.indices) {
            val dt = if (i == 0) 0.0 else series.times[i] - series.times[i - 1]
            // Even times differ by a rounding error.
            if (!(abs(dt - step) < CorrelatedNoise.SAME * dt)) {
                fade = exp(-dt / time)
                step = dt
            }
            for (filter in filters) {
                filter.predict(fade)
                if (shocks != null) filter.shake(fade, shocks.keep[i], shocks.variance[i])
                if (used[i]) filter.update(residuals[i], shocks != null)
            }
            if (used[i]) rows++
        }
        return DoubleArray(shares.size) {
            CorrelatedNoise.twiceLogLikelihood(filters[it].squares, rows, filters[it].logDeterminant)
        }
    }

    /** The Kalman filter of noise with a correlated [share], of which nothing but the likelihood is kept. */
    private class Filter(private val share: Double) {
        private val own = 1 - share + CorrelatedNoise.SMALLEST
        private var variance = share
        private var state = 0.0
        private var both = 0.0
        private var shaken = 0.0
        private var open = 0.0
        private var product = 1.0
        private var logarithms = 0.0

        /** Sum of the whitened squares. */
        var squares = 0.0
            private set

        /** Sum of ln of the innovations' variances. */
        val logDeterminant: Double get() = logarithms + ln(product)

        fun predict(fade: Double) {
            val kept = fade * fade
            variance = kept * variance + share * (1 - kept)
            state *= fade
        }

        /** What is not known of the sensor's state, of which [keep] is left and [added] is new. */
        fun shake(fade: Double, keep: Double, added: Double) {
            both *= fade * keep
            shaken = keep * keep * shaken + added
            open *= keep
        }

        fun update(residual: Double, isShaken: Boolean) {
            val first = variance + both
            val second = both + shaken
            val spread = if (isShaken) first + second + own else first + own
            val inverse = 1 / spread
            val innovation = residual - state - open
            val part = innovation * inverse
            squares += innovation * part
            multiply(spread)
            state += first * part
            variance -= first * first * inverse
            if (!isShaken) return
            open += second * part
            both -= first * second * inverse
            shaken -= second * second * inverse
        }

        /** A logarithm of many rows' product at once, before it runs over. */
        private fun multiply(spread: Double) {
            product *= spread
            if (product < SMALL || product > LARGE) {
                logarithms += ln(product)
                product = 1.0
            }
        }
    }

    private companion object {
        val SHARES = doubleArrayOf(0.2, 0.5, 0.8, 0.95, 0.99)
        val STEPS = doubleArrayOf(1.5, 4.0, 10.0, 25.0, 60.0, 150.0)
        const val REFINEMENTS = 4
        const val SMALL = 1e-200
        const val LARGE = 1e200
    }
}
