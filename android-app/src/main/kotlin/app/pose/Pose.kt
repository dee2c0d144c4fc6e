package stillwater.app.pose

import android.os.Handler
import stillwater.control.PhoneTurn

/**
 * Where the boat is and which way it points, as far as the phone knows: the phone's own receiver and sensors, or the
 * demo's. Started and stopped on one thread; all else may be read from any.
 */
internal interface Pose {
    /** The newest fix, null before the first. */
    val fix: PhoneFix?

    /** The newest heading; null where no sensor says. */
    val heading: PhoneHeading?

    /** Why there can be no fix, null where nothing is in the way. */
    val problem: PoseProblem?

    /** Fixes received since [start]. */
    val fixes: Long

    /** Fixes among them that lay farther from the one before than a boat goes. */
    val jumps: Long

    /** Begins to listen, on [handler]'s thread. */
    fun start(handler: Handler)

    /** Listens no more. */
    fun stop()
}

/**
 * Which way the boat points.
 *
 * @property radians from east, counter-clockwise.
 * @property yawRate rad/s, counter-clockwise; NaN where no gyroscope says.
 * @property elapsedNanos when it was, ns since the phone started.
 */
class PhoneHeading(val radians: Double, val yawRate: Double, val elapsedNanos: Long) {
    /** The same as a compass has it, degrees from north, clockwise, in 0 until 360. */
    val degrees: Float get() = PhoneTurn.compassDeg(radians).toFloat()

    companion object {
        /** What a compass that shows [degrees] from true north says. */
        fun ofCompass(degrees: Double, yawRate: Double, elapsedNanos: Long): PhoneHeading =
            PhoneHeading(PhoneTurn.heading(degrees), yawRate, elapsedNanos)
    }
}

/** What is in the way of a fix. */
enum class PoseProblem {
    /** The phone has no receiver. */
    NO_RECEIVER,

    /** The permission is not given. */
    NOT_PERMITTED,

    /** It is switched off in the phone's settings. */
    SWITCHED_OFF,
}
