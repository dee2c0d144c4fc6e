package stillwater.diagnose.evidence

import stillwater.diagnose.Cause
import stillwater.diagnose.algebra.dot
import stillwater.diagnose.algebra.squares
import stillwater.diagnose.noise.CorrelatedNoise
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.NoiseSearch
import stillwater.diagnose.response.Term
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.round
import kotlin.math.sqrt
import kotlin.random.Random

/**
 * How much more a cause gains by chance where readings are coarsely rounded than normal residuals would let it.
 *
 * While the water changes slowly, rounding errs the same way for many rows: what is left is neither normal nor of one
 * spread, whatever mean and correlation are fitted. Readings are therefore simulated from [fit], which holds the
 * rounding, rounded, and asked what the cause's columns gain of their residuals; that over the same of normal noise is
 * the factor. A fixed seed: the same log has the same answer.
 *
 * @param longest longest correlation time of noise, s.
 */
internal class RoundingNull(private val fit: ModelFit, private val longest: Double) {
    private val model = fit.model
    private val series = model.series
    private val n = series.size
    private val step = model.scales.resolution
    private val random = Random(SEED)
    private val spread = fit.numbers[model.slot(model.terms.first { it.cause == Cause.QUANTISATION })]
    private val clean = DoubleArray(n).also { model.predict(fit.numbers, it, isRounded = false) }
    private val simulated: List<DoubleArray> by lazy {
        val (odds, time) = before()
        List(COUNT) { whitened(rounded(odds, time)) }
    }
    private val normal: List<DoubleArray> by lazy { List(COUNT) { DoubleArray(n) { gaussian() } } }

    /**
     * What [term] gains in [full], which is the model of this fit with it, as twice a log-likelihood less what rounding
     * alone makes of it. Rounding also lets a small change of its phase gain much; only what the residuals of this fit
     * show of the term counts.
     */
    fun gain(full: ModelFit, term: Term): Double {
        val own = columns(full, term)
        val searched: (DoubleArray) -> Double = if (term.cause == Cause.OFFSET_STEPS) ::jumps else own
        val coarse = simulated.sumOf { searched(it) / variance(it) }
        val even = normal.sumOf { searched(it) / variance(it) }
        val factor = if (even > 0) maxOf(1.0, coarse / even) else 1.0
        return minOf(full.score - fit.score, own(fit.whitened) / variance(fit.whitened)) / factor
    }

    private fun variance(z: DoubleArray) = squares(z) / maxOf(fit.noise.rows, 1)

    private fun jumps(z: DoubleArray) = JumpPlaces(fit, PLACES, z).most()

    /** What the columns of [term] in [full] explain of whitened residuals. */
    private fun columns(full: ModelFit, term: Term): (DoubleArray) -> Double {
        val slots = full.model.slotOrNull(term)?.let { it until it + full.model.width(term) }
            ?: return { 0.0 }
        val free = full.free.indices.filter { full.free[it] }
        val (own, others) = free.indices.partition { free[it] in slots }
        val basis = Evidence.orthonormal(others.map { full.jacobian[it] })
        val extra = Evidence.orthonormal(own.map { full.jacobian[it] }, basis)
        return { z -> extra.sumOf { direction -> dot(direction, z).let { it * it } } }
    }

    /**
     * Logarithm of the odds of correlated noise, and of its time, s, before it is rounded: such that rounded it looks
     * like that of [fit]. Rounding takes away correlation.
     */
    private fun before(): Pair<Double, Double> {
        val used = BooleanArray(n) { fit.whitened[it] != 0.0 }
        var odds = odds(fit.noise)
        var time = ln(fit.noise.time)
        repeat(TRIES) {
            val seen = NoiseSearch(model.scales, rounded(odds, time), used, longest).near(null)
            odds += (odds(fit.noise) - odds(seen)).coerceIn(-1.5, 1.5)
            time = (time + (ln(fit.noise.time) - ln(seen.time)).coerceIn(-0.7, 0.7)).coerceAtMost(ln(longest))
        }
        return odds to time
    }

    private fun odds(noise: CorrelatedNoise) = noise.share.coerceIn(0.02, 0.98).let { ln(it / (1 - it)) }

    /** Residuals of readings that the model made with correlated noise of [odds] and logarithm of time [logTime]. */
    private fun rounded(odds: Double, logTime: Double): DoubleArray {
        val share = 1 / (1 + exp(-odds))
        val residuals = DoubleArray(n)
        var state = gaussian()
        for (i in 0 until n) {
            val keep = if (i == 0) 1.0 else exp(-(series.times[i] - series.times[i - 1]) / exp(logTime))
            state = keep * state + sqrt(1 - keep * keep) * gaussian()
            val noise = sqrt(share) * state + sqrt(1 - share) * gaussian()
            // Prediction = reading − residual.
            val shown = fit.predicted[i]
            residuals[i] = step * round((clean[i] + spread * noise) / step) - shown
        }
        return residuals
    }

    private fun whitened(residuals: DoubleArray) = DoubleArray(n).also { fit.noise.whiten(residuals, it) }

    private fun gaussian() =
        sqrt(-2 * ln(1 - random.nextDouble())) * cos(2 * PI * random.nextDouble())

    private companion object {
        const val SEED = 20_261
        const val COUNT = 24
        const val TRIES = 4
        const val PLACES = 60
    }
}
