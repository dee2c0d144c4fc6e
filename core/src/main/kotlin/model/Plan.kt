package stillwater.model

/**
 * The waypoints a planner wants the boat to pass, in order; the boat's own position is not among them.
 *
 * A reusable buffer: a planner clears and fills the plan it is given, so that planning allocates nothing once the
 * buffer has grown. Confined to one thread.
 *
 * @param capacity waypoints it can hold before it grows, at least 1.
 * @throws IllegalArgumentException if [capacity] is below 1.
 */
public class Plan(capacity: Int = 16) {
    private var xs: DoubleArray
    private var ys: DoubleArray

    init {
        require(capacity >= 1) { "capacity ($capacity) must be at least 1" }
        xs = DoubleArray(capacity)
        ys = DoubleArray(capacity)
    }

    /** Number of waypoints. */
    public var size: Int = 0
        private set

    /** Metres east of the waypoint at [index], 0 until [size]. */
    public fun x(index: Int): Double = xs[checked(index)]

    /** Metres north of the waypoint at [index], 0 until [size]. */
    public fun y(index: Int): Double = ys[checked(index)]

    /** The waypoints as values, for display and logs. Allocates. */
    public fun waypoints(): List<Position> = List(size) { Position(xs[it], ys[it]) }

    /** Forgets all waypoints. */
    public fun clear() {
        size = 0
    }

    /** Appends a waypoint [x] metres east and [y] metres north. */
    public fun add(x: Double, y: Double) {
        if (size == xs.size) {
            xs = xs.copyOf(2 * size)
            ys = ys.copyOf(2 * size)
        }
        xs[size] = x
        ys[size] = y
        size++
    }

    /** Drops every waypoint after the first [count]. */
    public fun truncate(count: Int) {
        if (count < size) size = count.coerceAtLeast(0)
    }

    private fun checked(index: Int): Int {
        if (index !in 0 until size) throw IndexOutOfBoundsException("waypoint $index of $size")
        return index
    }
}
