package stillwater.estimate

import stillwater.field.FieldMap
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval

/** What the bounded filter does when new evidence crosses the other bound. */
public enum class CrossingPolicy {
    /** Both bounds stand as the evidence set them, even crossed: Algorithm 1 as printed. */
    PLAIN,

    /** The other bound moves along to the new one, so that they meet: the original code's "soft" variant. */
    SOFT,

    /** The contradicted bound returns to the prior's end: the newest evidence is believed, the old is forgotten. */
    RESET,
}

/**
 * Settings of a [BoundedFilter].
 *
 * @property medianWindow samples in the median window, odd, at least 1.
 * @property slopeWindow medians in the regression window, at least 2.
 * @property epsilon smallest slope that counts as one, sensor units/s, at least 0.
 * @property clearOnEntry whether both windows are emptied when the boat enters a cell. The report does not say. Not
 *   cleared, slopes mix the water of two cells and bounds become wrong.
 * @property crossing what happens when bounds cross.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public data class BoundedFilterSettings(
    val epsilon: Double,
    val medianWindow: Int = 3,
    val slopeWindow: Int = 5,
    val clearOnEntry: Boolean = true,
    val crossing: CrossingPolicy = CrossingPolicy.PLAIN,
) {
    init {
        require(medianWindow >= 1 && medianWindow % 2 == 1) {
            "medianWindow ($medianWindow samples) must be odd and at least 1"
        }
        require(slopeWindow >= 2) { "slopeWindow ($slopeWindow medians) must be at least 2" }
        require(epsilon >= 0 && epsilon.isFinite()) {
            "epsilon ($epsilon sensor units/s) must be at least 0 and finite"
        }
    }
}

/**
 * Bounds the field in each cell by the direction in which a slow sensor moves there; no sensor model is needed.
 *
 * A rising sensor is below the truth, so its reading is a lower bound; a falling one is above it. The slope is the
 * least-squares slope over a window of running medians, and counts when it exceeds ε. A cell's value is the midpoint
 * of its bounds.
 *
 * Guaranteed to contain the truth for a noise-free first-order or slew-limited sensor in a field that is constant
 * within a cell and inside the prior, with windows cleared on entry and a reading, be it without a value, from every
 * cell passed. Noise, dead time, a second-order response or uncleared windows can make a bound wrong; what the caller
 * then sees is conflicts.
 *
 * Source: the report, section 5, Algorithm 1. Differs: both branches there read "gradient < ε"; the first is taken as
 * gradient > ε, the second as gradient < −ε. Crossing policies and clearing are not in the report. Readings of a stay wait
 * until the boat leaves the cell or [map] is asked for. O(windows), no allocation.
 *
 * @param grid the cells.
 * @param prior bounds of a cell before any evidence, sensor units.
 * @property settings windows, ε and policies.
 */
