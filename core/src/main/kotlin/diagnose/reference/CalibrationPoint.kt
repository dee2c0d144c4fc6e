package stillwater.diagnose.reference

import stillwater.diagnose.Cause
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Term
import stillwater.diagnose.response.conditionalNumber
import stillwater.model.Conditions
import kotlin.math.exp
import kotlin.math.ln

/**
 * Where a number of a given sensor would be right, once a cause lets it change with a condition.
 *
 * A sensor file says nothing of the speed, temperature or time of its calibration: a time constant that is right at one
 * speed of the log, or in a laboratory, is not wrong beside a time constant that depends on speed.
 */
internal object CalibrationPoint {
    /** Temperatures, °C, and speeds, m/s, at which sensors are calibrated, whatever the water is like afterwards. */
    private val TEMPERATURES = listOf(0.0, 30.0)
    private val SPEEDS = listOf(0.1, 1.0)

    /** What is 0 in fresh water at its surface. */
    private val FRESH = setOf("salinity", "conductivity", "depth")

    /** Standard errors by which a number may be off and still be the given one. */
    private const val ERRORS = 2.0

    /**
     * Whether those of [numbers] of [base] that a cause of [fit] lets change with a condition are, within their errors,
     * those of conditions of the log or of a laboratory; an offset beside a drift also those of any time before.
     */
    fun isPossible(fit: ModelFit, base: ModelFit, numbers: List<Int>): Boolean {
        val changing = fit.model.terms.mapNotNull { it.cause.conditionalNumber }
        return numbers.filter { it in changing }.all { isWithin(fit, base, it) }
    }

    private fun isWithin(fit: ModelFit, base: ModelFit, number: Int): Boolean {
        if (base.free[number] || !fit.free[number]) return true
        val off = ERRORS * fit.standardError(number)
        if (number == ResponseModel.TIME_CONSTANT) {
            val shown = timeConstants(fit)
            return base.numbers[number] in shown.start * exp(-off)..shown.endInclusive * exp(off)
        }
        val shown = offsets(fit)
        return base.numbers[number] in shown.start - off..shown.endInclusive + off
    }

    private fun ModelFit.number(term: Term) = model.slotOrNull(term)?.let { numbers[it] } ?: 0.0

    private fun timeConstants(fit: ModelFit): ClosedFloatingPointRange<Double> {
        val scales = fit.model.scales
        val tau = fit.numbers[ResponseModel.TIME_CONSTANT]
        val flow = ends(-fit.number(Term(Cause.FLOW_DEPENDENT_RESPONSE)), scales.logSpeed) {
            SPEEDS.map { ln(it / scales.ordinarySpeed) }
        }
        val warmth = ends(-fit.number(Term(Cause.TEMPERATURE_DEPENDENT_RESPONSE)), scales.warmth) {
            TEMPERATURES.map { it - scales.ordinaryTemperature }
        }
        return tau * exp(flow.start + warmth.start)..tau * exp(flow.endInclusive + warmth.endInclusive)
    }

    private fun offsets(fit: ModelFit): ClosedFloatingPointRange<Double> {
        val scales = fit.model.scales
        val drift = fit.number(Term(Cause.DRIFT))
        val all = scales.centred.map { (name, column) ->
            ends(fit.number(Term(Cause.CROSS_SENSITIVITY, name)), column) {
                elsewhere(name).map { it - scales.middles.getValue(name) }
            }
        } + ends(drift, doubleArrayOf(0.0, fit.model.series.duration)) { emptyList() }
        val offset = fit.numbers[ResponseModel.OFFSET]
        val low = if (drift > 0) Double.NEGATIVE_INFINITY else offset + all.sumOf { it.start }
        val high = if (drift < 0) Double.POSITIVE_INFINITY else offset + all.sumOf { it.endInclusive }
        return low..high
    }

    /** Where in the condition [name] an offset may have been right, whatever the log is like: at rest in fresh water. */
    private fun elsewhere(name: String) = when (name) {
        Conditions.TEMPERATURE -> TEMPERATURES
        Conditions.SPEED -> SPEEDS + 0.0
        in FRESH -> listOf(0.0)
        else -> emptyList()
    }

    /** [factor] times the lowest and the highest of [column] and [others]; 0 where it does nothing. */
    private fun ends(
        factor: Double,
        column: DoubleArray,
        others: () -> List<Double>,
    ): ClosedFloatingPointRange<Double> {
        if (factor == 0.0) return 0.0..0.0
        val all = (column.toList() + others()).map { factor * it }
        return all.min()..all.max()
    }
}
