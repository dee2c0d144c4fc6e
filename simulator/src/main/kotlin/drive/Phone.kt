package stillwater.drive

import stillwater.model.BoatTime
import stillwater.model.LatLon

/**
 * A fix of a receiver.
 *
 * @property time of the fix on the boat's clock.
 * @property place where the receiver takes itself to be.
 */
data class PhoneFix(val time: BoatTime, val place: LatLon)

/**
 * What is known when a step is due.
 *
 * @property time on the boat's clock; later than that of the moment before.
 * @property fixes since the moment before, in order.
 * @property heading rad, counter-clockwise from east; NaN where nothing new is known.
 * @property yawRate rad/s; NaN where not known.
 * @property sent bytes that the board has sent since its wire was opened; null where nobody counts.
 */
data class Moment(
    val time: BoatTime,
    val fixes: List<PhoneFix>,
    val heading: Double,
    val yawRate: Double,
    val sent: Long? = null,
)

/**
 * Stands where the phone is aboard: tells the mission the time, where it is and which way it looks. Confined to one
 * thread.
 */
interface Phone : AutoCloseable {
    /** How often time had to go on without the phone's clock. */
    val timesAlone: Long get() = 0

    /** Waits until the next step is due, 2 s at most, and tells what is known then. */
    fun await(): Moment

    /** The step at the moment last told has been taken, and all its bytes were sent. */
    fun done()

    /** What there is to know of it for a person, such as lines that could not be read; empty where all is well. */
    fun trouble(): String

    override fun close()
}
