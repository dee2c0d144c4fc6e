package stillwater.drive

import stillwater.wire.ByteLink
import java.util.concurrent.locks.LockSupport

/**
 * A wire of which it is known how many bytes were sent on it: [await] waits for those that the system still holds back.
 *
 * At sixty times wall time the few milliseconds that a pseudo-terminal may take are tenths of a second to the boat, and an
 * estimator that undoes a sensor's lag is sensitive to readings that come at odd times. Bytes that do not come within
 * [PATIENCE_NANOS], or that are more than any board sends, are taken for lost and not waited for again. Confined to one thread.
 *
 * @param link to the board. Retained.
 * @param nanos wall time, ns.
 */
internal class PromptWire(private val link: ByteLink, private val nanos: () -> Long = System::nanoTime) : ByteLink {
    private var held = ByteArray(0)
    private var taken = 0
    private val buffer = ByteArray(BUFFER)
    private var received = 0L
    private var lost = 0L
    private var isLost = false

    /** How often bytes did not come in time. */
    var timesLate = 0L
        private set

    /** Waits until as many bytes have come as were [sent] since the wire was opened. */
    fun await(sent: Long) {
        // A wire that was opened anew counts from 0 again.
        if (sent < received + lost) {
            received = 0
            lost = 0
        }
        val from = nanos()
        while (received + lost < sent && !isLost) {
            val count = link.read(buffer)
            if (count == ByteLink.LOST) isLost = true
            if (count > 0) keep(count)
            if (nanos() - from > PATIENCE_NANOS || held.size - taken > MOST_HELD) {
                timesLate++
                lost = sent - received
            } else if (count == 0) {
                LockSupport.parkNanos(PAUSE_NANOS)
            }
        }
    }

    override fun read(into: ByteArray): Int {
        if (taken < held.size) {
            val count = minOf(into.size, held.size - taken)
            held.copyInto(into, 0, taken, taken + count)
            taken += count
            return count
        }
        if (isLost) {
            isLost = false
            return ByteLink.LOST
        }
        return link.read(into).also { if (it > 0) received += it }
    }

    override fun write(bytes: ByteArray): Boolean = link.write(bytes)

    private fun keep(count: Int) {
        held = held.copyOfRange(taken, held.size) + buffer.copyOf(count)
        taken = 0
        received += count
    }

    companion object {
        /** Wall time for which bytes are waited for, ns: less than a virtual boat waits for an answer. */
        const val PATIENCE_NANOS = 1_000_000_000L
        private const val PAUSE_NANOS = 50_000L
        private const val BUFFER = 4096

        /** Bytes that are held for the mission at most: minutes of a board's. */
        private const val MOST_HELD = 1 shl 18
    }
}
