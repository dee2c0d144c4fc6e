package stillwater.estimate

import stillwater.field.FieldMap
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval

/**
 * What every cell-by-cell estimator does before its own work: refuse what cannot be used, find the cell, notice that
 * the boat entered it, and count.
 *
 * A cell is entered when the last reading taken lay in another cell or in none.
 *
 * @param grid the cells.
 * @param prior the range every cell is believed to lie in before it is measured, sensor units.
 */
public abstract class CellEstimator(grid: Grid, prior: Interval) : FieldEstimator {
    final override val map: FieldMap = FieldMap(grid, prior)
    private val grid = grid
    private var lastCell = Grid.OUTSIDE
    private var lastSeconds = Double.NEGATIVE_INFINITY

    final override fun update(
        time: BoatTime,
        x: Double,
        y: Double,
        value: Double,
        conditions: Conditions,
    ): ReadingUse {
        // A sum is finite only if its terms are: one comparison for four.
        if (!(time.seconds + x + y + value).isFinite()) {
            map.countRejected()
            return ReadingUse.NOT_FINITE
        }
        if (time.seconds < lastSeconds) {
            map.countRejected()
            return ReadingUse.OUT_OF_ORDER
        }
        lastSeconds = time.seconds
        val cell = grid.cellAt(x, y)
        if (cell == Grid.OUTSIDE) {
            lastCell = Grid.OUTSIDE
            map.countOutside()
            return ReadingUse.OUTSIDE
        }
        val entered = cell != lastCell
        lastCell = cell
        if (entered) map.countVisit(cell)
        map.countReading(cell)
        take(cell, entered, time.seconds, value, conditions)
        return ReadingUse.USED
    }

    /**
     * Takes a reading that is finite, in order and in the grid.
     *
     * @param cell index of the cell it lies in.
     * @param entered whether the boat entered the cell with this reading.
     * @param seconds the reading's time on the boat's clock, s.
     * @param value what the sensor said, sensor units.
     * @param conditions what else was measured.
     */
    protected abstract fun take(cell: Int, entered: Boolean, seconds: Double, value: Double, conditions: Conditions)
}
