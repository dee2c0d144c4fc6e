package stillwater.control

import stillwater.model.LatLon
import stillwater.model.LocalFrame
import kotlin.math.abs
import kotlin.math.hypot
import kotlin.math.max

/**
 * What a receiver's fixes are worth by themselves: how wide, and whether one lies farther from the one before than a
 * boat goes. For counts and screens; what a mission makes of its fixes is [TrackEstimator]'s.
 *
 * A jump: d > 3 (a + b) + v t, d the way between two fixes, a and b their accuracies, v the fastest boat's speed, t
 * the time between them. Two that jumped, but lie near each other, are where the boat is now. Confined to one thread.
 */
public class FixCheck {
    private var trusted: Fix? = null
    private var doubted: Fix? = null

    /** Fixes so far that lay farther from the one before than a boat goes. */
    public var jumps: Long = 0
        private set

    /**
     * Whether the fix of [place] at [seconds] lies where no boat can have got to since the one before.
     *
     * @param accuracy radius of 68 % confidence, m; 0 where the receiver does not say.
     */
    public fun isJump(seconds: Double, place: LatLon, accuracy: Double): Boolean {
        val fix = Fix(seconds, place, accuracy)
        val jumped = trusted?.let { isFar(it, fix) } == true
        if (!jumped || doubted?.let { !isFar(it, fix) } == true) {
            trusted = fix
            doubted = null
        } else {
            doubted = fix
        }
        if (jumped) jumps++
        return jumped
    }

    private fun isFar(before: Fix, now: Fix): Boolean {
        val reach = ERRORS * (before.accuracy + now.accuracy) + FASTEST_BOAT * max(0.0, now.seconds - before.seconds)
        return !(metres(before.place, now.place) <= reach)
    }

    /** From [a] to [b]; infinite beyond a quarter of the globe, where the flat frame folds back, and at the poles. */
    private fun metres(a: LatLon, b: LatLon): Double {
        val apart = max(
            abs(a.latitudeDeg - b.latitudeDeg),
            abs(Math.IEEEremainder(a.longitudeDeg - b.longitudeDeg, FULL_TURN)),
        )
        if (apart > QUARTER_TURN || !LocalFrame.canStartAt(a.latitudeDeg)) return Double.POSITIVE_INFINITY
        val way = LocalFrame(a).toLocal(b)
        return hypot(way.x, way.y)
    }

    private class Fix(val seconds: Double, val place: LatLon, val accuracy: Double)

    public companion object {
        /** Wider than a lawnmower's lane on a pond, a fix is no use to a mission; m. */
        public const val WIDEST: Double = 10.0

        /** What a receiver takes for possible itself counts as its error, so many times over. */
        private const val ERRORS = 3.0

        /** With a current, m/s; a car's to the shore is none of it. */
        private const val FASTEST_BOAT = 5.0
        private const val FULL_TURN = 360.0
        private const val QUARTER_TURN = 90.0

        /** Whether a fix of [accuracy], m, null where the receiver does not say, is good enough for a mission. */
        public fun isNarrow(accuracy: Double?): Boolean = accuracy != null && accuracy <= WIDEST
    }
}
