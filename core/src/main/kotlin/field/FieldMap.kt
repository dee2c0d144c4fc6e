package stillwater.field

import stillwater.model.Grid
import stillwater.model.Interval

/**
 * What is believed about a field, cell by cell: a value, bounds, and how much evidence they rest on.
 *
 * Written by one estimator, read by planners, reports and screens; all on one thread. Cells are indexed as [grid].
 * Before the first evidence a cell has the bounds and the midpoint of [prior]. Bounds may cross (lower above upper)
 * where an estimator's policy lets them; readers must not assume otherwise. No call allocates but [copy].
 *
 * @property grid the cells.
 * @property prior the range every cell is believed to lie in before it is measured, sensor units.
 */
public class FieldMap(public val grid: Grid, public val prior: Interval) {
    private val values = DoubleArray(grid.size) { prior.midpoint }
    private val lowers = DoubleArray(grid.size) { prior.lower }
    private val uppers = DoubleArray(grid.size) { prior.upper }
    private val visitCounts = IntArray(grid.size)
    private val readingCounts = IntArray(grid.size)
    private val conflictCounts = IntArray(grid.size)

    /** Readings that lay in no cell. */
    public var outside: Long = 0
        private set

    /** Readings that could not be used: not finite, or older than one already taken. */
    public var rejected: Long = 0
        private set

    /**
     * How alike the field is believed to be in two cells; null where the estimator treats every cell by itself. Planners
     * may use it to tell what a visit says of the cells around. Set by the estimator.
     */
    public var correlation: SpatialCorrelation? = null

    /** Best estimate of the field in [cell], sensor units. */
    public fun value(cell: Int): Double = values[cell]

    /** Lower bound in [cell], sensor units. */
    public fun lower(cell: Int): Double = lowers[cell]

    /** Upper bound in [cell], sensor units. */
    public fun upper(cell: Int): Double = uppers[cell]

    /** Times the boat entered [cell]. */
    public fun visits(cell: Int): Int = visitCounts[cell]

    /** Readings taken in [cell]. */
    public fun readings(cell: Int): Int = readingCounts[cell]

    /** Times evidence in [cell] contradicted a bound set before. */
    public fun conflicts(cell: Int): Int = conflictCounts[cell]

    /**
     * How far the evidence has narrowed the bounds in [cell]: 1 − (upper − lower) / width of the prior; 0 before it is
     * measured, 1 where the value is known exactly.
     */
    public fun certainty(cell: Int): Double = 1 - (uppers[cell] - lowers[cell]) / prior.width

    /** Whether nothing is known of [cell] but the prior. */
    public fun isUnknown(cell: Int): Boolean =
        readingCounts[cell] == 0 && lowers[cell] <= prior.lower && uppers[cell] >= prior.upper

    /** The least and the greatest best estimate of the cells with readings, sensor units; null where there are none. */
    public fun measuredRange(): Interval? {
        var low = Double.POSITIVE_INFINITY
        var high = Double.NEGATIVE_INFINITY
        for (cell in 0 until grid.size) {
            if (readingCounts[cell] == 0 || !values[cell].isFinite()) continue
            low = minOf(low, values[cell])
            high = maxOf(high, values[cell])
        }
        return if (low <= high) Interval(low, high) else null
    }

    /** Sets the best estimate in [cell], sensor units. */
    public fun setValue(cell: Int, value: Double) {
        values[cell] = value
    }

    /** Sets both bounds in [cell], sensor units. */
    public fun setBounds(cell: Int, lower: Double, upper: Double) {
        lowers[cell] = lower
        uppers[cell] = upper
    }

    /** Counts one more entry into [cell]. */
    public fun countVisit(cell: Int) {
        visitCounts[cell]++
    }

    /** Counts one more reading in [cell]. */
    public fun countReading(cell: Int) {
        readingCounts[cell]++
    }

    /** Counts [count] more readings in [cell]. */
    public fun countReadings(cell: Int, count: Int) {
        readingCounts[cell] += count
    }

    /** Counts one more contradiction in [cell]. */
    public fun countConflict(cell: Int) {
        conflictCounts[cell]++
    }

    /** Counts one more reading that lay in no cell. */
    public fun countOutside() {
        outside++
    }

    /** Counts one more reading that could not be used. */
    public fun countRejected() {
        rejected++
    }

    /** Forgets all counts, of cells and of readings that lay in none or could not be used. */
    public fun clearCounts() {
        visitCounts.fill(0)
        readingCounts.fill(0)
        conflictCounts.fill(0)
        outside = 0
        rejected = 0
    }

    /** Adds all counts of [other], a map of as many cells. */
    public fun addCounts(other: FieldMap) {
        for (cell in visitCounts.indices) {
            visitCounts[cell] += other.visitCounts[cell]
            readingCounts[cell] += other.readingCounts[cell]
            conflictCounts[cell] += other.conflictCounts[cell]
        }
        outside += other.outside
        rejected += other.rejected
    }

    /** A map of the same content that later updates of this one do not change. */
    public fun copy(): FieldMap {
        val copy = FieldMap(grid, prior)
        values.copyInto(copy.values)
        lowers.copyInto(copy.lowers)
        uppers.copyInto(copy.uppers)
        visitCounts.copyInto(copy.visitCounts)
        readingCounts.copyInto(copy.readingCounts)
        conflictCounts.copyInto(copy.conflictCounts)
        copy.outside = outside
        copy.rejected = rejected
        copy.correlation = correlation
        return copy
    }
}
