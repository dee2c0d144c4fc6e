package stillwater.estimate

import stillwater.field.FieldMap
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import kotlin.math.sqrt

/**
 * What a [SelfCalibratingEstimator] falls back on where no sensor model explains the readings: a
 * [BoundedExtendedFilter] of the same readings, which needs none.
 *
 * Its bounds always count then. Its values count where the nearest model's have run away: its time constant is longer
 * than [LONGEST] stays, so that a stay looks the same as one in water that changes evenly, and its values differ from
 * this filter's by more than [FARTHEST] times what this filter itself adds to the mean of a cell's readings. Source:
 * core/docs/SelfCalibratingEstimator.md, section "Whether the model holds".
 */
internal class Fallback(private val grid: Grid, prior: Interval) {
    private val filter = BoundedExtendedFilter(grid, prior).also { it.refreshes = false }
    private val means = DoubleArray(grid.size)
    private val squares = DoubleArray(grid.size)
    private val counts = IntArray(grid.size)
    private var allSquares = 0.0
    private var allFreedom = 0

    /** Farther from the first cell than any other is. */
    private val outside = grid.centerX(0) - 2 * (grid.columns * grid.cellWidth + grid.rows * grid.cellHeight)
    private var lastCell = Grid.OUTSIDE
    private var x = Double.NaN
    private var y = Double.NaN
    private var seconds = 0.0
    private var apart = 0.0
    private var added = 0.0

    /** Value and bounds of every cell, sensor units: of those that were brought up to date. */
    val map: FieldMap get() = filter.map

    /** Whether its values count instead of the nearest model's. */
    var isPreferred: Boolean = false
        private set

    /** A reading; if it [isUsed] by the models, it counts to its cell's [spread]. */
    fun take(cell: Int, isUsed: Boolean, seconds: Double, value: Double, conditions: Conditions) {
        this.seconds = seconds
        if (isUsed) spread(cell, value)
        if (cell != lastCell) {
            lastCell = cell
            x = grid.centerX(cell)
            y = grid.centerY(cell)
        }
        filter.update(BoatTime(seconds), x, y, value, conditions)
    }

    private fun spread(cell: Int, value: Double) {
        val off = value - means[cell]
        means[cell] += off / ++counts[cell]
        val square = off * (value - means[cell])
        squares[cell] += square
        allSquares += square
        if (counts[cell] > 1) allFreedom++
    }

    /** The boat left the last cell without a reading of where it went. */
    fun leave() {
        filter.update(BoatTime(seconds), outside, grid.centerY(0), 0.0, Conditions.NONE)
    }

    fun begin() {
        apart = 0.0
        added = 0.0
    }

    /** Brings [cell] up to date in [map]. Mostly no cell is asked for. */
    fun bring(cell: Int) = filter.bring(cell)

    /**
     * Standard deviation of the readings in a visited cell, at least that of all cells together: a few readings hardly
     * show how much the water changes. Sensor units.
     */
    fun spread(cell: Int): Double {
        val own = squares[cell] / maxOf(1, counts[cell] - 1)
        return sqrt(maxOf(own, allSquares / maxOf(1, allFreedom)))
    }

    /** Compares its value with [value] of the nearest model in a visited cell, sensor units. */
    fun compare(cell: Int, value: Double) {
        bring(cell)
        val own = map.value(cell)
        val off = value - own
        val mean = means[cell]
        apart += off * off
        added += (own - mean) * (own - mean)
    }

    /** Decides whose values count, with the model's time constant in [stays] of a mean length. */
    fun decide(stays: Double) {
        isPreferred = !(stays <= LONGEST) && !(sqrt(apart) <= FARTHEST * sqrt(added))
    }

    private companion object {
        const val FARTHEST = 2.0
        const val LONGEST = 2.0
    }
}
