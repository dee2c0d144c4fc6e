package stillwater.drive

import stillwater.io.BoundedLines
import stillwater.io.LogProblem
import stillwater.mission.LogSink
import stillwater.mission.MissionRecovery
import stillwater.mission.RecoveredMission
import stillwater.report.OutputException
import stillwater.report.counted
import java.io.ByteArrayOutputStream
import java.io.Closeable
import java.io.FilterInputStream
import java.io.IOException
import java.io.InputStream
import java.io.RandomAccessFile
import java.nio.ByteBuffer
import java.nio.channels.FileChannel
import java.nio.file.Files
import java.nio.file.Path
import java.nio.file.StandardCopyOption.ATOMIC_MOVE
import java.nio.file.StandardOpenOption.APPEND
import java.nio.file.StandardOpenOption.CREATE_NEW
import kotlin.io.path.exists
import kotlin.io.path.name

/**
 * A mission's log on disk: `mission.txt.incomplete` until it is closed, then `mission.txt`.
 *
 * Lines are only ever appended. [flushWhenDue] hands them to the disk itself, not just to the system: a flat battery
 * loses what came after it. What a full disk did not take waits and goes on from the very byte where it stopped.
 * Confined to one thread.
 *
 * @throws OutputException from every call if the disk refuses.
 */
internal class LogOnDisk(private val path: Path, private val file: LogBytes) :
    LogSink,
    AutoCloseable {
    private var waiting = ByteArrayOutputStream()
    private var flushedAt = System.nanoTime()
    private var isOpen = true

    /** Bytes that the disk has not got yet. */
    val pending: Int get() = waiting.size()

    override fun line(line: String) {
        waiting.write((line + "\n").toByteArray())
    }

    /** Hands what is waiting to the disk, if the last time was [FLUSH_NANOS] ago. */
    fun flushWhenDue() {
        if (System.nanoTime() - flushedAt >= FLUSH_NANOS) flush()
    }

    /** Hands what is waiting to the disk. */
    fun flush() = guarded(path) {
        flushedAt = System.nanoTime()
        val bytes = ByteBuffer.wrap(waiting.toByteArray())
        try {
            while (bytes.hasRemaining()) file.write(bytes)
        } finally {
            // What was written is not written again, though the rest was refused.
            waiting.reset()
            waiting.write(bytes.array(), bytes.position(), bytes.remaining())
        }
        file.force()
    }

    /** That lines are missing at its end, after one more try to write them, and how many; null where the disk has all. */
    fun missing(): String? {
        try {
            flush()
            return null
        } catch (_: OutputException) {
            val lines = waiting.toByteArray().count { it == '\n'.code.toByte() }
            return "$path lacks the last ${counted(
                lines,
                "line",
            )}, with the readings in them: the disk is full or broken"
        }
    }

    /** Closes a log that is whole and gives it its final name, which it answers. */
    fun complete(): Path {
        flush()
        close()
        val whole = path.resolveSibling(path.name.removeSuffix(INCOMPLETE))
        guarded(path) { Files.move(path, whole, ATOMIC_MOVE) }
        return whole
    }

    /** Closes it as it is; without [complete] it stays incomplete, and is removed where nothing was ever written. */
    override fun close() {
        if (!isOpen) return
        isOpen = false
        file.use { flush() }
        guarded(path) { if (isEmpty(path)) Files.delete(path) }
    }

    companion object {
        /** What a log's name ends in until it is closed. */
        const val INCOMPLETE = ".incomplete"
        const val NAME = "mission.txt"

        /** Well below a second. */
        private const val FLUSH_NANOS = 400_000_000L

        /** Begins a log in [directory], where no finished one may be. */
        fun begin(directory: Path): LogOnDisk = guarded(directory) {
            Files.createDirectories(directory)
            val path = directory.resolve(NAME + INCOMPLETE)
            if (isEmpty(path)) Files.delete(path)
            LogOnDisk(path, LogBytes.of(FileChannel.open(path, CREATE_NEW, APPEND)))
        }

        /** The unfinished log in [directory]; null where there is none, or one in which nothing was ever written. */
        fun unfinished(directory: Path): Path? =
            directory.resolve(NAME + INCOMPLETE).takeIf { it.exists() && !isEmpty(it) }

        /** The finished log in [directory]; null where there is none. */
        fun finished(directory: Path): Path? = directory.resolve(NAME).takeIf { it.exists() }

        /**
         * Goes on with the unfinished log at [path], unless [check] throws: then it is left as it is. A last line that
         * was cut when the program died is taken off it.
         *
         * @throws LogProblem if it has no mission.
         */
        fun resume(path: Path, check: (RecoveredMission) -> Unit): Resumed = guarded(path) {
            RandomAccessFile(path.toFile(), "rw").use { file ->
                val end = endOfLines(file)
                val recovery = MissionRecovery()
                // A broken disk's bytes are no reason to give up the lines around them.
                val whole = BoundedStream(Files.newInputStream(path), end)
                BoundedLines(whole.reader(Charsets.UTF_8)).use { lines -> lines.forEach(recovery::line) }
                val found = recovery.recovered()
                    ?: throw LogProblem(path, null, null, "a mission's log", "no mission that can be read")
                check(found)
                val torn = file.length() - end
                if (torn > 0) file.setLength(end)
                Resumed(LogOnDisk(path, LogBytes.of(FileChannel.open(path, APPEND))), found, torn)
            }
        }

        /** How many bytes of [file] are whole lines. */
        private fun endOfLines(file: RandomAccessFile): Long {
            var end = file.length()
            while (end > 0) {
                file.seek(end - 1)
                if (file.read() == '\n'.code) break
                end--
            }
            return end
        }

        private fun isEmpty(path: Path) = path.exists() && Files.size(path) == 0L

        private fun <T> guarded(path: Path, block: () -> T): T = try {
            block()
        } catch (failed: IOException) {
            val why = failed.message ?: failed.javaClass.simpleName
            throw OutputException("cannot write the log $path: $why", failed)
        }
    }
}

/** The bytes of a log's file. Calls throw IOException where the disk refuses. */
internal interface LogBytes : Closeable {
    /** Appends some of [bytes], whose position then stands behind what was taken. */
    fun write(bytes: ByteBuffer)

    /** Hands what was written to the disk itself. */
    fun force()

    companion object {
        /** Those of [channel], which is retained. */
        fun of(channel: FileChannel) = object : LogBytes {
            override fun write(bytes: ByteBuffer) {
                channel.write(bytes)
            }

            override fun force() = channel.force(false)

            override fun close() = channel.close()
        }
    }
}

/**
 * An unfinished log that is gone on with.
 *
 * @property file where it goes on.
 * @property mission what it tells.
 * @property tornBytes of a last line that was cut.
 */
internal class Resumed(val file: LogOnDisk, val mission: RecoveredMission, val tornBytes: Long)

/** The first [left] bytes of [stream]. */
private class BoundedStream(stream: InputStream, private var left: Long) : FilterInputStream(stream) {
    override fun read(): Int = if (left > 0) super.read().also { left-- } else -1

    override fun read(into: ByteArray, offset: Int, length: Int): Int {
        if (left <= 0) return -1
        val count = super.read(into, offset, minOf(length.toLong(), left).toInt())
        if (count > 0) left -= count
        return count
    }
}
