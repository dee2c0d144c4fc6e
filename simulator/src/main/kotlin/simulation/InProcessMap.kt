package stillwater.simulation

import stillwater.estimate.FieldEstimator
import stillwater.estimate.update
import stillwater.field.FieldMap
import stillwater.mission.MissionSpec
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Position
import stillwater.model.Reading

/**
 * What the mission's estimator makes of the same readings without the stack around it: as in `benchmark`, each reading goes
 * straight into the estimator with the place where the boat really was, and cells left without a reading are told.
 *
 * What the mission's map is worse by is the stack's own part: fixes, delay and clocks.
 */
object InProcessMap {
    /** The map of [readings] along the true [track] with the estimator of [spec]. */
    fun of(spec: MissionSpec, track: SailedTrack, readings: List<Reading>): FieldMap {
        val grid = spec.grid.grid()
        val estimator: FieldEstimator = spec.estimator.build(grid, spec.probe)
        var next = 0
        var watched = NOWHERE
        var hasReading = false
        var left = Position(0.0, 0.0)
        var leftAt = 0.0
        for (step in 0 until track.size) {
            // The mission, too, watches the cell that the boat was in when what it hears now was sampled.
            val time = track.time(step) - spec.probe.latency
            if (time < track.time(0)) continue
            val place = track.at(time)
            val cell = grid.cellAt(place)
            if (cell != watched) {
                if (watched != NOWHERE && !hasReading) estimator.update(BoatTime(leftAt), left.x, left.y, Double.NaN)
                watched = cell
                hasReading = false
            }
            left = place
            leftAt = time
            while (next < readings.size && readings[next].time.seconds <= time) {
                val reading = readings[next++]
                val truly = track.at(reading.time.seconds)
                // As in the benchmark, nothing is said of how well the place is known.
                estimator.update(reading.copy(position = truly, conditions = Conditions.NONE))
                if (grid.cellAt(truly) == watched) hasReading = true
            }
        }
        return estimator.map
    }

    private const val NOWHERE = Grid.OUTSIDE - 1
}
