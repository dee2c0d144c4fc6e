package stillwater.report

import java.io.IOException
import java.nio.ByteBuffer
import java.nio.file.Files
import java.nio.file.Path
import kotlin.io.path.exists
import kotlin.io.path.isDirectory
import kotlin.io.path.isRegularFile

/**
 * Tells results that an earlier run of a command left in a directory from what is somebody's own.
 *
 * @property command the command, such as `map`; the report says in its last lines what made it. @param mark a file by which they
 *   are told where there is no report; null where there always is one.
 */
public class EarlierResults(public val command: String, private val mark: String? = null) {
    private val line = Regex("Command: <code>stillwater $command\\b")

    /** Whether [directory], or one right within it, has such results. */
    internal fun areIn(directory: Path): Boolean {
        if (!directory.isDirectory()) return false
        return try {
            val report = directory.resolve(REPORT)
            when {
                report.exists() -> isOwn(report)
                mark != null && directory.resolve(mark).exists() -> true
                else -> Files.list(directory).use { within -> within.anyMatch { isOwn(it.resolve(REPORT)) } }
            }
        } catch (_: IOException) {
            false
        }
    }

    private fun isOwn(report: Path) = report.isRegularFile() && line.containsMatchIn(end(report))

    private fun end(file: Path): String = Files.newByteChannel(file).use { channel ->
        channel.position(maxOf(channel.size() - END, 0))
        val bytes = ByteBuffer.allocate(END.toInt())
        while (bytes.hasRemaining() && channel.read(bytes) >= 0) Unit
        String(bytes.array(), 0, bytes.position())
    }

    internal companion object {
        /** Name of a report. */
        const val REPORT = "report.html"

        /** Bytes at the end of a report that hold its command, however many options that has. */
        private const val END = 65_536L
    }
}
