package stillwater.boatserver

import stillwater.link.PhoneReport
import stillwater.link.ServedWire
import stillwater.virtual.VirtualBoat
import stillwater.virtual.VirtualLink
import stillwater.world.VirtualWorld
import java.util.concurrent.locks.LockSupport
import kotlin.math.roundToLong

/**
 * A virtual boat that other programs sail: its board on a wire, its phone's time, fixes and compass on another.
 *
 * The boat's time begins when somebody opens the phone's wire, or a second after the board's, and goes at [speed] times
 * wall time, or slower where the machine is. While a phone's program is there, each tenth of a second waits until the
 * program has answered the report of the one before: then a pause of that program, however short on the wall, is not a
 * long cut on the boat. A program that does not answer for [patience] is not waited for until it does, so that a
 * boat whose brain hangs feels its watchdog. Opening the wire resets the board. Confined to one thread, but for [stop].
 *
 * @param world boat and water. @param wire the board's. @param phone the phone's. All retained.
 * @param speed the boat's seconds in one of the wall's, above 0. @param patience with the phone's program, ns of wall time.
 */
internal class BoatServer(
    private val world: VirtualWorld,
    private val wire: ServedWire,
    private val phone: PhoneServer,
    private val speed: Double,
    private val patience: Long = PATIENCE_NANOS,
) {
    private val buffer = ByteArray(BUFFER)
    private val boat: VirtualBoat = world.boat
    private var openings = 0L
    private var tick = 0L
    private var sent = 0L
    private var isHanging = false
    private var base = 0L
    private var baseTime = 0.0

    @Volatile
    private var isStopped = false

    /** Times the boat's time fell behind, because this machine was slow or busy. */
    var slips = 0L
        private set

    /** Ends [serve] soon. */
    fun stop() {
        isStopped = true
    }

    /**
     * Serves until [stop], until the boat's time is [until] s, or, if [isOnce], until the program that came has left.
     */
    fun serve(until: Double, isOnce: Boolean) {
        while (!isStopped && !attend()) LockSupport.parkNanos(IDLE_NANOS)
        val opened = System.nanoTime()
        while (!isStopped && attend() && !phone.attend() && System.nanoTime() - opened < COMPANY_NANOS) {
            LockSupport.parkNanos(IDLE_NANOS)
        }
        base = System.nanoTime()
        baseTime = world.time.seconds
        while (!isStopped && world.time.seconds < until) {
            val isAttended = attend()
            if (isOnce && !isAttended) return
            repeat(TICKS) {
                hear()
                world.advance(VirtualBoat.TICK)
                say()
            }
            tick++
            // The system hands bytes on in its own time: half a step of the wall's lies between them and the report that
            // the step at this time may be taken, and half between the answer and the board's hearing what was sent.
            pace(world.time.seconds - HALF_STEP)
            report()
            awaitAnswer()
            pace(world.time.seconds)
        }
    }

    private fun attend(): Boolean {
        val isWired = wire.attend()
        if (wire.openings != openings) {
            openings = wire.openings
            sent = 0
            boat.board.reset()
        }
        return phone.attend() || isWired
    }

    /**
     * From the wire to the board, at most as much as its link holds: a program that never stops sending holds up only
     * itself.
     */
    private fun hear() {
        val count = wire.read(buffer)
        if (count > 0) boat.phone.write(buffer.copyOf(count))
    }

    /** From the board to the wire. */
    private fun say() {
        while (true) {
            val count = boat.phone.read(buffer)
            if (count <= 0) return
            val untaken = wire.untaken
            wire.write(buffer, count)
            sent += count - (wire.untaken - untaken)
        }
    }

    private fun report() {
        if (!phone.attend() || !phone.isAnswered()) return
        val fix = boat.takeFix()
        val seen = fix?.let { PhoneReport.Fix(it.time.seconds, it.place.latitudeDeg, it.place.longitudeDeg) }
        phone.tell(PhoneReport(tick, boat.time.seconds, boat.heading(), boat.yawRate, seen, sent))
    }

    /** Waits until the wall's time is that of the boat's [seconds]. */
    private fun pace(seconds: Double) {
        val due = base + ((seconds - baseTime) / speed * NANOS).roundToLong()
        var left = due - System.nanoTime()
        // What is lost is not made up for in a burst.
        if (left < -SLIP_NANOS) {
            slips++
            base -= left
        }
        while (left > 0 && !isStopped) {
            LockSupport.parkNanos(minOf(left, IDLE_NANOS))
            left = due - System.nanoTime()
        }
    }

    private fun awaitAnswer() {
        if (!phone.attend() || phone.isAnswered()) {
            isHanging = false
            return
        }
        if (isHanging) return
        val from = System.nanoTime()
        while (!isStopped && phone.attend() && !phone.isAnswered()) {
            val waited = System.nanoTime() - from
            if (waited > patience) {
                phone.giveUp()
                isHanging = true
                return
            }
            if (waited > BUSY_NANOS) LockSupport.parkNanos(BUSY_NANOS) else Thread.onSpinWait()
        }
    }

    companion object {
        /** Wall time for which a phone's program is waited for, ns. */
        const val PATIENCE_NANOS = 2_000_000_000L
        private const val COMPANY_NANOS = 1_000_000_000L
        private const val TICKS = 5
        private const val HALF_STEP = 0.05
        private const val NANOS = 1e9
        private const val SLIP_NANOS = 250_000_000L
        private const val IDLE_NANOS = 5_000_000L
        private const val BUSY_NANOS = 50_000L
        private const val BUFFER = VirtualLink.CAPACITY
    }
}
