package stillwater.estimate

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
 * Readings lie one after the other in arrays, those of a stay mostly from the first to the last. They are held until
 * somebody wants to know what they say, and then looked at together: no slope waits for another, and most are never
 * asked for. O(1) a reading, no allocation.
 *
 * @param epsilon smallest slope that counts as one, sensor units/s, at least 0.
 */
internal class StayWindow(private val epsilon: Double) {
    private val times = DoubleArray(CAPACITY)
    private val values = DoubleArray(CAPACITY)

    /** The median of each reading and the two before it. */
    private val medians = DoubleArray(CAPACITY)

    /** Readings since the start or the last clearing, less those that were dropped. */
    var size = 0
        private set

    /** The first of the readings that are held: that were not looked at yet. */
    var seen = 0
        private set

    /** Whether a reading is held. */
    val holds: Boolean get() = seen < size

    /** Whether there is no room for another reading until those held are released. */
    val isFull: Boolean get() = size == CAPACITY

    /** What the last [look] found, sensor units. */
    var highest = 0.0
        private set

    /** The same. */
    var lowest = 0.0
        private set

    /** The first of the readings, up to the newest, that came as [pace] was told last. */
    private var even = 0

    /** A numerator below this is of no slope above ε, and one above [steep] is; −∞ and ∞ where it tells nothing. */
    private var flat = 0.0
    private var steep = 0.0
    private val slope = SlopeWindow(SLOPES)

    /** Forgets all readings. */
    fun clear() {
        size = 0
        seen = 0
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
        flat = if (isUsable) threshold - margin else Double.NEGATIVE_INFINITY
        steep = if (isUsable) threshold + margin else Double.POSITIVE_INFINITY
    }

    /** Adds the reading [value], sensor units, taken at [seconds] s; both finite. To be looked at later; not [isFull]. */
    fun hold(seconds: Double, value: Double) {
        val n = size
        times[n] = seconds
        values[n] = value
        size = n + 1
    }

    /**
     * Forgets all and holds [count] readings that come [step] s after each other, none farther from 0 than [largest].
     *
     * @param step NaN where steps differ.
     * @return whether it did: whether there are not too few or too many, and steps are alike.
     */
    fun holdAll(newTimes: DoubleArray, newValues: DoubleArray, count: Int, step: Double, largest: Double): Boolean {
        if (step.isNaN() || count < FIRST || count > CAPACITY) return false
        clear()
        pace(step, largest)
        newTimes.copyInto(times, 0, 0, count)
        newValues.copyInto(values, 0, 0, count)
        size = count
        return true
    }

    /**
     * Looks at the readings that are held: [highest] is then the highest of [lower] and the values at which the sensor
     * rises, [lowest] the lowest of [upper] and those at which it falls. Most are not beyond, and their slopes not asked.
     */
    fun look(lower: Double, upper: Double) {
        val values = values
        val medians = medians
        for (n in maxOf(seen, 2) until size) medians[n] = MedianWindow.middle(values[n - 2], values[n - 1], values[n])
        highest = lower
        lowest = upper
        val first = maxOf(seen, FIRST)
        if (first - even >= FIRST && lookByNumerators(first)) return
        for (n in first until size) {
            val value = values[n]
            if (value > highest && rises(n)) highest = value
            if (value < lowest && falls(n)) lowest = value
        }
    }

    /** Looks at the readings from [first] on, which came in even steps. Whether no slope need be asked. */
    private fun lookByNumerators(first: Int): Boolean {
        val flat = flat
        val steep = steep
        var highest = highest
        var lowest = lowest
        var isDecided = true
        for (n in first until size) {
            val value = values[n]
            val rise = rise(n)
            if (value > highest && !(rise < flat)) {
                if (rise > steep) highest = value else isDecided = false
            }
            if (value < lowest && !(rise > -flat)) {
                if (rise < -steep) lowest = value else isDecided = false
            }
        }
        this.highest = highest
        this.lowest = lowest
        return isDecided
    }

    /** Holds no reading any more: all were looked at. */
    fun release() {
        if (isFull) drop()
        seen = size
    }

    /** The value of the reading [n], sensor units. */
    fun value(n: Int): Double = values[n]

    /** Of the slope at the reading [n]: 1 where it is above ε, −1 where it is below −ε, else 0; 0 where there is none. */
    fun direction(n: Int): Int = when {
        n < FIRST -> 0
        rises(n) -> 1
        falls(n) -> -1
        else -> 0
    }

    /** Whether the slope at the reading [n], at least [FIRST], is above ε. */
    private fun rises(n: Int): Boolean {
        if (n - even >= FIRST) {
            val rise = rise(n)
            if (rise < flat) return false
            if (rise > steep) return true
        }
        return directionOfSlope(n) > 0
    }

    /** Whether it is below −ε. */
    private fun falls(n: Int): Boolean {
        if (n - even >= FIRST) {
            val rise = rise(n)
            if (rise > -flat) return false
            if (rise < -steep) return true
        }
        return directionOfSlope(n) < 0
    }

    /** The numerator of the slope at the reading [n] where steps are even. */
    private fun rise(n: Int) = 2 * (medians[n] - medians[n - 4]) + (medians[n - 1] - medians[n - 3])

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