public class BoundedFilter(
    grid: Grid,
    prior: Interval,
    public val settings: BoundedFilterSettings,
) : CellEstimator(grid, prior) {
    private val epsilon = settings.epsilon
    private val clearsOnEntry = settings.clearOnEntry
    private val medians = MedianWindow(settings.medianWindow)
    private val slopes = SlopeWindow(settings.slopeWindow)

    /** In place of both where they have the report's sizes; null where they have others. */
    private val stay = if (medians.size == StayWindow.MEDIANS && slopes.size == StayWindow.SLOPES) {
        StayWindow(epsilon)
    } else {
        null
    }

    /** The cell of the readings that the [stay] holds. */
    private var stayCell = Grid.OUTSIDE

    override val map: FieldMap get() {
        settle()
        return written
    }

    override fun pace(step: Double, largest: Double) {
        settle()
        stay?.pace(step, largest)
    }

    override fun count(cell: Int) {
        // Of a stay's readings those that are held are counted together.
        if (stay == null) super.count(cell)
    }

    override fun take(cell: Int, entered: Boolean, seconds: Double, value: Double, conditions: Conditions) {
        if (entered) enter(cell)
        if (stay == null) return takeByWindows(cell, seconds, value)
        if (stay.isFull) settle()
        stay.hold(seconds, value)
    }

    private fun takeByWindows(cell: Int, seconds: Double, value: Double) {
        learn(cell, value, direction(seconds, value))
    }

    override fun takeAll(
        cell: Int,
        entered: Boolean,
        times: DoubleArray,
        values: DoubleArray,
        count: Int,
        step: Double,
    ) {
        settle()
        if (stay != null && entered && clearsOnEntry && stay.holdAll(times, values, count, step, largest)) {
            stayCell = cell
            settle(stay)
        } else {
            stay?.pace(Double.NaN, 0.0)
            super.takeAll(cell, entered, times, values, count, step)
        }
    }

    private fun enter(cell: Int) {
        settle()
        stayCell = cell
        if (clearsOnEntry) clear()
    }

    private fun clear() {
        stay?.clear()
        medians.clear()
        slopes.clear()
    }

    /** Which way the sensor goes: 1 where the slope is above ε, −1 where it is below −ε, else 0. */
    private fun direction(seconds: Double, value: Double): Int {
        medians.add(seconds, value)
        if (!medians.full) return 0
        slopes.add(medians.time, medians.median)
        if (!slopes.full) return 0
        return StayWindow.direction(slopes.slope(), epsilon)
    }

    private fun settle() {
        if (stay != null && stay.holds) settle(stay)
    }

    /**
     * Counts the readings that [stay] holds and learns from them, as from one after the other. Too big, by what is inline,
     * to be compiled into who calls it, see [CellEstimator]: so [take] is short.
     */
    private fun settle(stay: StayWindow) {
        val cell = stayCell
        written.countReadings(cell, stay.size - stay.seen)
        val lower = written.lower(cell)
        val upper = written.upper(cell)
        stay.look(lower, upper)
        val highest = stay.highest
        val lowest = stay.lowest
        if (highest > lowest) {
            // Bounds cross on the way, or did before: what comes of it depends on the order.
            for (n in stay.seen until stay.size) learn(cell, stay.value(n), stay.direction(n))
        } else if (highest != lower || lowest != upper) {
            believe(cell, highest, lowest)
        }
        stay.release()
    }

    @Suppress("NOTHING_TO_INLINE")
    private inline fun learn(cell: Int, value: Double, direction: Int) {
        if (direction > 0) {
            raiseLower(cell, value)
        } else if (direction < 0) {
            lowerUpper(cell, value)
        }
    }

    @Suppress("NOTHING_TO_INLINE")
    private inline fun raiseLower(cell: Int, value: Double) {
        if (value <= written.lower(cell)) return
        var upper = written.upper(cell)
        if (value > upper) {
            written.countConflict(cell)
            upper = when (settings.crossing) {
                CrossingPolicy.PLAIN -> upper
                CrossingPolicy.SOFT -> value
                CrossingPolicy.RESET -> maxOf(value, written.prior.upper)
            }
        }
        believe(cell, value, upper)
    }

    @Suppress("NOTHING_TO_INLINE")
    private inline fun lowerUpper(cell: Int, value: Double) {
        if (value >= written.upper(cell)) return
        var lower = written.lower(cell)
        if (value < lower) {
            written.countConflict(cell)
            lower = when (settings.crossing) {
                CrossingPolicy.PLAIN -> lower
                CrossingPolicy.SOFT -> value
                CrossingPolicy.RESET -> minOf(value, written.prior.lower)
            }
        }
        believe(cell, lower, value)
    }

    @Suppress("NOTHING_TO_INLINE")
    private inline fun believe(cell: Int, lower: Double, upper: Double) {
        written.setBounds(cell, lower, upper)
        written.setValue(cell, lower / 2 + upper / 2)
    }
}
