package stillwater.diagnose.response

import stillwater.diagnose.Cause

/**
 * A cause as a term of a model.
 *
 * @property cause the cause. @property condition the condition it depends on, where it names one.
 * @property times when it acts, s after the first row, for jumps. @property isEitherWay whether a dead time may be below
 * 0, because the reference is late. @property isQuiet whether the condition is taken without most of its own noise.
 * @property isWithin whether it is the lag's own rate that is limited, not that of what the lag shows.
 * @property isFirst whether a dead band is one of the water, which the lag then follows, not of what the lag shows.
 * @property hasOwnStart whether what it adds to the lag has a first state of its own: of a sensor that had been in water
 * that moved each part is somewhere else.
 */
internal data class Term(
    val cause: Cause,
    val condition: String? = null,
    val times: List<Double> = emptyList(),
    val isEitherWay: Boolean = false,
    val isQuiet: Boolean = false,
    val isWithin: Boolean = false,
    val isFirst: Boolean = false,
    val hasOwnStart: Boolean = false,
) {
    /** What tells terms of one cause apart: jumps of another time, or another form of it, are the same term. */
    val key: String = cause.label + (condition?.let { " ($it)" } ?: "")

    /** The same with a quantity of its own, where it has one, without most of that one's noise. */
    fun quiet(): Term = if (cause == Cause.CROSS_SENSITIVITY) copy(isQuiet = true) else this

    /** The same with a first state of its own, where it has a state beside the lag's. */
    fun begun(): Term = if (cause in WITH_STATE) copy(hasOwnStart = true) else this

    private companion object {
        val WITH_STATE = setOf(Cause.TWO_PATH_RESPONSE, Cause.SECOND_ORDER_RESPONSE, Cause.HYSTERESIS)
    }
}

/**
 * A number of a model.
 *
 * @property name its name in JSON. @property unit its unit; empty is dimensionless.
 * @property logarithmic whether it is positive and is fitted as its logarithm.
 * @property lower lowest value allowed. @property upper highest value allowed.
 * @property neutral the value at which its term does nothing, where there is one.
 */
internal data class Parameter(
    val name: String,
    val unit: String,
    val logarithmic: Boolean,
    val lower: Double,
    val upper: Double,
    val neutral: Double = Double.NaN,
) {
    /** Whether [value] is at the lower end. */
    fun atLower(value: Double) = value <= lower + CLOSE * (if (logarithmic) lower else minOf(upper - lower, 1.0))

    /** Whether [value] is at the upper end. */
    fun atUpper(value: Double) = value >= upper - CLOSE * (if (logarithmic) upper else minOf(upper - lower, 1.0))

    /** The lower end of an interval at [value]; a dead time and a share are not below 0, whatever the errors. */
    fun possible(value: Double) = if (lower == 0.0) maxOf(value, 0.0) else value

    private companion object {
        const val CLOSE = 1e-6
    }
}
