package stillwater.control

import kotlin.math.sqrt

/**
 * The speed through the water that a boat is believed to have, from what its thrusters are told.
 *
 * u̇ = (v √a − u) / T, a the share of full thrust ahead, v the top speed: thrust grows with the speed's square. It need not
 * be exact: what it is wrong by ends up in [TrackEstimator]'s drift, if it is wrong for long; what changes within seconds,
 * as in a turn, must come from here. Confined to one thread.
 *
 * @property topSpeed at full thrust, m/s, above 0 and finite.
 * @throws IllegalArgumentException if it is not.
 */
public class WaterSpeed(public val topSpeed: Double) {
    init {
        require(topSpeed > 0 && topSpeed.isFinite()) { "topSpeed ($topSpeed m/s) must be above 0 and finite" }
    }

    /** Speed through the water, m/s. */
    public var value: Double = 0.0
        private set

    /** Lets [dt] s pass under [ahead], a share of full thrust; not finite counts as rest. */
    public fun advance(dt: Double, ahead: Double) {
        if (!(dt > 0)) return
        val share = if (ahead > 0) minOf(ahead, 1.0) else 0.0
        value += minOf(1.0, dt / HULL_TIME) * (topSpeed * sqrt(share) - value)
    }

    private companion object {
        /** Time constant with which a hull takes up speed, s. */
        const val HULL_TIME = 2.0
    }
}
