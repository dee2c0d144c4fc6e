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
 * A cell is entered when the last reading with a time and a place lay in another cell or in none. A reading without a
 * value counts too: it tells that the boat left.
 *
 * @param grid the cells.
 * @param prior the range every cell is believed to lie in before it is measured, sensor units.
 */
public abstract class CellEstimator(grid: Grid, prior: Interval) : FieldEstimator {
    final override val map: FieldMap = FieldMap(grid, prior)
    private val grid = grid
    private var lastCell = Grid.OUTSIDE
    private var placeX = Double.NaN
    private var placeY = Double.NaN
    private var placeCell = Grid.OUTSIDE
    private var lastSeconds = Double.NEGATIVE_INFINITY

    final override fun update(
        time: BoatTime,
        x: Double,
        y: Double,
        value: Double,
        conditions: Conditions,
    ): ReadingUse {
        if (!time.seconds.isFinite() || !x.isFinite() || !y.isFinite() || !value.isFinite()) {
            map.countRejected()
            noticeMove(time, x, y)
            return ReadingUse.NOT_FINITE
        }
        if (time.seconds < lastSeconds) {
            map.countRejected()
            return ReadingUse.OUT_OF_ORDER
        }
        lastSeconds = time.seconds
        // A boat that stays, or a fix that is repeated: the same place is the same cell.
        if (x != placeX || y != placeY) {
            placeX = x
            placeY = y
            placeCell = grid.cellAt(x, y)
        }
        val cell = placeCell
        if (cell == Grid.OUTSIDE) {
            if (lastCell != Grid.OUTSIDE) leave()
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

    /** How far the place of the reading that is being taken is from its cell's border, m. */
    protected fun distanceToBorder(): Double = grid.distanceToBorder(placeX, placeY)

    /** Notices that the boat left the last cell from a reading that has no value but a time and a place. */
    private fun noticeMove(time: BoatTime, x: Double, y: Double) {
        if (!time.seconds.isFinite() || time.seconds < lastSeconds || !x.isFinite() || !y.isFinite()) return
        if (lastCell == Grid.OUTSIDE || grid.cellAt(x, y) == lastCell) return
        lastCell = Grid.OUTSIDE
        leave()
    }

    /**
     * Notices that the boat left the last cell without a reading of where it went: what the sensor saw between the last
     * reading taken and the next is not known.
     */
    protected open fun leave() {}

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
