package stillwater.virtual

import stillwater.model.Actuation
import kotlin.math.PI
import kotlin.math.abs
import kotlin.math.cos
import kotlin.math.hypot
import kotlin.math.sin
import kotlin.math.sqrt

/**
 * A hull and its thrusters.
 *
 * @property mass with the water it carries along, kg.
 * @property fullThrust of all thrusters together, N.
 * @property linearDrag N per m/s.
 * @property quadraticDrag N per (m/s)².
 * @property inertia about the upright axis, kg m².
 * @property fullTorque at a full turn, N m.
 * @property yawDrag N m per rad/s.
 * @property windage share of the wind's velocity at which the boat drifts, dimensionless, at least 0.
 * @throws IllegalArgumentException if a number is out of its range; all but the windage must be above 0.
 */
public data class Hull(
    val mass: Double = 15.0,
    val fullThrust: Double = 30.0,
    val linearDrag: Double = 5.0,
    val quadraticDrag: Double = 8.0,
    val inertia: Double = 2.5,
    val fullTorque: Double = 4.0,
    val yawDrag: Double = 4.0,
    val windage: Double = 0.03,
) {
    init {
        for ((name, value) in listOf(
            "mass (kg)" to mass,
            "fullThrust (N)" to fullThrust,
            "linearDrag (N s/m)" to linearDrag,
            "quadraticDrag (N s2/m2)" to quadraticDrag,
            "inertia (kg m2)" to inertia,
            "fullTorque (N m)" to fullTorque,
            "yawDrag (N m s)" to yawDrag,
        )) {
            require(value > 0 && value.isFinite()) { "$name ($value) must be above 0 and finite" }
        }
        require(windage >= 0 && windage.isFinite()) { "windage ($windage) must be at least 0 and finite" }
    }

    /** Speed through still water at full thrust, m/s: the root of d₂ u² + d₁ u = T. */
    public val topSpeed: Double
        get() = (-linearDrag + sqrt(linearDrag * linearDrag + 4 * quadraticDrag * fullThrust)) / (2 * quadraticDrag)
}

/**
 * How a boat moves: surge and yaw with drag, carried by current and wind.
 *
 * m u̇ = T a − d₁ u − d₂ |u| u, I ṙ = N b − k r, ẋ = u cos ψ + c + w · wind, a and b the shares of thrust and torque.
 * The hull does not slip sideways through the water. Source: T. I. Fossen (2011), Handbook of Marine Craft Hydrodynamics
 * and Motion Control, chapter 7, doi:10.1002/9781119994138, without sway and its coupling. Integrated in steps of
 * [STEP] s at most. Deterministic. Confined to one thread.
 *
 * @property hull the boat.
 */
public class BoatDynamics(public val hull: Hull = Hull(), x: Double = 0.0, y: Double = 0.0, heading: Double = 0.0) {
    /** Metres east. */
    public var x: Double = x
        private set

    /** Metres north. */
    public var y: Double = y
        private set

    /** Heading, rad, counter-clockwise from east, in (−π, π]. */
    public var heading: Double = heading
        private set

    /** Speed through the water, m/s, negative astern. */
    public var surge: Double = 0.0
        private set

    /** Yaw rate, rad/s, counter-clockwise. */
    public var yawRate: Double = 0.0
        private set

    /** Velocity of the water, east, m/s. */
    public var currentX: Double = 0.0

    /** Velocity of the water, north, m/s. */
    public var currentY: Double = 0.0

    /** Velocity of the wind, east, m/s. */
    public var windX: Double = 0.0

    /** Velocity of the wind, north, m/s. */
    public var windY: Double = 0.0

    /** How fast water passes the hull, m/s, at least 0: the [surge] and what the wind adds to it, without the current. */
    public val speedThroughWater: Double
        get() = hypot(surge * cos(heading) + hull.windage * windX, surge * sin(heading) + hull.windage * windY)

    /** Lets [seconds] s pass under [actuation]; not above 0 or not finite passes none. */
    public fun advance(seconds: Double, actuation: Actuation) {
        if (!(seconds > 0 && seconds.isFinite())) return
        val thrust = thrust(actuation)
        val torque = torque(actuation)
        var left = seconds
        while (left > 0) {
            val dt = minOf(left, STEP)
            step(dt, thrust, torque)
            left -= dt
        }
    }

    private fun thrust(actuation: Actuation) = hull.fullThrust * when (actuation) {
        is Actuation.Differential -> (actuation.left + actuation.right) / 2
        is Actuation.Vectored -> actuation.thrust * cos(FULL_SWIVEL * actuation.rudder)
    }

    private fun torque(actuation: Actuation) = hull.fullTorque * when (actuation) {
        is Actuation.Differential -> (actuation.right - actuation.left) / 2
        is Actuation.Vectored -> actuation.thrust * sin(FULL_SWIVEL * actuation.rudder) / sin(FULL_SWIVEL)
    }

    private fun step(dt: Double, thrust: Double, torque: Double) {
        surge += dt * (thrust - (hull.linearDrag + hull.quadraticDrag * abs(surge)) * surge) / hull.mass
        yawRate += dt * (torque - hull.yawDrag * yawRate) / hull.inertia
        heading = Math.IEEEremainder(heading + dt * yawRate, 2 * PI)
        x += dt * (surge * cos(heading) + currentX + hull.windage * windX)
        y += dt * (surge * sin(heading) + currentY + hull.windage * windY)
    }

    public companion object {
        /** Longest step of the integration, s. */
        public const val STEP: Double = 0.02

        /** Angle of a full swivel of a vectored thruster, rad. */
        private const val FULL_SWIVEL = PI / 4
    }
}
