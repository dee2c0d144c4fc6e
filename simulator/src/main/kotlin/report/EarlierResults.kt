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
 * @property command the command, such as `map`; the report says in its last lines what made it. @param mark a file by which
 *   they are told where there is no report, and a word that it has; null where there always is one.
 */
public class EarlierResults(public val command: String, private val mark: Pair<String, String>? = null) {
    private val line = Regex("Command: <code>stillwater $command\\b")

    /** Whether [directory] has such results. */
    internal fun areIn(directory: Path): Boolean {
        if (!directory.isDirectory()) return false
        return try {
            val report = directory.resolve(REPORT)
            if (report.exists()) {
                isOwn(report)
            } else {
                mark?.let { (name, word) -> hasWord(directory.resolve(name), word) }
                    ?: false
            }
        } catch (_: IOException) {
            false
        }
    }

    private fun hasWord(file: Path, word: String) = file.isRegularFile() && word in read(file, from = 0)

    private fun isOwn(report: Path) = report.isRegularFile() && line.containsMatchIn(end(report))

    private fun end(file: Path) = read(file, maxOf(Files.size(file) - PART, 0))

    private fun read(file: Path, from: Long): String = Files.newByteChannel(file).use { channel ->
        channel.position(from)
        val bytes = ByteBuffer.allocate(PART.toInt())
        while (bytes.hasRemaining() && channel.read(bytes) >= 0) Unit
        String(bytes.array(), 0, bytes.position())
    }

    internal companion object {
        /** Name of a report. */
        const val REPORT = "report.html"

        /** Bytes at the end of a report that hold its command, however many options that has, or at the beginning of a file. */
        private const val PART = 65_536L
    }
}
