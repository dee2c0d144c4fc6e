package stillwater.control

import kotlinx.serialization.SerialName
import kotlinx.serialization.Serializable
import stillwater.model.Actuation
import stillwater.model.Drive
import kotlin.math.PI
import kotlin.math.abs
import kotlin.math.cos

/** How a [Drive] becomes what is sent to the actuators; what is not finite becomes rest. Named in a mission's JSON. */
@Serializable
public enum class Mixing(
    /** Share of full thrust that a follower should give in a full turn: what does not turn on the spot turns faster with it. */
    public val turnThrust: Double,
) {
    /** Two thrusters: turning is kept where both cannot be had, because a boat that turns can still be led. */
    @SerialName("differential")
    DIFFERENTIAL(turnThrust = 0.0) {
        override fun mix(drive: Drive): Actuation {
            if (!drive.forward.isFinite() || !drive.turn.isFinite()) return Actuation.Differential(0.0, 0.0)
            val turn = drive.turn.coerceIn(-1.0, 1.0)
            val room = 1 - abs(turn)
            val forward = drive.forward.coerceIn(-maxOf(room, LEAST), maxOf(room, LEAST))
            return Actuation.Differential((forward - turn).coerceIn(-1.0, 1.0), (forward + turn).coerceIn(-1.0, 1.0))
        }

        override fun ahead(drive: Drive): Double {
            val mixed = mix(drive) as Actuation.Differential
            return (mixed.left + mixed.right) / 2
        }
    },

    /** A swivelled thruster: without thrust it does not turn, so a turn asks for some. */
    @SerialName("vectored")
    VECTORED(turnThrust = 0.6) {
        override fun mix(drive: Drive): Actuation {
            if (!drive.forward.isFinite() || !drive.turn.isFinite()) return Actuation.Vectored(0.0, 0.0)
            val turn = drive.turn.coerceIn(-1.0, 1.0)
            val forward = drive.forward.coerceIn(-1.0, 1.0)
            val thrust = if (forward >= 0) maxOf(forward, LEAST * abs(turn)) else forward
            return Actuation.Vectored(thrust, turn)
        }

        override fun ahead(drive: Drive): Double {
            val mixed = mix(drive) as Actuation.Vectored
            return mixed.thrust * cos(FULL_SWIVEL * mixed.rudder)
        }
    }, ;

    /** What [drive] is for this boat. */
    public abstract fun mix(drive: Drive): Actuation

    /** Share of full thrust that drives the boat ahead once [drive] is mixed, negative astern. */
    public abstract fun ahead(drive: Drive): Double
}

/** Share of full thrust kept for the other use. */
private const val LEAST = 0.25

/** Angle of a full swivel, rad: the airboats' servos. */
private const val FULL_SWIVEL = PI / 4
