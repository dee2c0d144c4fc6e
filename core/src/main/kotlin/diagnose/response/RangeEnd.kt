package stillwater.diagnose.response

import stillwater.diagnose.Cause
import kotlin.math.abs
import kotlin.math.sqrt

/** Whether readings stay at an end of the range. */
internal object RangeEnd {
    private const val PART = 0.15
    private const val DEVIATIONS = 3.0

    /** Shares of the readings that are beyond where the range may end. */
    private val BEYOND = listOf(0.003, 0.01, 0.03)

    /** Numbers of [model], else those of [start], with [term]'s range ending where ever more of the readings are beyond it. */
    fun begun(model: ResponseModel, term: Term, start: DoubleArray): List<DoubleArray> {
        val sorted = model.series.values.sortedArray()
        val slot = model.slot(term)
        return BEYOND.flatMap { share ->
            val out = (share * (sorted.size - 1)).toInt()
            val above = -ResponseModel.FAR_END to sorted[sorted.size - 1 - out]
            val below = sorted[out] to ResponseModel.FAR_END
            listOf(above, below).map { (lower, upper) ->
                start.copyOf().also {
                    it[slot] = lower
                    it[slot + 1] = upper
                }
            }
        }
    }

    /**
     * Whether the readings that [fit] takes for ones at an end go on beyond it with what the model without an end
     * foretells: then the reference's extremes were its own noise, or the response is curved, and there is no end.
     */
    fun isNone(fit: ModelFit, used: BooleanArray): Boolean {
        val model = fit.model
        val term = model.terms.firstOrNull { it.cause == Cause.SATURATION } ?: return false
        val at = model.slot(term)
        val foretold = open(model, term, fit.numbers)
        var squares = 0.0
        var products = 0.0
        var scatter = 0.0
        for (i in foretold.indices) {
            if (!used[i]) continue
            val beyond =
                foretold[i] - foretold[i].coerceIn(minOf(fit.numbers[at], fit.numbers[at + 1]), fit.numbers[at + 1])
            squares += beyond * beyond
            products += beyond * fit.residuals[i]
            scatter += beyond * beyond * fit.residuals[i] * fit.residuals[i]
        }
        return products > PART * squares && products > DEVIATIONS * sqrt(scatter)
    }

    /** Those of [rows], which are not in use in [fit], that its range's ends bring back to what noise does: they are not wild. */
    fun explained(fit: ModelFit, rows: List<Int>): List<Int> {
        val term = fit.model.terms.firstOrNull { it.cause == Cause.SATURATION } ?: return emptyList()
        val open = open(fit.model, term, fit.numbers)
        val most = DEVIATIONS * sqrt(fit.variance)
        val values = fit.model.series.values
        return rows.filter { abs(values[it] - fit.predicted[it]) < most && abs(values[it] - open[it]) > most }
    }

    /** How many ends the range of [fit] has. */
    fun count(fit: ModelFit): Int {
        val term = fit.model.terms.firstOrNull { it.cause == Cause.SATURATION } ?: return 0
        val at = fit.model.slot(term)
        return (at..at + 1).count { abs(fit.numbers[it]) < ResponseModel.NO_END }
    }

    /** What [model] shows at [numbers] but for the ends of [term]. */
    private fun open(model: ResponseModel, term: Term, numbers: DoubleArray): DoubleArray {
        val at = model.slot(term)
        val open = numbers.copyOf().also {
            it[at] = -2 * ResponseModel.NO_END
            it[at + 1] = 2 * ResponseModel.NO_END
        }
        return DoubleArray(model.series.size).also { model.predict(open, it) }
    }

    /** The rows in which [model] at [numbers] is beyond an end of its range, and shows the end; null where it has none. */
    fun beyond(model: ResponseModel, numbers: DoubleArray): BooleanArray? {
        val term = model.terms.firstOrNull { it.cause == Cause.SATURATION } ?: return null
        val at = model.slot(term)
        val foretold = open(model, term, numbers)
        val shown = minOf(numbers[at], numbers[at + 1])..numbers[at + 1]
        return BooleanArray(foretold.size) { foretold[it] !in shown }
    }
}
