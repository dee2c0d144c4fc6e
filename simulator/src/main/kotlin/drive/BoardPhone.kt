package stillwater.drive

import stillwater.mission.BoardClock
import stillwater.model.BoatTime
import stillwater.wire.ByteLink
import stillwater.wire.LineFramer
import stillwater.wire.Message
import stillwater.wire.PlatypusCodec
import java.util.concurrent.locks.LockSupport
import kotlin.math.PI

/**
 * A boat without a phone: a laptop has its fixes from the GPS receiver on the board and its heading from the board's
 * inertial unit, and its time from the wall.
 *
 * The mission's own link passes through [tap], which reads along. A fix carries the receiver's time of day: with it
 * [BoardClock] takes out how much longer one line was under way than the fastest. A heading counts only where the unit
 * says that its magnetometer is calibrated; without heading the mission does not start. Course over ground is no
 * heading: a boat at rest has none.
 *
 * @param declinationDeg of the magnetic north from the true one, degrees, east positive.
 */
internal class BoardPhone(private val declinationDeg: Double) : Phone {
    private val clock = BoardClock()
    private val codec = PlatypusCodec(::heard)
    private val framer = LineFramer(codec)
    private val fixes = ArrayList<PhoneFix>()
    private val begun = System.nanoTime()
    private var due = begun
    private var now = BoatTime(0.0)
    private var heading = Double.NaN
    private var seesGps = false
    private var seesHeading = false

    /** [link], read along. */
    fun tap(link: ByteLink): ByteLink = object : ByteLink {
        override fun read(into: ByteArray): Int {
            val count = link.read(into)
            if (count == ByteLink.LOST) framer.reset() else framer.accept(into, 0, count)
            return count
        }

        override fun write(bytes: ByteArray): Boolean = link.write(bytes)
    }

    override fun await(): Moment {
        due += STEP_NANOS
        // A step that came late is not made up for: the board's state is what matters, not the number of steps.
        due = maxOf(due, System.nanoTime() - STEP_NANOS)
        while (true) {
            val left = due - System.nanoTime()
            if (left <= 0) break
            LockSupport.parkNanos(left)
        }
        now = BoatTime((System.nanoTime() - begun) / NANOS)
        val moment = Moment(now, fixes.toList(), heading, Double.NaN)
        fixes.clear()
        heading = Double.NaN
        return moment
    }

    override fun done() = Unit

    override fun trouble(): String = listOfNotNull(
        "the board's GPS has no fix".takeIf { !seesGps },
        "no calibrated heading from the board yet".takeIf { !seesHeading },
    ).joinToString(", ")

    override fun close() = Unit

    private fun heard(message: Message) {
        if (message is Message.Fix) {
            seesGps = message.place != null
            val place = message.place ?: return
            fixes += PhoneFix(clock.sampled((message.secondsOfDay * MILLIS).toLong(), now), place)
        }
        if (message is Message.Imu && message.magnetometer > 0) {
            seesHeading = true
            heading = Math.IEEEremainder((RIGHT_ANGLE_DEG - message.headingDeg - declinationDeg) / 180 * PI, 2 * PI)
        }
    }

    private companion object {
        const val STEP_NANOS = 100_000_000L
        const val NANOS = 1e9
        const val MILLIS = 1000.0
        const val RIGHT_ANGLE_DEG = 90.0
    }
}
