package stillwater.diagnose.reference

import stillwater.diagnose.evidence.BeyondDoubt
import stillwater.diagnose.response.Doubt
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.NoiseSearch
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.UnknownTruth
import kotlin.math.abs

/**
 * Finds what is to be taken as in doubt of the truth for the residuals of [fit] to be likeliest.
 *
 * How far the truth is off between the rows is known to a factor only. Each model has its own, so that the likelihoods of two are
 * of what they explain.
 *
 * @param unknown what the reference leaves open. @param longest longest correlation time of noise, s.
 */
internal class DoubtSearch(private val fit: ModelFit, private val unknown: UnknownTruth, private val longest: Double) {
    private val model = fit.model
    private val spread = fit.spread
    private val sensor = model.shaken(fit.numbers)
    private val start = model.scales.doubt

    /** A wild reading beside what is in doubt would make all of that as large. */
    private val rows = BeyondDoubt(fit).let { wild ->
        BooleanArray(fit.noise.used.size) { fit.noise.used[it] && it !in wild }
    }
    private var best = start
    private var score = Double.NEGATIVE_INFINITY

    /** What is likeliest near what the fit has. */
    fun likeliest(): Doubt {
        val isLate = sensor.beyond != null
        val between = start.between ?: FIRST.takeIf { isApart(model, fit.numbers, spread, unknown) }
        if (between == null && !isLate) return Doubt()
        offer(Doubt(between, isLate && start.isBeyond))
        if (isLate) offer(Doubt(between, !start.isBeyond))
        if (between != null) {
            for (factor in FACTORS) {
                // What is no more likely with any is left as it was.
                val middle = best.between ?: return best
                offer(best.copy(between = minOf(middle * factor, MOST)))
                offer(best.copy(between = maxOf(middle / factor, LEAST)))
            }
        }
        return best
    }

    private fun offer(doubt: Doubt) {
        val scales = model.scales.shaken(unknown, unknown.shocks(sensor, spread, doubt), doubt)
        val search = NoiseSearch(scales, fit.residuals, rows, longest)
        search.near(fit.noise)
        if (search.score > score) {
            score = search.score
            best = doubt
        }
    }

    companion object {
        /** What is tried first. */
        const val FIRST = 0.5
        private const val LEAST = 0.01
        private const val MOST = 2.0

        /** Steps of the search: the last leaves a likelihood less than a unit below the best. */
        private val FACTORS = doubleArrayOf(2.0, 2.0, 1.4, 1.2, 1.1)

        /** Of the noise's deviation: what rows leave open counts from here on. */
        private const val COUNTS = 0.1

        /** Whether rows are so far apart for the water that [model] at [numbers], under noise of [spread], shows it. */
        fun isApart(model: ResponseModel, numbers: DoubleArray, spread: Double, unknown: UnknownTruth): Boolean {
            if (unknown.isSharp || model.series.isSparse || model.steps.isHeld) return false
            return unknown.usual(model.lags(numbers)) * abs(numbers[ResponseModel.GAIN]) > COUNTS * spread
        }
    }
}
