package stillwater.model

/**
 * How hard the boat is to push and turn, as a follower asks for it.
 *
 * May hold anything, NaN included: what is not finite is the safety gate's to catch.
 *
 * @property forward share of full thrust, dimensionless, −1 (astern) to 1 (ahead).
 * @property turn share of full turning effort, dimensionless, −1 (to starboard) to 1 (to port, counter-clockwise).
 */
public data class Drive(val forward: Double, val turn: Double) {
    public companion object {
        /** Motors at rest. */
        public val NONE: Drive = Drive(0.0, 0.0)
    }
}

/** What is sent to the actuators of a boat. Each share is dimensionless, in [−1, 1] and finite. */
public sealed interface Actuation {
    /** Whether nothing is driven: no thrust, on either side. */
    public val isAtRest: Boolean

    /** Two fixed thrusters: [left] is the board's motor 0, [right] its motor 1; shares of full thrust. */
    public data class Differential(val left: Double, val right: Double) : Actuation {
        init {
            requireShare("left", left)
            requireShare("right", right)
        }

        override val isAtRest: Boolean get() = left == 0.0 && right == 0.0
    }

    /**
     * One thruster that can be swivelled, as an airboat's fan.
     *
     * @property thrust share of full thrust.
     * @property rudder share of the full swivel, positive turns the boat to port; the board's servo has the other sign.
     */
    public data class Vectored(val thrust: Double, val rudder: Double) : Actuation {
        init {
            requireShare("thrust", thrust)
            requireShare("rudder", rudder)
        }

        override val isAtRest: Boolean get() = thrust == 0.0
    }

    private companion object {
        fun requireShare(name: String, value: Double) {
            require(value in -1.0..1.0) { "$name ($value) must be in [-1, 1]" }
        }
    }
}
