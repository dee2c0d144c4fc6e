package stillwater.diagnose.response

/**
 * What is taken to be in doubt of the truth that a sensor sees.
 *
 * @property between of what it may be off within usual steps, the part that it is, dimensionless; null for nothing: what is
 * unusual alone counts, as it is. @property isBeyond whether what a late sensor saw before the first row, or one ahead of the boat
 * after the last, is unknown; else it is as in that row.
 */
internal data class Doubt(val between: Double? = null, val isBeyond: Boolean = false)

/**
 * A sensor as far as it says by how much what is not known of the truth shakes its readings.
 *
 * @property timeConstants its lag before each row, s. @property gain sensor units over those of the truth. @property isHeld whether
 * the truth is held over each step. @property delay before the lag, s. @property second a lag before the first one, s; 0 for none.
 * @property swing by how much the truth may be off where the sensor is off the way, by row; null for nothing. @property beyond how
 * long before or after the log it sees what it has in each row, s; null for never.
 */
internal class Shaken(
    val timeConstants: DoubleArray,
    val gain: Double,
    val isHeld: Boolean,
    val delay: Double = 0.0,
    val second: Double = 0.0,
    val swing: DoubleArray? = null,
    val beyond: DoubleArray? = null,
)
