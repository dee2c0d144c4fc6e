package stillwater.estimate

import kotlin.math.abs

/**
 * Which way the sensor goes by the report's windows: the slope of the last five running medians of three against ε.
 *
 * Decides as [MedianWindow] and [SlopeWindow] of these sizes do, always, but mostly without a slope. Of five medians at
 * even steps h it is (2 (m₄ − m₀) + m₃ − m₁) / 10h. A step counts as even where its difference of times rounds to h. What
 * that and all rounding may change, in this numerator and in the sums of [SlopeWindow], is together below 1000 · 2⁻⁵³ of
 * the largest reading (deviations of times are at most 4h, of medians 4 times the largest, and their products' sum 20
 * times both), so that a numerator farther than [MARGIN] of it from ±10hε decides alike; [TINY] is far above what
 * underflow may add where h lies within [MOST] and its reciprocal. What is nearer, as slopes of a sensor with a coarse
 * resolution may be, and what comes in uneven steps is decided by the slope itself.
 *
 * Readings lie one after the other in arrays, those of a stay mostly from the first to the last: the slopes of a stay do
 * not wait for each other. O(1) a reading, no allocation.
 *
 * @param epsilon smallest slope that counts as one, sensor units/s, at least 0.
 */
internal class StayWindow(private val epsilon: Double) {
    private val times = DoubleArray(CAPACITY)
    private val values = DoubleArray(CAPACITY)

    /** The median of each reading and the two before it. */
    private val medians = DoubleArray(CAPACITY)

    /** Readings since the start or the last clearing, less those that were dropped. */
    private var size = 0

    /** The first of the readings, up to the newest, that came as [pace] was told last. */
    private var even = 0

    /** A numerator nearer to 0 than this is of no slope that counts, and one farther than [steep] is of one. */
    private var flat = 0.0
    private var steep = 0.0
    private val slope = SlopeWindow(SLOPES)

    /** Forgets all readings. */
    fun clear() {
        size = 0
        even = 0
    }

    /**
     * The next reading comes [step] s after the last, and so do those after it until this is told anew; none is farther
     * from 0 than [largest], sensor units. A step of NaN: they come as they like.
     */
    fun pace(step: Double, largest: Double) {
        even = size
        val isUsable = step >= 1 / MOST && step <= MOST && largest <= MOST
        val threshold = 2 * SLOPES * step * epsilon
        val margin = MARGIN * largest + TINY
        flat = if (isUsable) threshold - margin else 0.0
        steep = if (isUsable) threshold + margin else Double.POSITIVE_INFINITY
    }

    /** Adds the reading [value], sensor units, taken at [seconds] s; both finite. The [direction] at it. */
    fun add(seconds: Double, value: Double): Int {
        if (size == CAPACITY) drop()
        val n = size
        size = n + 1
        times[n] = seconds
        values[n] = value
        if (n < 2) return 0
        medians[n] = MedianWindow.middle(values[n - 2], values[n - 1], value)
        return direction(n)
    }

    /**
     * Forgets all and takes [count] readings that come [step] s after each other, none farther from 0 than [largest]: as
     * that many calls of [add], whose answers [direction] then gives.
     *
     * @param step NaN where steps differ.
     * @return whether it did: whether there are not too few or too many, and steps are alike.
     */
    fun addAll(newTimes: DoubleArray, newValues: DoubleArray, count: Int, step: Double, largest: Double): Boolean {
        if (step.isNaN() || count < FIRST || count > CAPACITY) return false
        clear()
        pace(step, largest)
        newTimes.copyInto(times, 0, 0, count)
        newValues.copyInto(values, 0, 0, count)
        for (i in 2 until count) medians[i] = MedianWindow.middle(newValues[i - 2], newValues[i - 1], newValues[i])
        size = count
        return true
    }

    /** Of the slope at the reading [n]: 1 where it is above ε, −1 where it is below −ε, else 0; 0 where there is none. */
    fun direction(n: Int): Int {
        if (n - even >= FIRST) {
            val rise = 2 * (medians[n] - medians[n - 4]) + (medians[n - 1] - medians[n - 3])
            if (abs(rise) < flat) return 0
            if (rise > steep) return 1
            if (rise < -steep) return -1
        } else if (n < FIRST) {
            return 0
        }
        return directionOfSlope(n)
    }

    /** The same by the slope itself; its sums have the order of a ring, whose first place each fifth median takes. */
    private fun directionOfSlope(n: Int): Int {
        val oldest = n - FIRST
        val first = oldest - oldest % SLOPES
        slope.clear()
        for (i in first until first + SLOPES) {
            val at = if (i < oldest) i + SLOPES else i
            slope.add(times[at + 1], medians[at + 2])
        }
        return direction(slope.slope(), epsilon)
    }

    /** Drops the oldest readings, some fives of them, so that sums keep their order. */
    private fun drop() {
        times.copyInto(times, 0, DROPPED, size)
        values.copyInto(values, 0, DROPPED, size)
        medians.copyInto(medians, 0, DROPPED, size)
        size -= DROPPED
        even = maxOf(0, even - DROPPED)
    }

    companion object {
        /** Readings in the median window. */
        const val MEDIANS: Int = 3

        /** Medians in the slope window. */
        const val SLOPES: Int = 5

        /** The first reading that has a slope. */
        const val FIRST: Int = MEDIANS + SLOPES - 2

        /** 1 where [slope] is above [epsilon], −1 where it is below −[epsilon], else 0. */
        fun direction(slope: Double, epsilon: Double): Int = when {
            slope > epsilon -> 1
            slope < -epsilon -> -1
            else -> 0
        }

        /** Readings it holds, and as many of them as are dropped when it is full. */
        private const val CAPACITY = 64
        private const val DROPPED = 50

        private const val MARGIN = 1e-12
        private const val TINY = 1e-200
        private const val MOST = 1e50
    }
}
