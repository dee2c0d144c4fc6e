package stillwater.link

import stillwater.wire.ByteLink
import java.util.concurrent.atomic.AtomicReference

/**
 * A wire that is opened again when it was lost, with pauses that double from [FIRST_PAUSE] to [LONGEST_PAUSE] ms.
 *
 * Opening goes on beside, on a thread of its own: the mission steps on meanwhile and reads [ByteLink.LOST]. Opening a
 * port can reset the board; that is for the mission to see in what the board says of itself. Everything else is
 * confined to one thread.
 *
 * @param opener opens it again. Retained.
 * @param first already open. Retained, closed with this.
 * @param rest lets so many ms of wall time pass.
 */
class ReconnectingWire(
    private val opener: WireOpener,
    first: BoardWire,
    private val rest: (Long) -> Unit = Thread::sleep,
) : BoardWire {
    private var wire: BoardWire? = first
    private val found = AtomicReference<BoardWire?>()

    @Volatile
    private var isClosed = false

    /** Times the wire was lost. */
    var losses = 0L
        private set

    /** Times it was opened again. */
    var reconnections = 0L
        private set

    /** Whether there is a wire now. */
    val isOpen: Boolean get() = wire != null

    override fun read(into: ByteArray): Int {
        val count = current()?.read(into) ?: return ByteLink.LOST
        if (count == ByteLink.LOST) lose()
        return count
    }

    override fun write(bytes: ByteArray): Boolean = current()?.write(bytes) ?: false

    override fun close() {
        isClosed = true
        wire?.close()
        wire = null
        found.getAndSet(null)?.close()
    }

    private fun current(): BoardWire? {
        if (wire == null) {
            wire = found.getAndSet(null)?.also { reconnections++ }
        }
        return wire
    }

    private fun lose() {
        wire?.close()
        wire = null
        losses++
        Thread(::seek, "open the board's wire again").apply { isDaemon = true }.start()
    }

    private fun seek() {
        var pause = FIRST_PAUSE
        while (!isClosed) {
            rest(pause)
            pause = minOf(2 * pause, LONGEST_PAUSE)
            try {
                found.set(opener.open())
                // Closed meanwhile: nobody will come for it.
                if (isClosed) found.getAndSet(null)?.close()
                return
            } catch (_: WireProblem) {
                // Not there yet.
            }
        }
    }

    companion object {
        /** Pause before the wire is opened again, ms. */
        const val FIRST_PAUSE = 250L

        /** Longest pause between two attempts, ms. */
        const val LONGEST_PAUSE = 8000L
    }
}
