package stillwater.diagnose

import kotlin.math.exp

/**
 * Where a number of a given sensor would be right, once a cause lets it change with a condition.
 *
 * A sensor file says nothing of the speed, temperature or time of its calibration: a time constant that is right at one
 * speed of the log is not wrong beside a time constant that depends on speed.
 */
internal object CalibrationPoint {
    /**
     * Whether those of [numbers] of [base] that a cause of [fit] lets change with a condition are those of some row of
     * the log; an offset beside a drift also those of any time before it.
     */
    fun isInLog(fit: ModelFit, base: ModelFit, numbers: List<Int>): Boolean {
        val changing = fit.model.terms.mapNotNull { it.cause.conditionalNumber }
        return numbers.filter { it in changing }.all { isWithin(fit, base, it) }
    }

    private fun isWithin(fit: ModelFit, base: ModelFit, number: Int): Boolean {
        if (base.free[number] || !fit.free[number]) return true
        val given = base.numbers[number]
        val shown = shown(fit, number)
        val drift = fit.model.slotOrNull(Term(Cause.DRIFT))?.let { fit.numbers[it] } ?: 0.0
        val isBefore = number == ResponseModel.OFFSET && drift != 0.0
        val fromBelow = isBefore && drift > 0
        val fromAbove = isBefore && drift < 0
        return (fromBelow || given >= shown.min()) && (fromAbove || given <= shown.max())
    }

    /** [number] of [fit] as it is in each row. */
    private fun shown(fit: ModelFit, number: Int): DoubleArray {
        val model = fit.model
        val scales = model.scales
        fun of(term: Term) = model.slotOrNull(term)?.let { fit.numbers[it] } ?: 0.0
        if (number == ResponseModel.TIME_CONSTANT) {
            val flow = of(Term(Cause.FLOW_DEPENDENT_RESPONSE))
            val warmth = of(Term(Cause.TEMPERATURE_DEPENDENT_RESPONSE))
            return DoubleArray(model.series.size) {
                fit.numbers[number] * exp(-flow * scales.logSpeed[it] - warmth * scales.warmth[it])
            }
        }
        val times = model.series.times
        val drift = of(Term(Cause.DRIFT))
        val shown = DoubleArray(times.size) { fit.numbers[number] + drift * (times[it] - times[0]) }
        for ((name, column) in scales.centred) {
            val coefficient = of(Term(Cause.CROSS_SENSITIVITY, name))
            for (i in shown.indices) shown[i] += coefficient * column[i]
        }
        return shown
    }
}
