package stillwater.estimate

import stillwater.field.FieldMap
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Reading

/** What an estimator did with a reading. */
public enum class ReadingUse {
    /** The reading was taken into the map. */
    USED,

    /** The reading lay in no cell of the grid and was counted as such. */
    OUTSIDE,

    /** The reading, its time or its place was not finite; it was counted as rejected. */
    NOT_FINITE,

    /** The reading was older than one already taken; it was counted as rejected. */
    OUT_OF_ORDER,
}

/**
 * Turns readings of one sensor into a map of the field.
 *
 * Readings come in the order of their times; equal times are allowed. No reading makes an estimator throw: what it
 * cannot use it counts in [map] and says so. Confined to one thread.
 */
public interface FieldEstimator {
    /**
     * What is believed so far. The same object for the estimator's life; it is up to date when it is asked for, and
     * after another [update] when it is asked for again.
     */
    public val map: FieldMap

    /**
     * Takes one reading. Allocates nothing.
     *
     * @param time when the sample was taken.
     * @param x metres east in the local frame where it was taken.
     * @param y metres north in the local frame where it was taken.
     * @param value what the sensor said, sensor units.
     * @param conditions what else was measured at [time].
     */
    public fun update(
        time: BoatTime,
        x: Double,
        y: Double,
        value: Double,
        conditions: Conditions = Conditions.NONE,
    ): ReadingUse

    /**
     * Takes readings of a boat that stays, one after the other: as that many calls of [update], with what it leaves in
     * [map] when all are taken, bit for bit. Allocates nothing.
     *
     * @param times when the samples were taken, s on the boat's clock, length [count] at least. Not modified.
     * @param x metres east in the local frame where all were taken.
     * @param y metres north in the local frame where all were taken.
     * @param values what the sensor said, sensor units, as [times]. Not modified.
     * @param count how many readings there are.
     */
    public fun updateAll(times: DoubleArray, x: Double, y: Double, values: DoubleArray, count: Int) {
        for (i in 0 until count) update(BoatTime(times[i]), x, y, values[i], Conditions.NONE)
    }
}

/** Takes [reading]; see [FieldEstimator.update]. */
public fun FieldEstimator.update(reading: Reading): ReadingUse =
    update(reading.time, reading.position.x, reading.position.y, reading.value, reading.conditions)
