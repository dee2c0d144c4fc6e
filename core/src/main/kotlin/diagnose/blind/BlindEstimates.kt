package stillwater.diagnose.blind

import stillwater.diagnose.Estimate
import stillwater.diagnose.evidence.FitReport
import stillwater.diagnose.response.Parameter
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Term
import stillwater.diagnose.three
import stillwater.model.Interval
import kotlin.math.abs
import kotlin.math.exp

/**
 * Numbers of models of a log without a reference, whose rows are [period] s apart, with their intervals.
 *
 * @property bounds what is to be said of numbers that ended where the search does.
 */
internal class BlindEstimates(private val period: Double) {
    val bounds = ArrayList<String>()

    /** The time constant of [model] and the numbers of [terms], which may be off by [errors] on their fitted scales. */
    fun of(model: ResponseModel, numbers: DoubleArray, errors: DoubleArray, terms: List<Term>): List<Estimate> =
        (listOf(ResponseModel.TIME_CONSTANT) + terms.flatMap { t -> List(model.width(t)) { model.slot(t) + it } })
            // An end of the range that the sensor does not have is no number.
            .filter { abs(numbers[it]) < ResponseModel.NO_END }.map { i ->
                val parameter = model.parameters[i]
                // Without the one place that shows an end of the range it may be anywhere.
                val isOpen = parameter.name in ENDS && UnknownSize.isOpen(errors[i], model.scales.range)
                FitReport.slowest(model, numbers, i, bounds)
                    ?: estimate(parameter, numbers[i], if (isOpen) Double.POSITIVE_INFINITY else errors[i])
            }

    private fun estimate(parameter: Parameter, value: Double, error: Double): Estimate {
        val reach = BlindErrors.REACH * error
        if (!reach.isFinite()) return Estimate(parameter.name, parameter.unit, value, null)
        val isLowest = value <= parameter.lower * (1 + AT_END) && parameter.logarithmic
        val isHighest = value >= parameter.upper * (1 - AT_END) && parameter.logarithmic
        var lower =
            if (parameter.logarithmic) value * exp(-minOf(reach, MOST_REACH)) else parameter.possible(value - reach)
        var upper = if (parameter.logarithmic) value * exp(minOf(reach, MOST_REACH)) else value + reach
        if (isLowest) {
            // On the scale of the number itself; what is far below half a row nobody sees.
            val unseen = if (parameter.unit == "s") period / 2 else 0.0
            upper = maxOf(value * (1 + minOf(reach, MOST_FACTOR)), unseen)
            bounds += "${words(parameter)} is at the low end of what was searched: it may be anything below " +
                "${three(upper)} ${parameter.unit}."
            lower = 0.0
        }
        if (isHighest) {
            bounds += "${words(parameter)} is at the high end of what was searched: it may be anything above " +
                "${three(lower)} ${parameter.unit}."
            upper = Estimate.OPEN
        }
        return Estimate(parameter.name, parameter.unit, value, Interval(lower, upper))
    }

    private fun words(parameter: Parameter) =
        "The ${parameter.name.removeSuffix("_s").removeSuffix("_m").replace('_', ' ')}"

    companion object {
        /** Of a logarithm: an interval that reaches farther is open. */
        const val MOST_REACH = 50.0
        private const val MOST_FACTOR = 1e9
        private const val AT_END = 1e-6

        /** Ends of the range. */
        private val ENDS = setOf("lower", "upper")
    }
}
