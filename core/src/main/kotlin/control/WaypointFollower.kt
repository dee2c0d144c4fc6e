package stillwater.control

import stillwater.model.Drive
import kotlin.math.PI
import kotlin.math.abs
import kotlin.math.asin
import kotlin.math.atan2
import kotlin.math.cos
import kotlin.math.hypot
import kotlin.math.sin
import kotlin.math.sqrt

/**
 * How a boat moves and how it is to follow a path.
 *
 * @property topSpeed through the water at full thrust, m/s. Thrust needed grows with the speed's square.
 * @property cruise speed through the water on the way, m/s, at most [topSpeed].
 * @property lookahead how far ahead on the leg the boat aims, m: short is strict, long is calm.
 * @property arrival a waypoint is reached within this distance, m, or once its far side is passed.
 * @property deceleration the boat slows down before a turn so that it needs no more than this, m/s².
 * @property turnGain turning effort per rad of heading error, 1/rad.
 * @property turnDamping turning effort per rad/s of yaw, s/rad, at least 0.
 * @property turnThrust share of full thrust given in a full turn at least, 0 to 1: a swivelled thruster turns the tighter
 *   the more it pushes.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public data class FollowerSettings(
    val topSpeed: Double,
    val cruise: Double = 1.0,
    val lookahead: Double = 4.0,
    val arrival: Double = 1.5,
    val deceleration: Double = 0.15,
    val turnGain: Double = 1.0,
    val turnDamping: Double = 0.5,
    val turnThrust: Double = 0.0,
) {
    init {
        for ((name, value) in listOf(
            "topSpeed (m/s)" to topSpeed,
            "cruise (m/s)" to cruise,
            "lookahead (m)" to lookahead,
            "arrival (m)" to arrival,
            "deceleration (m/s2)" to deceleration,
            "turnGain (1/rad)" to turnGain,
        )) {
            require(value > 0 && value.isFinite()) { "$name ($value) must be above 0 and finite" }
        }
        require(cruise <= topSpeed) { "cruise ($cruise m/s) must not be above topSpeed ($topSpeed m/s)" }
        require(turnDamping >= 0 && turnDamping.isFinite()) {
            "turnDamping ($turnDamping s/rad) must be at least 0 and finite"
        }
        require(turnThrust in 0.0..1.0) { "turnThrust ($turnThrust) must be in [0, 1]" }
    }
}

/**
 * Steers the boat along the straight line from one waypoint to the next.
 *
 * Line of sight: the course wanted is χ = α − atan(e / Δ), α the leg's angle, e the distance to port of it, Δ the
 * lookahead. The heading is turned into the current so that the boat's way over ground has that course:
 * sin(ψ − χ) = −c⊥ / u. The speed falls towards the waypoint, and while the boat points elsewhere.
 *
 * Source: T. I. Fossen (2011), Handbook of Marine Craft Hydrodynamics and Motion Control, section 10.3,
 * doi:10.1002/9781119994138. Differs: the drift comes from [TrackEstimator] in place of integral action. Derivation in
 * core/docs/WaypointFollower.md. Never throws on data; answers [Drive.NONE] where it does not know the place, the
 * heading or the way. Allocates the answer only. Confined to one thread.
 *
 * @property settings the boat and the manner.
 */
public class WaypointFollower(public val settings: FollowerSettings) {
    private var fromX = Double.NaN
    private var fromY = Double.NaN
    private var toX = Double.NaN
    private var toY = Double.NaN
    private var nextX = Double.NaN
    private var nextY = Double.NaN

    /** Whether the waypoint was reached since it was set, or none was set. */
    public var arrived: Boolean = true
        private set

    /** Distance to port of the leg at the last [steer], m. */
    public var crossTrack: Double = Double.NaN
        private set

    /**
     * Sets the leg from one place to another, m.
     *
     * @param afterX where the leg after this one leads, for the speed in the turn; NaN to stop at the end.
     */
    public fun leg(
        fromX: Double,
        fromY: Double,
        toX: Double,
        toY: Double,
        afterX: Double = Double.NaN,
        afterY: Double = Double.NaN,
    ) {
        this.fromX = fromX
        this.fromY = fromY
        this.toX = toX
        this.toY = toY
        nextX = afterX
        nextY = afterY
        arrived = false
    }

    /**
     * What to do now.
     *
     * @param track where the boat is. Not modified.
     * @param heading rad, counter-clockwise from east.
     * @param yawRate rad/s, counter-clockwise; NaN counts as 0.
     */
    public fun steer(track: TrackEstimator, heading: Double, yawRate: Double): Drive {
        val east = toX - track.x
        val north = toY - track.y
        val distance = hypot(east, north)
        if (arrived || !distance.isFinite() || !heading.isFinite()) return Drive.NONE
        val length = hypot(toX - fromX, toY - fromY)
        val alongX = if (length > 0) (toX - fromX) / length else east / distance.coerceAtLeast(TINY)
        val alongY = if (length > 0) (toY - fromY) / length else north / distance.coerceAtLeast(TINY)
        val ahead = east * alongX + north * alongY
        crossTrack = alongY * east - alongX * north
        val passed = ahead <= 0 && length > 0 && distance <= PASSED * settings.arrival
        if (distance <= settings.arrival || passed) {
            arrived = true
            return Drive.NONE
        }
        // Beyond the leg's end the boat aims at the waypoint itself.
        val course = if (ahead > 0) {
            atan2(alongY, alongX) - atan2(crossTrack, minOf(settings.lookahead, maxOf(ahead, settings.arrival)))
        } else {
            atan2(north, east)
        }
        val speed = speed(distance)
        val across = track.driftY * cos(course) - track.driftX * sin(course)
        val wanted = course + asin((-across / speed).coerceIn(-STEEPEST, STEEPEST))
        val error = wrapped(wanted - heading)
        val turn = settings.turnGain * error - settings.turnDamping * if (yawRate.isFinite()) yawRate else 0.0
        val effort = turn.coerceIn(-1.0, 1.0)
        val share = speed / settings.topSpeed
        return Drive(maxOf(share * share * cos(error), settings.turnThrust * abs(effort)), effort)
    }

    /** v² = v₁² + 2 a d: what still can be slowed down to the turn's speed v₁ over the distance d. */
    private fun speed(distance: Double): Double {
        val bend = if (nextX.isFinite() && nextY.isFinite()) {
            abs(wrapped(atan2(nextY - toY, nextX - toX) - atan2(toY - fromY, toX - fromX)))
        } else {
            PI
        }
        val slowest = settings.cruise * SLOWEST
        val turning = slowest + (settings.cruise - slowest) * maxOf(0.0, cos(bend))
        val far = maxOf(0.0, distance - settings.arrival)
        return minOf(settings.cruise, sqrt(turning * turning + 2 * settings.deceleration * far))
    }

    private fun wrapped(angle: Double): Double = Math.IEEEremainder(angle, 2 * PI)

    private companion object {
        const val TINY = 1e-9

        /** Passing a waypoint at more than this many arrival radii does not count. */
        const val PASSED = 3.0

        /** Share of the cruise speed below which a moving boat no longer steers well. */
        const val SLOWEST = 0.5

        /** Sine of the largest angle against the current: at 64 degrees little way is left. */
        const val STEEPEST = 0.9
    }
}
