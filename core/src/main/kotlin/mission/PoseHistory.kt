package stillwater.mission

import stillwater.model.BoatTime
import stillwater.model.Position

/**
 * Where the boat was lately: a reading belongs where the boat was when it was sampled, not where it is when it is heard.
 *
 * Between two poses the boat is taken to have gone straight. Asked for a time after the newest pose or before the oldest
 * one kept, it answers that pose as long as it is no farther away than [longestGap], and between two poses farther apart
 * than that it answers nothing. Keeps the last [capacity] poses. [add] allocates nothing. Confined to one thread.
 *
 * @property capacity poses kept, at least 2: 600 are a minute at 10 Hz.
 * @property longestGap s, above 0 and finite.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public class PoseHistory(public val capacity: Int = 600, public val longestGap: Double = 2.0) {
    init {
        require(capacity >= 2) { "capacity ($capacity poses) must be at least 2" }
        require(longestGap > 0 && longestGap.isFinite()) { "longestGap ($longestGap s) must be above 0 and finite" }
    }

    private val seconds = DoubleArray(capacity)
    private val xs = DoubleArray(capacity)
    private val ys = DoubleArray(capacity)
    private val deviations = DoubleArray(capacity)
    private var first = 0

    /** Poses kept. */
    public var size: Int = 0
        private set

    /** Poses refused: not finite, or not later than the newest. */
    public var refused: Long = 0
        private set

    /**
     * Takes the boat's place at [time], m, and its standard deviation, each axis, m; false where the place is not finite or
     * the time not later than the newest.
     */
    public fun add(time: BoatTime, x: Double, y: Double, deviation: Double = 0.0): Boolean {
        val late = size > 0 && time.seconds <= seconds[index(size - 1)]
        if (!time.seconds.isFinite() || !x.isFinite() || !y.isFinite() || late) {
            refused++
            return false
        }
        if (size == capacity) first = (first + 1) % capacity else size++
        val at = index(size - 1)
        seconds[at] = time.seconds
        xs[at] = x
        ys[at] = y
        deviations[at] = deviation
        return true
    }

    /** Where the boat was at [time]; null where that is not known. O(log size). */
    public fun at(time: BoatTime): Position? {
        val later = laterThan(time)
        if (later < 0) return null
        if (later == 0) return near(0, time)
        if (later == size) return near(size - 1, time)
        val a = index(later - 1)
        val b = index(later)
        val gap = seconds[b] - seconds[a]
        if (time.seconds == seconds[a]) return Position(xs[a], ys[a])
        if (gap > longestGap) return null
        val share = (time.seconds - seconds[a]) / gap
        return Position(xs[a] + share * (xs[b] - xs[a]), ys[a] + share * (ys[b] - ys[a]))
    }

    /** The larger deviation of the poses before and after [time], m; NaN where there is none. O(log size). */
    public fun deviationAt(time: BoatTime): Double {
        val later = laterThan(time)
        if (later < 0) return Double.NaN
        return maxOf(deviations[index(maxOf(later - 1, 0))], deviations[index(minOf(later, size - 1))])
    }

    /** The number of poses that are not after [time]; −1 where there is none at all or [time] is not finite. */
    private fun laterThan(time: BoatTime): Int {
        if (size == 0 || !time.seconds.isFinite()) return -1
        var low = 0
        var high = size
        while (low < high) {
            val middle = (low + high) / 2
            if (seconds[index(middle)] <= time.seconds) low = middle + 1 else high = middle
        }
        return low
    }

    /** Forgets all poses: the boat's clock or frame has changed. */
    public fun clear() {
        size = 0
        first = 0
    }

    private fun near(number: Int, time: BoatTime): Position? {
        val at = index(number)
        return if (Math.abs(time.seconds - seconds[at]) <= longestGap) Position(xs[at], ys[at]) else null
    }

    private fun index(number: Int) = (first + number) % capacity
}
