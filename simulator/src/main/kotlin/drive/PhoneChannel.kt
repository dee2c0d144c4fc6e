package stillwater.drive

import stillwater.link.BoardWire
import stillwater.link.PhoneReport
import stillwater.link.ReconnectingWire
import stillwater.link.WireAddress
import stillwater.model.BoatTime
import stillwater.model.LatLon
import stillwater.report.counted
import stillwater.wire.LineFramer
import java.util.concurrent.locks.LockSupport

/**
 * The simulated phone of a virtual boat, over TCP: the boat's time comes from there, with fixes and compass.
 *
 * So one clock holds on both sides however fast the boat's time runs, and a pause of either program stops it rather
 * than being taken for a lost link. Where nothing is heard for [PATIENCE] s of wall time, or the channel is lost, time
 * goes on here by itself, step by step, so that the mission sees that its link is gone; when the boat comes back,
 * perhaps with its clock at 0, time goes on from there. Readings around such a gap come at other times than the boat's, so
 * [timesAlone] is to be told to whoever uses the map.
 *
 * @param wire to the boat's phone. Retained, and closed with this.
 * @param nanos wall time, ns.
 */
internal class PhoneChannel(
    private val wire: ReconnectingWire,
    private val nanos: () -> Long = System::nanoTime,
) : Phone {
    private val buffer = ByteArray(BUFFER)
    private val framer = LineFramer({ bytes, start, end -> heard(String(bytes, start, end - start, Charsets.UTF_8)) })
    private var report: PhoneReport? = null
    private var answering = 0L
    private var shift = 0.0
    private var lastTheirs = 0.0
    private var last = 0.0
    private var unreadable = 0L
    private var isAlone = false

    override var timesAlone: Long = 0
        private set

    override fun await(): Moment {
        val from = nanos()
        while (report == null) {
            val count = wire.read(buffer)
            if (count > 0) framer.accept(buffer, 0, count)
            if (report != null) break
            if (count < 0) framer.reset()
            // Also where bytes come without end and none of them is a report.
            val waited = nanos() - from
            if (waited >= if (isAlone || !wire.isOpen) STEP_NANOS else PATIENCE_NANOS) return byItself()
            // Busy at first: at sixty times wall time the next report is a fraction of a millisecond away.
            if (count <= 0 && waited > BUSY_NANOS) LockSupport.parkNanos(PAUSE_NANOS) else Thread.onSpinWait()
        }
        return told(checkNotNull(report))
    }

    override fun done() {
        if (answering > 0) wire.write(PhoneReport.done(answering).toByteArray())
        answering = 0
    }

    override fun trouble(): String = listOfNotNull(
        "phone's channel lost".takeIf { !wire.isOpen },
        "${counted(timesAlone, "time")} without the phone".takeIf { timesAlone > 0 },
        "$unreadable of the phone's lines unreadable".takeIf { unreadable > 0 },
    ).joinToString(", ")

    override fun close() = wire.close()

    private fun heard(line: String) {
        val found = PhoneReport.parse(line)
        if (found == null) unreadable++ else report = found
    }

    private fun told(report: PhoneReport): Moment {
        this.report = null
        answering = report.tick
        isAlone = false
        val isAnew = report.time <= lastTheirs || report.time + shift <= last
        lastTheirs = report.time
        if (isAnew) shift = last + STEP - report.time
        last = report.time + shift
        val fix = report.fix?.let { PhoneFix(BoatTime(it.time + shift), LatLon(it.latitude, it.longitude)) }
        return Moment(BoatTime(last), listOfNotNull(fix), report.heading, report.yawRate, report.sent)
    }

    private fun byItself(): Moment {
        if (!isAlone) timesAlone++
        isAlone = true
        // The boat's clock may have stood meanwhile: no more than a step, or all that follows is later than it was.
        last += STEP
        return Moment(BoatTime(last), emptyList(), Double.NaN, Double.NaN)
    }

    companion object {
        /** Without a report for so long, s of wall time, the mission's time goes on by itself. */
        const val PATIENCE = 2.0
        private const val STEP = 0.1
        private const val NANOS = 1e9
        private const val PATIENCE_NANOS = (PATIENCE * NANOS).toLong()
        private const val STEP_NANOS = (STEP * NANOS).toLong()
        private const val BUSY_NANOS = 50_000L
        private const val PAUSE_NANOS = 50_000L
        private const val BUFFER = 4096

        /** Opens the channel at [address]; throws [stillwater.link.WireProblem] where nobody listens. */
        fun open(address: WireAddress.Tcp): PhoneChannel {
            val opener = address.opener()
            val first: BoardWire = opener.open()
            return PhoneChannel(ReconnectingWire(opener, first))
        }
    }
}
