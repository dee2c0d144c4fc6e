package stillwater.app.demo

import android.os.Handler
import stillwater.app.link.BoardLink
import stillwater.app.link.LinkHealth
import stillwater.app.link.LinkState
import stillwater.app.pose.PhoneFix
import stillwater.app.pose.PhoneHeading
import stillwater.app.pose.Pose
import stillwater.app.pose.PoseProblem
import stillwater.control.Mixing
import stillwater.mission.MissionSpec
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import stillwater.model.Position
import stillwater.sensor.SensorSpec
import stillwater.virtual.BoardSpec
import stillwater.virtual.PlumeWater
import stillwater.virtual.VirtualBoat
import stillwater.virtual.VirtualBoatSpec

/**
 * Core's virtual boat in place of a board and of the phone's own receiver: the mission sees bytes and fixes as always.
 *
 * [advance] is the boat thread's; [link] may be written to by the watchdog too, so both take turns.
 *
 * @param name what the screen calls the link.
 * @param mission at whose home the boat lies; null for a pond of its own.
 */
internal class DemoBoat(name: String, mission: MissionSpec?) {
    private val home = mission?.home?.let { Position(it.x, it.y) } ?: Position(0.0, 0.0)
    private val boat =
        VirtualBoat(
            VirtualBoatSpec(
                PROBE,
                board = BOARD,
                vectored = mission?.boat?.mixing == Mixing.VECTORED,
                start = home,
            ),
            PlumeWater(mission?.grid?.grid()?.let { it.center(it.rows / 2 * it.columns + it.columns / 2) } ?: home),
            LocalFrame(mission?.origin?.let { LatLon(it.latitude, it.longitude) } ?: POND),
            SEED,
        )
    private var before = Double.NaN

    /** Its link, to be used as Bluetooth's. */
    val link: BoardLink = DemoLink(name)

    /** Its receiver and compass. */
    val pose: Pose = DemoPose()

    /** Readings that its probe has sent, by the board's own count. */
    val readings: Long get() = synchronized(boat) { boat.board.readings }

    private var newest: PhoneFix? = null
    private var pointing: PhoneHeading? = null
    private var seen = 0L

    /** Lets its time pass until [now], s on the phone's clock; what is longer than [LONGEST] is cut. */
    fun advance(now: Double) =
        synchronized(boat) {
            if (before.isFinite()) boat.advance(minOf(now - before, LONGEST))
            before = now
            val nanos = (now * NANOS_PER_SECOND).toLong()
            boat.takeFix()?.let {
                seen++
                newest = PhoneFix(it.place, ACCURACY, null, null, nanos)
            }
            pointing = PhoneHeading(boat.heading(), boat.yawRate, nanos)
        }

    private inner class DemoPose : Pose {
        override val fix: PhoneFix? get() = newest
        override val heading: PhoneHeading? get() = pointing
        override val problem: PoseProblem? = null
        override val fixes: Long get() = seen
        override val jumps = 0L

        override fun start(handler: Handler) = Unit

        override fun stop() = Unit
    }

    private inner class DemoLink(override val name: String) : BoardLink {
        private var counted = LinkHealth()

        override val health: LinkHealth get() = synchronized(boat) { counted }

        override fun open() =
            synchronized(boat) {
                counted = LinkHealth(LinkState.CONNECTED, connects = 1, quietMillis = 0)
            }

        override fun close() = synchronized(boat) { counted = counted.copy(state = LinkState.CLOSED) }

        override fun read(into: ByteArray): Int =
            synchronized(boat) {
                boat.phone.read(into).also { counted = counted.copy(bytesIn = counted.bytesIn + maxOf(it, 0)) }
            }

        override fun write(bytes: ByteArray): Boolean =
            synchronized(boat) {
                counted = counted.copy(bytesOut = counted.bytesOut + bytes.size)
                counted.state == LinkState.CONNECTED && boat.phone.write(bytes)
            }
    }

    private companion object {
        /** Quick to arm, and its probe was set up before, so that the checklist hears it. */
        val BOARD = BoardSpec(watchdog = 0.5, arming = 2.0, oxygenPeriod = 1.0, batteryPeriod = 1.0)

        /** A probe as slow as the real ones of its kind, s; noise in mg/L. */
        val PROBE =
            SensorSpec.fromJson(
                """{"name":"demo","stages":[{"type":"first-order-lag","time_constant_s":8.0},""" +
                    """{"type":"noise","standard_deviation":0.02}]}""",
            )

        /** Lac Hertel, in Quebec: a lake that boats of this kind were tried on. */
        val POND = LatLon(45.544, -73.152)
        const val SEED = 1L
        const val ACCURACY = 3f
        const val LONGEST = 2.0
        const val NANOS_PER_SECOND = 1e9
    }
}
