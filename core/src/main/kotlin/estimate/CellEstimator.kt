package stillwater.estimate

import stillwater.field.FieldMap
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import kotlin.math.abs

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
    /**
     * The map as far as it is written. Visits are current; an estimator that puts off cells which the next reading would
     * change anyway, or readings, writes them when [map] is asked for.
     */
    protected val written: FieldMap = FieldMap(grid, prior)

    override val map: FieldMap get() = written
    private val grid = grid
    private var lastCell = Grid.OUTSIDE
    private var placeX = Double.NaN
    private var placeY = Double.NaN
    private var lastSeconds = Double.NEGATIVE_INFINITY
    private var step = Double.NaN

    /** No reading was farther from 0, sensor units. */
    protected var largest: Double = 0.0
        private set

    final override fun update(
        time: BoatTime,
        x: Double,
        y: Double,
        value: Double,
        conditions: Conditions,
    ): ReadingUse {
        val seconds = time.seconds
        val stays = x == placeX && y == placeY
        if (!stays || seconds - lastSeconds != step || !(abs(value) <= largest)) {
            return updateUnlike(seconds, x, y, value, conditions)
        }
        // Where it was, later by as much as the last one, and no larger than any: finite, in order and in the same cell.
        lastSeconds = seconds
        count(lastCell)
        take(lastCell, false, seconds, value, conditions)
        return ReadingUse.USED
    }

    /**
     * Takes a reading that is not like those before, or not usable.
     *
     * Java's compiler puts [update] into its callers if it is short, and into that whatever it calls and has no more than
     * 325 bytes of bytecode (`FreqInlineSize`). This has more, because what it uses is inline, and so stays outside.
     */
    private fun updateUnlike(
        seconds: Double,
        x: Double,
        y: Double,
        value: Double,
        conditions: Conditions,
    ): ReadingUse {
        if (!seconds.isFinite() || !x.isFinite() || !y.isFinite() || !value.isFinite()) {
            written.countRejected()
            noticeMove(seconds, x, y)
            return ReadingUse.NOT_FINITE
        }
        if (seconds < lastSeconds) {
            written.countRejected()
            return ReadingUse.OUT_OF_ORDER
        }
        val newStep = seconds - lastSeconds
        lastSeconds = seconds
        val cell = grid.cellAt(x, y)
        if (cell == Grid.OUTSIDE) {
            if (lastCell != Grid.OUTSIDE) leaveCell()
            step = Double.NaN
            written.countOutside()
            return ReadingUse.OUTSIDE
        }
        noticePace(newStep, abs(value))
        val entered = comeTo(cell, x, y)
        count(cell)
        take(cell, entered, seconds, value, conditions)
        return ReadingUse.USED
    }

    /** Notices that the boat is at ([x], [y]) in [cell]. Whether it entered that. */
    @Suppress("NOTHING_TO_INLINE")
    private inline fun comeTo(cell: Int, x: Double, y: Double): Boolean {
        placeX = x
        placeY = y
        val entered = cell != lastCell
        lastCell = cell
        if (entered) written.countVisit(cell)
        return entered
    }

    /** Notices that the boat is no longer in the last cell, nor known to be in another. */
    @Suppress("NOTHING_TO_INLINE")
    private inline fun leaveCell() {
        lastCell = Grid.OUTSIDE
        placeX = Double.NaN
        leave()
    }

    /** Notices that a reading came [newStep] s after the last one, and is [size] from 0, sensor units. */
    @Suppress("NOTHING_TO_INLINE")
    private inline fun noticePace(newStep: Double, size: Double) {
        if (newStep == step && size <= largest) return
        step = if (newStep <= Double.MAX_VALUE) newStep else Double.NaN
        noticeSize(size)
        pace(step, largest)
    }

    /** Notices that a reading is [size] from 0, sensor units. */
    @Suppress("NOTHING_TO_INLINE")
    private inline fun noticeSize(size: Double) {
        // Twice as large, so that a value that keeps growing seldom comes here.
        if (size > largest) largest = minOf(2 * size, Double.MAX_VALUE)
    }

    /** How far the place of the reading that is being taken is from its cell's border, m. */
    protected fun distanceToBorder(): Double = grid.distanceToBorder(placeX, placeY)

    /** Where that reading is along the grid's first axis, m from its origin. */
    protected fun alongColumns(): Double = grid.alongColumns(placeX, placeY)

    /** Where it is along the second axis, m. */
    protected fun alongRows(): Double = grid.alongRows(placeX, placeY)

    final override fun updateAll(times: DoubleArray, x: Double, y: Double, values: DoubleArray, count: Int) {
        val cell = if (x.isFinite() && y.isFinite()) grid.cellAt(x, y) else Grid.OUTSIDE
        if (cell == Grid.OUTSIDE) return super.updateAll(times, x, y, values, count)
        var pace = evenStep(times, values, count)
        if (pace.isNaN()) {
            if (!canAllBeUsed(times, values, count)) return super.updateAll(times, x, y, values, count)
            for (i in 0 until count) noticeSize(abs(values[i]))
            pace = evenStep(times, values, count)
        }
        lastSeconds = times[count - 1]
        step = Double.NaN
        takeAll(cell, comeTo(cell, x, y), times, values, count, pace)
    }

    /**
     * The time from each of two or more readings to the next, where it is the same for all, to the last bit, and all can
     * be used and are no larger than [largest]; NaN where not.
     */
    private fun evenStep(times: DoubleArray, values: DoubleArray, count: Int): Double {
        if (count < 2 || !(times[0] >= lastSeconds)) return Double.NaN
        val even = times[1] - times[0]
        // Times that follow each other at a finite step are finite.
        if (!(even >= 0 && even <= Double.MAX_VALUE)) return Double.NaN
        val most = largest
        if (!(abs(values[0]) <= most)) return Double.NaN
        var last = times[0]
        for (i in 1 until count) {
            val seconds = times[i]
            if (seconds - last != even || !(abs(values[i]) <= most)) return Double.NaN
            last = seconds
        }
        return even
    }

    /** Whether there is a reading, and all are finite and in order. */
    private fun canAllBeUsed(times: DoubleArray, values: DoubleArray, count: Int): Boolean {
        if (count <= 0 || !times[0].isFinite() || !times[count - 1].isFinite()) return false
        var last = lastSeconds
        for (i in 0 until count) {
            if (!(times[i] >= last && abs(values[i]) <= Double.MAX_VALUE)) return false
            last = times[i]
        }
        return true
    }

    /** Notices that the boat left the last cell from a reading that has no value but a time and a place. */
    private fun noticeMove(seconds: Double, x: Double, y: Double) {
        if (!seconds.isFinite() || seconds < lastSeconds || !x.isFinite() || !y.isFinite()) return
        if (lastCell != Grid.OUTSIDE && grid.cellAt(x, y) != lastCell) leaveCell()
    }

    /**
     * Notices that the boat left the last cell without a reading of where it went: what the sensor saw between the last
     * reading taken and the next is not known.
     */
    protected open fun leave() {}

    /**
     * Notices that readings come at another step than before, or that one is larger than all before. Told before the
     * reading is taken: it came [step] s after the last, and so do those that [take] gets after it, one by one, until it
     * is told anew. Of readings that come together, and of the first one after them, nothing that was told holds.
     *
     * @param step time since the last reading, s, at least 0; NaN where there is none, or it is not finite.
     * @param largest no reading is farther from 0, sensor units; finite.
     */
    protected open fun pace(step: Double, largest: Double) {}

    /** Counts a reading of [cell], which [take] gets next; an estimator that puts off readings counts them later. */
    protected open fun count(cell: Int) {
        written.countReading(cell)
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

    /**
     * Counts and takes readings of one cell that are finite, in order and in the grid: as that many calls of [take].
     *
     * @param cell index of the cell they lie in.
     * @param entered whether the boat entered the cell with the first.
     * @param times the readings' times on the boat's clock, s. Not modified.
     * @param values what the sensor said, sensor units. Not modified.
     * @param count how many readings there are, at least 1.
     * @param step time from each reading to the next where that is the same for all, s, and there are two or more; NaN where
     *   not.
     */
    @Suppress("LongParameterList")
    protected open fun takeAll(
        cell: Int,
        entered: Boolean,
        times: DoubleArray,
        values: DoubleArray,
        count: Int,
        step: Double,
    ) {
        for (i in 0 until count) {
            count(cell)
            take(cell, entered && i == 0, times[i], values[i], Conditions.NONE)
        }
    }
}
