package stillwater.app.link

import stillwater.app.mayWait
import java.io.IOException
import java.util.concurrent.ArrayBlockingQueue

/**
 * Sends commands over one [connection], oldest first, on a thread of its own: one that a hanging write holds for good
 * is left behind with its connection.
 *
 * A command that could not be sent yet makes room for a newer one: the oldest is dropped.
 *
 * @param uptimeMillis a clock that never goes back, ms. Retained.
 * @param told hears what became of the commands, on whichever thread. Retained.
 */
internal class CommandWriter(
    private val connection: Connection,
    private val uptimeMillis: () -> Long,
    private val told: Told,
) {
    /** What becomes of commands. */
    interface Told {
        /** All [bytes] of one went out. */
        fun sent(bytes: Int)

        /** One did not go out; [error] is why, null where a newer one took its place. */
        fun dropped(error: Exception?)
    }

    private val waiting = ArrayBlockingQueue<ByteArray>(COMMANDS)
    private val thread = Thread(::run, "link-write").apply { isDaemon = true }

    /** When the write began that is under way, ms; [NONE] where none is. */
    @Volatile private var begun = NONE

    /** Whether no command is taken any more, and the thread ends once those that wait are sent. */
    @Volatile private var isFinishing = false

    /** Whether one write has been under way for so long that it will not come back. */
    val isHung: Boolean
        get() {
            val since = begun
            return since != NONE && uptimeMillis() - since > LONGEST_WRITE_MILLIS
        }

    /** Begins. */
    fun start() = thread.start()

    /** Takes [bytes] to be sent; answers whether it does. */
    fun take(bytes: ByteArray): Boolean {
        if (isFinishing) return false
        while (!waiting.offer(bytes)) {
            if (waiting.poll() != null) told.dropped(null)
        }
        return true
    }

    /** Takes no more; what waits is sent, and that was all. */
    fun finish() {
        isFinishing = true
        // For one that waits for a command; where there is no room, there are commands.
        waiting.offer(END)
    }

    /** Waits until it has finished, for [millis] ms at most. */
    @Throws(InterruptedException::class)
    fun await(millis: Long) = thread.join(millis)

    /** Gives the connection up. */
    fun closeConnection() = connection.close()

    private fun run() {
        try {
            while (true) {
                val bytes = if (isFinishing) waiting.poll() ?: return else waiting.take()
                if (bytes === END) return
                send(bytes)
            }
        } catch (error: IOException) {
            lost(error)
        } catch (@Suppress("TooGenericExceptionCaught") error: RuntimeException) {
            // A driver that was closed under a write: no reason to end the process that steers the boat.
            lost(error)
        }
    }

    private fun send(bytes: ByteArray) {
        mayWait("send")
        begun = uptimeMillis()
        connection.write(bytes)
        begun = NONE
        told.sent(bytes.size)
    }

    /** A connection that takes nothing is lost, even where reading still waits. */
    private fun lost(error: Exception) {
        begun = NONE
        isFinishing = true
        told.dropped(error)
        while (waiting.poll().let { it != null && it !== END }) told.dropped(null)
        connection.close()
    }

    companion object {
        /** Commands waiting at most; at 10 Hz the oldest is 0.8 s old. */
        private const val COMMANDS = 8

        /** A radio that falters is back by then; one that is not has left the board to its own watchdog long ago. */
        const val LONGEST_WRITE_MILLIS = 1_000L
        private const val NONE = Long.MIN_VALUE
        private val END = ByteArray(0)
    }
}
