package stillwater.diagnose

/**
 * What a simulation can get wrong about a sensor, its platform or the water.
 *
 * @property label the name used in code, files and text.
 * @property sentence what it means for the readings, one sentence.
 */
public enum class Cause(public val label: String, public val sentence: String) {
    /** The base model's time constant is wrong; possible only where the base is given. */
    TIME_CONSTANT("time-constant", "The sensor follows the water faster or slower than the model says."),

    /** The base model's gain or offset is wrong; possible only where the base is given. */
    GAIN_OFFSET("gain-offset", "The sensor has another gain or offset than the model says."),

    /** Rising and falling time constants differ. */
    ASYMMETRIC_RESPONSE("asymmetric-response", "The sensor follows a rise and a fall with different time constants."),

    /** Two lags in a row. */
    SECOND_ORDER_RESPONSE("second-order-response", "Two lags act in a row, as of a sensor behind a slow chamber."),

    /** A fast and a slow way to the probe. */
    TWO_PATH_RESPONSE("two-path-response", "Part of the sensor answers fast and another part slowly."),

    /** A pure delay. */
    DEAD_TIME("dead-time", "The sensor shows what was there a fixed time ago: water in a tube, or a late time stamp."),

    /** A largest rate of change. */
    SLEW_LIMIT("slew-limit", "The reading never changes faster than a fixed rate."),

    /** A time constant that depends on speed. */
    FLOW_DEPENDENT_RESPONSE("flow-dependent-response", "The time constant depends on the speed through the water."),

    /** A time constant that depends on temperature. */
    TEMPERATURE_DEPENDENT_RESPONSE("temperature-dependent-response", "The time constant depends on the temperature."),

    /** A reading that also shows a condition. */
    CROSS_SENSITIVITY("cross-sensitivity", "The reading also shows another quantity."),

    /** An offset that grows evenly with time. */
    DRIFT("drift", "The reading wanders off at a constant rate."),

    /** An offset that jumps. */
    OFFSET_STEPS("offset-steps", "The calibration jumps at a moment in time."),

    /** A dead band, independent of rate. */
    HYSTERESIS("hysteresis", "The reading follows only when the water has changed by more than a dead band."),

    /** A coarse last digit. */
    QUANTISATION("quantisation", "The sensor's resolution is so coarse that rounding shapes the residuals."),

    /** An end of the range. */
    SATURATION("saturation", "The reading ends at a largest or smallest value."),

    /** Single wrong readings. */
    OUTLIERS("outliers", "Single readings have little to do with the water."),

    /** The water changed during the survey. */
    TIME_VARYING_FIELD("time-varying-field", "The water itself changed while the boat was measuring."),

    /** The sensor is not where the positions are. */
    POSITION_OFFSET("position-offset", "The sensor is ahead of or behind the place to which its readings are put."),
}
