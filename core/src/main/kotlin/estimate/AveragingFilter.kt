package stillwater.estimate

import stillwater.field.FieldMap
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval

/**
 * Takes the arithmetic mean of the readings in a cell as its value: what a map without lag compensation shows.
 *
 * Bounds stay at the prior's: a mean of lagged readings bounds nothing. Source: the report, section 7, "simple
 * averaging filter".
 *
 * @param grid the cells.
 * @param prior the range of the field; an unvisited cell has its midpoint, sensor units.
 */
public class AveragingFilter(grid: Grid, prior: Interval) : CellEstimator(grid, prior) {
    private val sums = DoubleArray(grid.size)

    /** The boat's cell, the sum of its readings, and how many of them the map has not been told of. */
    private var stayCell = Grid.OUTSIDE
    private var sum = 0.0
    private var untold = 0

    override val map: FieldMap get() {
        settle()
        return written
    }

    override fun count(cell: Int) {
        // Together, when the map is told.
    }

    override fun take(cell: Int, entered: Boolean, seconds: Double, value: Double, conditions: Conditions) {
        if (entered) enter(cell)
        sum += value
        untold++
    }

    override fun takeAll(
        cell: Int,
        entered: Boolean,
        times: DoubleArray,
        values: DoubleArray,
        count: Int,
        step: Double,
    ) {
        if (entered) enter(cell)
        var sum = sum
        for (i in 0 until count) sum += values[i]
        this.sum = sum
        untold += count
    }

    private fun enter(cell: Int) {
        settle()
        stayCell = cell
        sum = sums[cell]
    }

    /** Tells the map what it was not told. */
    private fun settle() {
        if (untold == 0) return
        val cell = stayCell
        sums[cell] = sum
        written.countReadings(cell, untold)
        written.setValue(cell, sum / written.readings(cell))
        untold = 0
    }
}

/**
 * Takes the exponential average of the readings in a cell as its value, starting from the prior's midpoint.
 *
 * value ← w · value + (1 − w) · reading, w = [oldWeight]. Bounds stay at the prior's. Source: the report's original
 * simulation, which starts at 0.5 with w = 0.9.
 *
 * @param grid the cells.
 * @param prior the range of the field; an unvisited cell has its midpoint, sensor units.
 * @property oldWeight w, dimensionless, 0 until 1.
 * @throws IllegalArgumentException if [oldWeight] is out of its range.
 */
public class ExponentialFilter(
    grid: Grid,
    prior: Interval,
    public val oldWeight: Double = 0.9,
) : CellEstimator(grid, prior) {
    init {
        require(oldWeight >= 0 && oldWeight < 1) { "oldWeight ($oldWeight) must be in [0, 1)" }
    }

    override fun take(cell: Int, entered: Boolean, seconds: Double, value: Double, conditions: Conditions) {
        map.setValue(cell, oldWeight * map.value(cell) + (1 - oldWeight) * value)
    }
}
