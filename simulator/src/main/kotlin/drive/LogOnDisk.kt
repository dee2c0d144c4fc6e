package stillwater.drive

import stillwater.io.LogProblem
import stillwater.mission.LogSink
import stillwater.mission.MissionRecovery
import stillwater.mission.RecoveredMission
import stillwater.report.OutputException
import java.io.IOException
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
 * Lines are only ever appended. [flush] hands them to the disk itself, not just to the system: a flat battery loses what came
 * after it. Confined to one thread.
 *
 * @throws OutputException from every call if the disk refuses.
 */
internal class LogOnDisk private constructor(private val path: Path, private val channel: FileChannel) :
    LogSink,
    AutoCloseable {
    private val waiting = StringBuilder()
    private var flushedAt = System.nanoTime()

    override fun line(line: String) {
        waiting.append(line).append('\n')
    }

    /** Hands what is waiting to the disk, if the last time was [FLUSH_NANOS] ago. */
    fun flushWhenDue() {
        if (System.nanoTime() - flushedAt >= FLUSH_NANOS) flush()
    }

    private fun flush() = guarded(path) {
        val bytes = ByteBuffer.wrap(waiting.toString().toByteArray())
        while (bytes.hasRemaining()) channel.write(bytes)
        channel.force(false)
        waiting.setLength(0)
        flushedAt = System.nanoTime()
    }

    /** Closes a log that is whole and gives it its final name, which it answers. */
    fun complete(): Path {
        flush()
        channel.close()
        val whole = path.resolveSibling(path.name.removeSuffix(INCOMPLETE))
        guarded(path) { Files.move(path, whole, ATOMIC_MOVE) }
        return whole
    }

    /** Closes it as it is; without [complete] it stays incomplete. */
    override fun close() {
        if (channel.isOpen) {
            channel.use { flush() }
        }
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
            LogOnDisk(path, FileChannel.open(path, CREATE_NEW, APPEND))
        }

        /** The unfinished log in [directory]; null where there is none. */
        fun unfinished(directory: Path): Path? = directory.resolve(NAME + INCOMPLETE).takeIf { it.exists() }

        /** The finished log in [directory]; null where there is none. */
        fun finished(directory: Path): Path? = directory.resolve(NAME).takeIf { it.exists() }

        /**
         * Goes on with the unfinished log at [path]. A last line that was cut when the program died is taken off it.
         *
         * @throws LogProblem if it has no mission.
         */
        fun resume(path: Path): Resumed = guarded(path) {
            val cut = cutTornLine(path)
            val recovery = MissionRecovery()
            // A broken disk's bytes are no reason to give up the lines around them.
            path.toFile().bufferedReader(Charsets.UTF_8).useLines { lines -> lines.forEach(recovery::line) }
            val found = recovery.recovered()
                ?: throw LogProblem(path, null, null, "a mission's log", "no mission that can be read")
            Resumed(LogOnDisk(path, FileChannel.open(path, APPEND)), found, cut)
        }

        /** Takes off what stands after the last end of a line; answers how many bytes. */
        private fun cutTornLine(path: Path): Long = RandomAccessFile(path.toFile(), "rw").use { file ->
            var end = file.length()
            while (end > 0) {
                file.seek(end - 1)
                if (file.read() == '\n'.code) break
                end--
            }
            (file.length() - end).also { if (it > 0) file.setLength(end) }
        }

        private fun <T> guarded(path: Path, block: () -> T): T = try {
            block()
        } catch (failed: IOException) {
            throw OutputException("cannot write the log $path: ${failed.message ?: failed.javaClass.simpleName}", failed)
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
