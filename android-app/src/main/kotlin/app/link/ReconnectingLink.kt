package stillwater.app.link

import android.util.Log
import stillwater.app.mayWait
import stillwater.wire.ByteLink
import java.io.IOException
import java.util.concurrent.ArrayBlockingQueue

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
 * A command that could not be sent yet makes room for a newer one: the oldest is dropped and counted. Nothing received
 * over one connection is handed out over the next.
 *
 * @param pause waits between attempts. Retained.
 * @param uptimeMillis a clock that never goes back, ms. Retained.
 */
internal class ReconnectingLink(
    private val transport: Transport,
    private val pause: Pause = Pause(Thread::sleep),
    private val uptimeMillis: () -> Long = { System.nanoTime() / NANOS_PER_MILLI },
) : BoardLink {
    private val lock = Any()
    private val received = ByteRing(RECEIVED_BYTES)
    private val commands = ArrayBlockingQueue<ByteArray>(COMMANDS)
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
        val taken = received.take(into)
        return if (taken == 0 && health.state != LinkState.CONNECTED) ByteLink.LOST else taken
    }

    override fun write(bytes: ByteArray): Boolean {
        if (health.state != LinkState.CONNECTED) {
            count { copy(writesDropped = writesDropped + 1) }
            return false
        }
        while (!commands.offer(bytes)) {
            if (commands.poll() != null) count { copy(writesDropped = writesDropped + 1) }
        }
        return true
    }

    private fun count(change: LinkHealth.() -> LinkHealth) {
        synchronized(lock) { counted = counted.change() }
    }

    /** From one [open] to the next [close]; what an ended one still does, nobody sees. */
    private inner class Session {
        private val reader = Thread(::connectAndRead, "link-read")
        private val writer = Thread(::writeCommands, "link-write")
        private val waits = ReconnectWaits()

        @Volatile private var ended = false

        @Volatile private var connection: Connection? = null

        fun start() {
            reader.start()
            writer.start()
        }

        fun end() {
            ended = true
            reader.interrupt()
            writer.interrupt()
            connection?.close()
        }

        private fun connectAndRead() {
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
                }
                try {
                    if (!ended) pause.pause(waits.next())
                } catch (_: InterruptedException) {
                    check(ended) { "only end() interrupts" }
                }
            }
        }

        private fun readUntilLost() {
            mayWait("connect")
            val fresh = transport.connection()
            connection = fresh
            // end() may have looked for the connection just before it was there.
            if (ended) return
            fresh.open()
            received.clear()
            commands.clear()
            heardAt = uptimeMillis()
            report { copy(state = LinkState.CONNECTED, connects = connects + 1) }
            val buffer = ByteArray(READ_BYTES)
            while (!ended) {
                val length = fresh.read(buffer)
                if (length < 0) throw IOException("the other side closed the connection")
                if (length == 0) continue
                waits.reset()
                val overrun = received.put(buffer, length)
                synchronized(lock) { heardAt = uptimeMillis() }
                report { copy(bytesIn = bytesIn + length, bytesOverrun = bytesOverrun + overrun) }
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

        private fun writeCommands() {
            try {
                while (!ended) {
                    val bytes = commands.take()
                    val open = connection
                    try {
                        if (open == null) throw IOException("the connection is gone")
                        mayWait("send")
                        open.write(bytes)
                        report { copy(bytesOut = bytesOut + bytes.size) }
                    } catch (error: IOException) {
                        notSent(open, error)
                    } catch (@Suppress("TooGenericExceptionCaught") error: RuntimeException) {
                        notSent(open, error)
                    }
                }
            } catch (_: InterruptedException) {
                check(ended) { "only end() interrupts" }
            }
        }

        /** A connection that takes nothing is lost, even where reading still waits; a newer one is not touched. */
        private fun notSent(open: Connection?, error: Exception) {
            Log.i(TAG, "${transport.name}: not sent: $error")
            report { copy(writesDropped = writesDropped + 1) }
            open?.close()
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
        const val READ_BYTES = 1024

        /** Commands waiting at most; at 10 Hz the oldest is 0.8 s old. */
        const val COMMANDS = 8
    }
}

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
