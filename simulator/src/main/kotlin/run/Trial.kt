package stillwater.run

import stillwater.estimate.FieldEstimator
import stillwater.field.CellField
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Plan
import stillwater.model.Position
import stillwater.plan.PlanOutcome
import stillwater.plan.Planner
import stillwater.plan.StopCondition
import stillwater.sensor.SensorModel
import kotlin.math.abs

/**
 * One boat in one field: it moves from cell to cell as its planner says, takes the same number of samples in each,
 * and several estimators read them.
 *
 * The first move is the stay in the start cell. Where the planner sees nothing to gain the boat stays for a move.
 *
 * @property field the truth.
 * @property sensor the boat's sensor, settled at the start cell's truth.
 * @property planner where to go.
 * @property estimators each gets every reading. The planner plans on the map of the first.
 * @property samplesPerMove readings taken in a cell before moving on.
 * @property period time between readings, s.
 * @property extremes for each cell of [field] whether it is a local extreme of it. Not modified.
 */
class Trial(
    private val field: CellField,
    private val sensor: SensorModel,
    private val planner: Planner,
    private val estimators: List<FieldEstimator>,
    private val samplesPerMove: Int,
    private val period: Double,
    private val extremes: BooleanArray = LocalExtremes.of(field),
) {
    private var samples = 0L
    private var reading = 0.0

    /**
     * Runs the boat from [start].
     *
     * @param start index of the start cell.
     * @param checkpoints moves after which the error is taken, ascending, each at least 1; the run ends with the last.
     * @return the errors of each estimator, in their order.
     */
    fun run(start: Int, checkpoints: IntArray): List<TrialErrors> {
        val errors = estimators.map { TrialErrors(checkpoints.size) }
        val grid = field.grid
        val plan = Plan()
        var waypoint = 0
        var x = grid.centerX(start)
        var y = grid.centerY(start)
        var checkpoint = 0
        for (move in 1..checkpoints.last()) {
            if (move > 1) {
                if (waypoint == plan.size) {
                    val outcome = planner.plan(
                        estimators.first().map,
                        Position(x, y),
                        reading,
                        StopCondition.NEVER,
                        plan,
                    )
                    check(outcome == PlanOutcome.Planned || plan.size == 0) { "$outcome with ${plan.size} waypoints" }
                    waypoint = 0
                }
                if (waypoint < plan.size) {
                    x = plan.x(waypoint)
                    y = plan.y(waypoint)
                    waypoint++
                }
            }
            stay(x, y)
            if (move == checkpoints[checkpoint]) {
                for (i in estimators.indices) take(errors[i], checkpoint, estimators[i])
                checkpoint++
            }
        }
        return errors
    }

    private fun stay(x: Double, y: Double) {
        repeat(samplesPerMove) {
            val time = BoatTime(++samples * period)
            reading = sensor.step(field.truth(x, y, time), period, Conditions.NONE)
            for (estimator in estimators) estimator.update(time, x, y, reading, Conditions.NONE)
        }
    }

    private fun take(errors: TrialErrors, checkpoint: Int, estimator: FieldEstimator) {
        val cells = field.grid.size
        val map = estimator.map
        val rounding = ROUNDING * map.prior.width
        var all = 0.0
        var inExtremes = 0.0
        var visited = 0
        var covered = 0
        var width = 0.0
        for (cell in 0 until cells) {
            val truth = field.truth(cell)
            val error = abs(map.value(cell) - truth)
            all += error
            if (extremes[cell]) inExtremes += error
            if (map.readings(cell) == 0) continue
            visited++
            if (truth >= map.lower(cell) - rounding && truth <= map.upper(cell) + rounding) covered++
            width += map.upper(cell) - map.lower(cell)
        }
        errors.mean[checkpoint] = all / cells
        errors.inExtremes[checkpoint] = inExtremes / cells
        errors.coverage[checkpoint] = covered.toDouble() / visited
        errors.width[checkpoint] = width / visited
    }

    private companion object {
        /** What a bound may miss the truth by for the numbers' own rounding, in widths of the prior. */
        const val ROUNDING = 1e-12
    }
}

/**
 * Errors of one estimator in one trial, and what its bounds are worth.
 *
 * @param checkpoints number of checkpoints.
 */
class TrialErrors(checkpoints: Int) {
    /** Mean absolute error over all cells at each checkpoint, sensor units. */
    val mean: DoubleArray = DoubleArray(checkpoints)

    /** The part of [mean] that lies in local extremes of the field, sensor units: a sum there over all cells' number. */
    val inExtremes: DoubleArray = DoubleArray(checkpoints)

    /** Share of the visited cells whose bounds hold the truth, dimensionless; bounds that crossed hold nothing. */
    val coverage: DoubleArray = DoubleArray(checkpoints)

    /** Mean width of the visited cells' bounds, sensor units; negative where they crossed. */
    val width: DoubleArray = DoubleArray(checkpoints)
}
