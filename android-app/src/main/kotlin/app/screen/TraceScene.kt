package stillwater.app.screen

import stillwater.model.Grid

/**
 * One moment of a trace, sensor units; NaN where something is not known.
 *
 * @property seconds on the boat's clock.
 * @property reading what the probe said.
 * @property gradient of the readings, sensor units/s.
 * @property cell that the boat was in; [Grid.OUTSIDE] where it was in none.
 * @property corrected what the map believes of the cell that the boat was in.
 * @property lower its lower bound.
 * @property upper its upper bound.
 */
internal data class TraceMoment(
    val seconds: Double,
    val reading: Double,
    val gradient: Double,
    val cell: Int,
    val corrected: Double,
    val lower: Double,
    val upper: Double,
)

/** What the trace draws: [moments], oldest first, in [unit], which is empty where there is none. */
internal class TraceScene(val moments: List<TraceMoment> = emptyList(), val unit: String = "") {
    /**
     * The same moments with what the map believed when the boat left the cell, or believes by now: in the first seconds in
     * each cell nothing is known of it yet, and a curve of that would be a comb.
     */
    val settled: List<TraceMoment> by lazy(LazyThreadSafetyMode.NONE) {
        val settled = moments.toMutableList()
        for (index in settled.size - 2 downTo 0) {
            val (now, next) = settled[index] to settled[index + 1]
            if (now.cell != next.cell) continue
            settled[index] = now.copy(corrected = next.corrected, lower = next.lower, upper = next.upper)
        }
        settled
    }
}
