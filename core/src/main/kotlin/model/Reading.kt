package stillwater.model

/**
 * One value a sensor gave, with when and where the boat was when it was sampled.
 *
 * @property time when the sample was taken.
 * @property position where the boat was at [time], local frame, m.
 * @property value what the sensor said, sensor units.
 * @property conditions what else was measured at [time].
 */
public data class Reading(
    val time: BoatTime,
    val position: Position,
    val value: Double,
    val conditions: Conditions = Conditions.NONE,
)
