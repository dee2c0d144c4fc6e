package stillwater.replay

import stillwater.mission.LogSink
import stillwater.report.OutputException
import java.io.IOException
import java.io.OutputStream
import java.nio.file.Files
import java.nio.file.Path

/**
 * Lines that are kept on disk rather than in memory, and can be read again at any time: a mission of hours writes tens
 * of megabytes. The file is removed by [close]. Confined to one thread.
 *
 * @throws OutputException from every call if the disk refuses.
 */
internal class LineSpool :
    LogSink,
    AutoCloseable {
    private val file: Path = guarded {
        Files.createTempFile("stillwater-replay-", ".txt").also { it.toFile().deleteOnExit() }
    }
    private val out: OutputStream = guarded { Files.newOutputStream(file).buffered() }

    override fun line(line: String) = guarded { out.write((line + "\n").toByteArray()) }

    /** Hands each line to [take], in order. */
    fun forEach(take: (String) -> Unit) = guarded {
        out.flush()
        Files.newBufferedReader(file).useLines { it.forEach(take) }
    }

    /** Writes all lines to [stream]. */
    fun copyTo(stream: OutputStream) = guarded {
        out.flush()
        Files.copy(file, stream)
    }

    override fun close() {
        guarded {
            out.use { Files.deleteIfExists(file) }
        }
    }

    private fun <T> guarded(block: () -> T): T = try {
        block()
    } catch (failed: IOException) {
        throw OutputException(
            "cannot keep the replay's log aside: ${failed.message ?: failed.javaClass.simpleName}",
            failed,
        )
    }
}
