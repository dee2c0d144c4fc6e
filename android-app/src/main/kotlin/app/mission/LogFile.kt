package stillwater.app.mission

import stillwater.app.mayWait
import stillwater.mission.LogSink
import java.io.ByteArrayOutputStream
import java.io.File
import java.io.IOException

/**
 * A mission's log: [line] takes lines on the boat's thread and never waits, [flush] brings them to the disk on the
 * disk's. What the disk does not take is kept, up to [MOST_BYTES], and tried again at every flush.
 *
 * @param file that is written; its name ends with [LogFolder.INCOMPLETE] until [close].
 * @param opener opens it.
 * @param room that is left on the disk, bytes.
 */
internal class LogFile(
    private val file: File,
    private val opener: LogOpener,
    private val room: () -> Long,
) : LogSink {
    private class Chunk(val bytes: ByteArray, val lines: Long)

    private val lock = Any()
    private var incoming = ByteArrayOutputStream()
    private var incomingLines = 0L
    private var told = LogReport(file.name)

    // The disk's thread has these to itself.
    private val waiting = ArrayDeque<Chunk>()
    private var output: LogOutput? = null

    /** What became of the lines. Any thread. */
    val report: LogReport get() = synchronized(lock) { told }

    /** Whether the log could not be written at some time. Any thread. */
    @Volatile var failed = false
        private set

    override fun line(line: String) {
        synchronized(lock) {
            incoming.write(line.encodeToByteArray())
            incoming.write('\n'.code)
            incomingLines++
            told = told.copy(lines = told.lines + 1)
        }
    }

    /** Brings what has come to the disk. */
    fun flush() {
        take()
        try {
            while (true) {
                val next = waiting.firstOrNull() ?: break
                val open = output ?: opener.open(file).also { output = it }
                open.append(next.bytes)
                waiting.removeFirst()
                synchronized(lock) { told = told.copy(written = told.written + next.lines) }
            }
            trouble(if (room() < LEAST_ROOM) LogProblem(LogProblem.Reason.LITTLE_ROOM) else null)
        } catch (_: NoFolder) {
            trouble(LogProblem(LogProblem.Reason.NO_FOLDER))
        } catch (error: IOException) {
            trouble(LogProblem(LogProblem.Reason.NOT_WRITTEN, error.message ?: error.javaClass.simpleName))
        }
    }

    /** Flushes, and gives the file its name as a complete one. Answers whether all lines are in it. */
    fun close(): Boolean {
        flush()
        if (waiting.isNotEmpty()) return false
        release()
        mayWait("rename a log")
        val complete = File(file.path.removeSuffix(LogFolder.INCOMPLETE))
        val isRenamed = !file.exists() || file.renameTo(complete)
        val name = if (isRenamed) complete.name else file.name
        synchronized(lock) { told = told.copy(name = name, isClosed = isRenamed) }
        return isRenamed
    }

    /** Lets go of the file and leaves it incomplete. */
    fun release() {
        try {
            output?.close()
        } catch (error: IOException) {
            // What was flushed is on the disk; the boat is not to be left over this.
            trouble(LogProblem(LogProblem.Reason.NOT_WRITTEN, error.message ?: error.javaClass.simpleName))
        }
        output = null
    }

    private fun take() {
        val (bytes, lines) =
            synchronized(lock) {
                val taken = incoming to incomingLines
                incoming = ByteArrayOutputStream()
                incomingLines = 0
                taken
            }
        if (lines == 0L) return
        if (waiting.sumOf { it.bytes.size.toLong() } + bytes.size() > MOST_BYTES) {
            synchronized(lock) { told = told.copy(lost = told.lost + lines) }
        } else {
            waiting.addLast(Chunk(bytes.toByteArray(), lines))
        }
    }

    private fun trouble(problem: LogProblem?) {
        if (problem != null) failed = true
        synchronized(lock) { told = told.copy(problem = problem) }
    }

    companion object {
        /** Some minutes of a mission, so that its way home is not lost when room is made. */
        const val MOST_BYTES = 4L shl 20

        /** A mission comes home on what is left. */
        const val LEAST_ROOM = 10L shl 20
    }
}

/** The folder of the logs is not there and cannot be made. */
internal class NoFolder : IOException()
