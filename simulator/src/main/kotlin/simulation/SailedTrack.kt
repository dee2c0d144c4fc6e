package stillwater.simulation

import stillwater.mission.Mission
import stillwater.mission.MissionState
import stillwater.model.Position
import kotlin.math.abs
import kotlin.math.hypot
import kotlin.math.sqrt

/** Where a simulated boat really was, step by step, and how far off the legs it was to sail. */
class SailedTrack {
    private var times = DoubleArray(FIRST)
    private var xs = DoubleArray(FIRST)
    private var ys = DoubleArray(FIRST)
    private var before = emptyList<Position>()
    private var wasUnderWay = false
    private var legStart: Position? = null
    private var squares = 0.0
    private var pointing = 0L
    private var believedSquares = 0.0
    private var believed = 0L

    /** Steps. */
    var size: Int = 0
        private set

    /** Way over ground, drift before the mission's start and after its end included, m. */
    var distance: Double = 0.0
        private set

    /** Way over ground in the states in which the boat is under way, m. */
    var distanceUnderWay: Double = 0.0
        private set

    /** Largest distance from a leg while surveying, m. */
    var largestCrossTrack: Double = 0.0
        private set

    /** Root mean square distance of the boat's true place from the leg it sails while surveying, m; NaN without any. */
    val crossTrack: Double get() = sqrt(squares / pointing)

    /** Root mean square distance of the believed from the true place, m; NaN where it was never known. */
    val poseError: Double get() = sqrt(believedSquares / believed)

    /** Time of step [i], s. */
    fun time(i: Int): Double = times[i]

    /** Metres east in step [i]. */
    fun x(i: Int): Double = xs[i]

    /** Metres north in step [i]. */
    fun y(i: Int): Double = ys[i]

    /** Where the boat was at [time], s, taken to go straight between two steps; the nearer end beyond them. */
    fun at(time: Double): Position {
        val found = times.binarySearch(time, 0, size)
        if (found >= 0) return Position(xs[found], ys[found])
        val after = -found - 1
        if (after == 0) return Position(xs[0], ys[0])
        if (after == size) return Position(xs[size - 1], ys[size - 1])
        val share = (time - times[after - 1]) / (times[after] - times[after - 1])
        return Position(
            xs[after - 1] + share * (xs[after] - xs[after - 1]),
            ys[after - 1] + share * (ys[after] - ys[after - 1]),
        )
    }

    /** The boat is at ([x], [y]), m, at [time], s, and sails as [mission] wants. */
    fun add(time: Double, x: Double, y: Double, mission: Mission) {
        if (size == times.size) grow()
        if (size > 0) {
            val step = hypot(x - xs[size - 1], y - ys[size - 1])
            distance += step
            // A state lasts until the step that finds another.
            if (wasUnderWay) distanceUnderWay += step
        }
        wasUnderWay = mission.state.isUnderWay
        times[size] = time
        xs[size] = x
        ys[size] = y
        size++
        mission.position?.let {
            believedSquares += (it.x - x) * (it.x - x) + (it.y - y) * (it.y - y)
            believed++
        }
        if (mission.state == MissionState.Surveying) follow(x, y, mission) else before = emptyList()
    }

    private fun follow(x: Double, y: Double, mission: Mission) {
        val ahead = mission.waypoints()
        val target = ahead.firstOrNull() ?: return
        if (target != before.firstOrNull()) {
            val isNext = before.size > 1 && before[1] == target
            legStart = if (isNext) before[0] else mission.position
        }
        before = ahead
        val start = legStart ?: return
        val length = hypot(target.x - start.x, target.y - start.y)
        if (length < mission.spec.boat.arrival) return
        val alongX = (target.x - start.x) / length
        val alongY = (target.y - start.y) / length
        val along = (x - start.x) * alongX + (y - start.y) * alongY
        if (along !in 0.0..length) return
        val off = abs((y - start.y) * alongX - (x - start.x) * alongY)
        squares += off * off
        pointing++
        largestCrossTrack = maxOf(largestCrossTrack, off)
    }

    private fun grow() {
        times = times.copyOf(2 * size)
        xs = xs.copyOf(2 * size)
        ys = ys.copyOf(2 * size)
    }

    private companion object {
        const val FIRST = 20_000
    }
}
