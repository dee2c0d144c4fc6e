package stillwater.diagnose.response

import stillwater.diagnose.Cause

/** The numbers of the base that are wrong where this is the cause: indices into a model's numbers. */
internal val Cause.baseNumbers: List<Int>
    get() = when (this) {
        Cause.TIME_CONSTANT -> listOf(ResponseModel.TIME_CONSTANT)
        Cause.GAIN_OFFSET -> listOf(ResponseModel.GAIN, ResponseModel.OFFSET)
        else -> emptyList()
    }

/**
 * The number of a given sensor that is known for one speed, temperature, time or other condition only once this cause
 * is at work: an index into a model's numbers; null for none. Which condition the sensor was calibrated at is not said.
 */
internal val Cause.conditionalNumber: Int?
    get() = when (this) {
        Cause.FLOW_DEPENDENT_RESPONSE, Cause.TEMPERATURE_DEPENDENT_RESPONSE -> ResponseModel.TIME_CONSTANT
        Cause.CROSS_SENSITIVITY, Cause.DRIFT -> ResponseModel.OFFSET
        else -> null
    }

/** Whether this shows in how the reading follows the truth from row to row. */
internal val Cause.isTiming: Boolean
    get() = when (this) {
        Cause.ASYMMETRIC_RESPONSE,
        Cause.SECOND_ORDER_RESPONSE,
        Cause.TWO_PATH_RESPONSE,
        Cause.DEAD_TIME,
        Cause.SLEW_LIMIT,
        Cause.FLOW_DEPENDENT_RESPONSE,
        Cause.TEMPERATURE_DEPENDENT_RESPONSE,
        Cause.HYSTERESIS,
        Cause.POSITION_OFFSET,
        -> true
        else -> false
    }

/** Whether this is added to the reading, whatever the truth does. */
internal val Cause.isAdded: Boolean
    get() = when (this) {
        Cause.GAIN_OFFSET, Cause.CROSS_SENSITIVITY, Cause.DRIFT, Cause.OFFSET_STEPS, Cause.QUANTISATION -> true
        else -> false
    }

/** Whether with this a response is not the same lag all the time, or not one. Two in a row have a first state of their own. */
internal val Cause.isShapingFirst: Boolean
    get() = when (this) {
        Cause.TWO_PATH_RESPONSE,
        Cause.ASYMMETRIC_RESPONSE,
        Cause.FLOW_DEPENDENT_RESPONSE,
        Cause.TEMPERATURE_DEPENDENT_RESPONSE,
        Cause.SLEW_LIMIT,
        Cause.HYSTERESIS,
        -> true
        else -> false
    }
