package stillwater.mission

import stillwater.control.TrackEstimator
import stillwater.plan.Pace
import kotlin.math.hypot
import kotlin.math.sqrt

/**
 * How much longer a leg takes in the drift that [track] believed in at the last [look], for a boat of [cruise] m/s
 * through the water.
 *
 * Over ground v = c∥ + √(u² − c⊥²), c the drift and u the cruise speed. A drift in the boat's favour may have turned by
 * then and is not reckoned with, nor is one below [LEAST]. A boat that is held up seems to drift as fast as it drives:
 * it is looked at while it gets on.
 */
internal class DriftPace(private val track: TrackEstimator, private val cruise: Double) : Pace {
    private var driftX = 0.0
    private var driftY = 0.0

    /** What drifts now is reckoned with from now on. */
    fun look() {
        driftX = track.driftX
        driftY = track.driftY
    }

    override fun of(east: Double, north: Double): Double {
        val drift = hypot(driftX, driftY)
        val length = hypot(east, north)
        if (!(drift >= LEAST) || !(length > 0)) return 1.0
        val along = (driftX * east + driftY * north) / length
        val across = (driftX * north - driftY * east) / length
        val speed = along + sqrt(maxOf(0.0, cruise * cruise - across * across))
        return maxOf(1.0, cruise / maxOf(speed, SLOWEST * cruise))
    }

    private companion object {
        /** Fixes of 1.5 m alone make about as much seem to flow, and a reserve of a fifth makes up for it, m/s. */
        const val LEAST = 0.2

        /** Share of the cruise speed over ground at which a boat gets nowhere in any time that matters. */
        const val SLOWEST = 0.1
    }
}
