package stillwater.run

import stillwater.estimate.FieldEstimator
import stillwater.estimate.MapFusion
import stillwater.field.CellField
import stillwater.plan.Planner
import stillwater.sensor.SensorModel
import kotlin.math.abs

/**
 * One boat in one field: it moves as its planner says, takes the same number of samples in every move, and several
 * estimators read them.
 *
 * The first move is the stay in the start cell. Where the planner sees nothing to gain the boat stays for a move.
 *
 * @property field the truth.
 * @property sensor the boat's sensor, settled at the start cell's truth.
 * @property planner where to go.
 * @property estimators each gets every reading. The planner plans on the map of the first.
 * @property samplesPerMove readings taken in a move.
 * @property period time between readings, s.
 * @property extremes for each cell of [field] whether it is a local extreme of it. Not modified.
 * @property speed how fast it goes along its waypoints, m/s; null where it goes to one waypoint a move. See [Travel].
 * @property usesMap whether [planner] reads the map; where not, no estimator is asked for it but at a checkpoint.
 */
class Trial(
    private val field: CellField,
    private val sensor: SensorModel,
    private val planner: Planner,
    private val estimators: List<FieldEstimator>,
    private val samplesPerMove: Int,
    private val period: Double,
    private val extremes: BooleanArray = LocalExtremes.of(field),
    private val speed: Double? = null,
    private val usesMap: Boolean = true,
) {
    /**
     * Runs the boat from [start].
     *
     * @param start index of the start cell.
     * @param checkpoints moves after which the error is taken, ascending, each at least 1; the run ends with the last.
     * @return the errors of each estimator, in their order.
     */
    fun run(start: Int, checkpoints: IntArray): List<TrialErrors> {
        val travel = Travel(samplesPerMove, period, speed)
        val boat = Boat(field.grid.center(start), sensor, planner, estimators, travel)
        // A single boat's map is taken as it is.
        val fusions = estimators.map { MapFusion.INTERSECTION }
        return Fleet(field, listOf(boat), fusions, MapScore(extremes), usesMap = usesMap).run(checkpoints)
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
