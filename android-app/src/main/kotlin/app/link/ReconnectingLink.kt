package stillwater.app.link

import android.util.Log
import stillwater.app.R
import stillwater.app.mayWait
import stillwater.wire.ByteLink
import java.io.IOException

/** Lets a thread wait; a test's does not. */
internal fun interface Pause {
    /** Waits [millis] ms, or until the thread is interrupted. */
    @Throws(InterruptedException::class)
    fun pause(millis: Long)
}

/**
 * Keeps a connection to the board through everything: one thread connects, reads, closes, waits longer each time and
 * connects afresh; another one writes. What calls [read] and [write] never waits for either.
 *
 * A connection over which one command takes too long is given up, and counted: a stop is not to queue behind it.
 * Nothing received over one connection is handed out over the next. What was taken before [close] goes out first, for
 * as long as [parting] lets.
 *
 * @param words says a text of the app's own, by its resource. Retained.
 * @param pause waits between attempts. Retained.
 * @param parting how a connection that was closed on purpose ends. Retained.
 * @param uptimeMillis a clock that never goes back, ms. Retained.
 */
internal class ReconnectingLink(
    private val transport: Transport,
    private val words: (Int) -> String,
    private val pause: Pause = Pause(Thread::sleep),
    private val parting: Parting = Parting(),
    private val uptimeMillis: () -> Long = { System.nanoTime() / NANOS_PER_MILLI },
) : BoardLink {
    private val lock = Any()
    private val received = ByteRing(RECEIVED_BYTES)
    private var counted = LinkHealth()
    private var heardAt = 0L
    private var session: Session? = null

    override val name: String get() = transport.name

    override val health: LinkHealth
        get() =
            synchronized(lock) {
                if (counted.state != LinkState.CONNECTED) return counted
                counted.copy(quietMillis = uptimeMillis() - heardAt)
            }

    override fun open() {
        synchronized(lock) {
            if (session != null) return
            counted = LinkHealth(state = LinkState.CONNECTING)
            session = Session().also { it.start() }
        }
    }

    override fun close() {
        val ended =
            synchronized(lock) {
                counted = counted.copy(state = LinkState.CLOSED)
                session.also { session = null }
            }
        ended?.end()
    }

    override fun read(into: ByteArray): Int {
        giveUpWhatHangs()
        val taken = received.take(into)
        return if (taken == 0 && health.state != LinkState.CONNECTED) ByteLink.LOST else taken
    }

    override fun write(bytes: ByteArray): Boolean {
        giveUpWhatHangs()
        val open = synchronized(lock) { session.takeIf { counted.state == LinkState.CONNECTED } }
        if (open?.writer?.take(bytes) == true) return true
        synchronized(lock) { counted = counted.copy(writesDropped = counted.writesDropped + 1) }
        return false
    }

    /** Both the boat's thread and the one that looks after it come by here, ten times a second. */
    private fun giveUpWhatHangs() {
        synchronized(lock) { session }?.giveUpWhatHangs()
    }

    /**
     * From one [open] to the next [close], or until a command hangs; what an ended one still does, nobody sees.
     *
     * @param isAfterHang whether it follows one whose connection was given up.
     */
    private inner class Session(private val isAfterHang: Boolean = false) : CommandWriter.Told {
        private val reader = Thread(::connectAndRead, "link-read").apply { isDaemon = true }
        private val waits = ReconnectWaits()

        @Volatile private var ended = false

        @Volatile private var connection: Connection? = null

        /** Of the connection that came about last; null before the first. */
        @Volatile var writer: CommandWriter? = null
            private set

        fun start() = reader.start()

        /** Ends it on a thread of its own: closing may wait, and so may the last words. */
        fun end() {
            ended = true
            Thread(::part, "link-close").apply { isDaemon = true }.start()
        }

        private fun part() {
            // A new attempt begins no more; what is open stays so for the last words.
            writer?.takeIf { connection != null }?.let {
                it.finish()
                it.await(parting.longestMillis)
                Thread.sleep(parting.lingeringMillis)
            }
            // Closed, a connection ends the read or the attempt by itself; without one the reader waits for the next.
            connection?.close() ?: reader.interrupt()
        }

        fun giveUpWhatHangs() {
            val writer = this.writer?.takeIf { it.isHung } ?: return
            // Where a write hangs the read may, too, and the close of both: the next attempt waits for none of them.
            val next = Session(isAfterHang = true)
            synchronized(lock) {
                if (session !== this) return
                ended = true
                session = next
                counted = counted.copy(
                    state = LinkState.WAITING,
                    drops = counted.drops + 1,
                    writesHung = counted.writesHung + 1,
                    lastError = words(R.string.link_write_hung),
                )
            }
            // Of this caller nobody may be kept waiting; and a close has been seen to wait for the write.
            Thread(writer::closeConnection, "link-give-up").apply { isDaemon = true }.start()
            next.start()
        }

        private fun connectAndRead() {
            if (isAfterHang) rest()
            while (!ended) {
                report { copy(state = LinkState.CONNECTING) }
                try {
                    readUntilLost()
                } catch (error: IOException) {
                    lost(error)
                } catch (@Suppress("TooGenericExceptionCaught") error: RuntimeException) {
                    // The permission was taken back while we ran, or a driver was closed under a read: no reason to end
                    // the process that steers the boat.
                    lost(error)
                } finally {
                    connection?.close()
                    connection = null
                    writer?.finish()
                    writer = null
                }
                if (!ended) rest()
            }
        }

        private fun rest() {
            try {
                pause.pause(waits.next())
            } catch (_: InterruptedException) {
                check(ended) { "only end() interrupts" }
            }
        }

        private fun readUntilLost() {
            mayWait("connect")
            val fresh = transport.connection()
            connection = fresh
            // end() may have looked for the connection just before it was there.
            if (ended) return
            fresh.open()
            // Or have closed it just before it was open.
            if (ended) return
            received.clear()
            val writes = CommandWriter(fresh, uptimeMillis, this)
            writer = writes
            writes.start()
            heardAt = uptimeMillis()
            report { copy(state = LinkState.CONNECTED, connects = connects + 1) }
            val buffer = ByteArray(READ_BYTES)
            while (true) {
                val length = fresh.read(buffer)
                if (length < 0) throw IOException(words(R.string.link_closed_by_board))
                if (length > 0) take(buffer, length)
            }
        }

        private fun take(buffer: ByteArray, length: Int) {
            waits.reset()
            synchronized(lock) {
                // While the last words go out, what comes in is nobody's.
                if (session !== this) return
                val overrun = received.put(buffer, length)
                heardAt = uptimeMillis()
                counted = counted.copy(
                    bytesIn = counted.bytesIn + length,
                    bytesOverrun = counted.bytesOverrun + overrun,
                )
            }
        }

        private fun lost(error: Exception) {
            if (!ended) Log.i(TAG, "${transport.name}: $error")
            report {
                val had = state == LinkState.CONNECTED
                copy(
                    state = LinkState.WAITING,
                    drops = drops + if (had) 1 else 0,
                    failures = failures + if (had) 0 else 1,
                    lastError = error.message ?: error.javaClass.simpleName,
                )
            }
        }

        override fun sent(bytes: Int) = report { copy(bytesOut = bytesOut + bytes) }

        override fun dropped(error: Exception?) {
            if (error != null && !ended) Log.i(TAG, "${transport.name}: not sent: $error")
            report { copy(writesDropped = writesDropped + 1) }
        }

        private fun report(change: LinkHealth.() -> LinkHealth) {
            synchronized(lock) { if (session === this) counted = counted.change() }
        }
    }

    private companion object {
        const val TAG = "Stillwater"
        const val NANOS_PER_MILLI = 1_000_000L

        /** Some 10 s of a board that sends without a break at 115200 baud. */
        const val RECEIVED_BYTES = 1 shl 17

        /** More than the largest packet of USB's bulk endpoints, 512 bytes: a shorter one would lose the rest. */
        const val READ_BYTES = 1024
    }
}

/**
 * How a connection that was closed on purpose ends: with the last words, which are to rest the motors.
 *
 * @property longestMillis for which they are waited for, ms; two lines take 6 ms at 115200 baud.
 * @property lingeringMillis after them, ms: what a socket has taken the radio has yet to send.
 */
internal class Parting(val longestMillis: Long = 300, val lingeringMillis: Long = 100)

/** How long to wait before the next attempt: twice as long each time up to a limit. */
internal class ReconnectWaits {
    private var millis = FIRST_MILLIS

    /** The wait before the next attempt, ms. */
    fun next(): Long = millis.also { millis = (2 * millis).coerceAtMost(LONGEST_MILLIS) }

    /** The board was heard: the next wait is short again. */
    fun reset() {
        millis = FIRST_MILLIS
    }

    private companion object {
        const val FIRST_MILLIS = 500L

        /** A boat adrift wants its link back sooner than a battery wants rest. */
        const val LONGEST_MILLIS = 8000L
    }
}
