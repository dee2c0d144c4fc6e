package stillwater.app.screen

/**
 * One moment of a trace, sensor units; NaN where something is not known.
 *
 * @property seconds on the boat's clock.
 * @property reading what the probe said.
 * @property gradient of the readings, sensor units/s.
 * @property corrected what the map believes of the cell that the boat was in.
 * @property lower its lower bound.
 * @property upper its upper bound.
 */
internal data class TraceMoment(
    val seconds: Double,
    val reading: Double,
    val gradient: Double,
    val corrected: Double,
    val lower: Double,
    val upper: Double,
)

/** What the trace draws: [moments], oldest first, in [unit], which is empty where there is none. */
internal class TraceScene(val moments: List<TraceMoment> = emptyList(), val unit: String = "")
