package stillwater.diagnose.evidence

import stillwater.diagnose.Cause
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.algebra.dot
import stillwater.diagnose.algebra.squares
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Term
import stillwater.estimate.Turns
import stillwater.estimate.straight

/**
 * What a linear response of any shape would show in a log whose reference hardly turns.
 *
 * Where the truth goes one way, or there and back once, what goes with the value, with the time or with the direction is much the
 * same as a response that is not quite of first order: a jump while the reading still follows a step, an end of the range where
 * the log began. Only what such a response cannot do then tells of another cause.
 *
 * @param base the model without the cause.
 */
internal class AnyResponse(private val base: ModelFit) {
    private val series = base.model.series
    private val truth = requireNotNull(series.reference) { "there is a reference to respond to" }

    /** Changes of the truth that a reading sees between two lags, by column, length n. */
    private val columns by lazy {
        val edges = edges(series.period, LAGS * base.numbers[ResponseModel.TIME_CONSTANT])
        edges.zipWithNext { from, to -> DoubleArray(series.size) { seen(it, from) - seen(it, to) } }
    }

    /**
     * Probability by chance of what [fit], the base with [term], explains beyond any linear response, with [degrees] numbers
     * more; 0 where the reference turns often enough or the term is a shape of response itself.
     */
    fun pValue(fit: ModelFit, term: Term, degrees: Int): Double {
        if (term.cause !in CONFUSED || !hardlyTurns(series)) return 0.0
        val shown = whitened(fit, DoubleArray(series.size) { fit.predicted[it] - base.predicted[it] })
        val slot = fit.model.slotOrNull(term)
        val own = if (slot == null) IntRange.EMPTY else slot until slot + fit.model.width(term)
        val kept = fit.free.indices.filter { fit.free[it] }.zip(fit.jacobian.toList()).filter { it.first !in own }
        val others = kept.map { it.second } + columns.map { whitened(fit, it) }
        val direction = Evidence.orthonormal(listOf(shown), Evidence.orthonormal(others))
        if (direction.isEmpty()) return 1.0
        val explained = dot(direction.single(), shown).let { it * it }
        val left = squares(fit.whitened)
        val ratio = Evidence.ratio(left + explained, left, fit.noise.rows)
        return Evidence.pValue(ratio / Evidence.inflation(direction, fit.whitened), degrees)
    }

    private fun whitened(fit: ModelFit, column: DoubleArray) =
        DoubleArray(column.size).also { fit.noise.whiten(column, it) }

    /** The truth [lag] s before row [i]; before the log that of its first row. */
    private fun seen(i: Int, lag: Double): Double = truth.straight(series.times, series.times[i] - lag)

    companion object {
        /** What a response of another shape does as well where the truth hardly turns. */
        private val CONFUSED = setOf(
            Cause.OFFSET_STEPS,
            Cause.SATURATION,
            Cause.HYSTERESIS,
            Cause.DRIFT,
            Cause.CROSS_SENSITIVITY,
            Cause.TEMPERATURE_DEPENDENT_RESPONSE,
            Cause.FLOW_DEPENDENT_RESPONSE,
            Cause.ASYMMETRIC_RESPONSE,
        )

        private const val FEW_TURNS = 1

        /** Time constants for which a response is followed. */
        private const val LAGS = 6.0

        /** Whether the reference of [series] turns at most once. */
        fun hardlyTurns(series: MeasuredSeries): Boolean = series.reference?.let { Turns.of(it) <= FEW_TURNS } == true

        /** Lags, s, from none to at least [last], a row of [period] s apart at first and then ever farther. */
        private fun edges(period: Double, last: Double): List<Double> {
            val edges = mutableListOf(0.0)
            var step = 1
            while (edges.last() < last) {
                repeat(2) { edges += edges.last() + step * period }
                step *= 2
            }
            return edges
        }
    }
}
