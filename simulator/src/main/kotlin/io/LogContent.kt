package stillwater.io

import java.io.BufferedReader
import java.io.IOException
import java.io.InputStream
import java.io.InputStreamReader
import java.io.Reader
import java.nio.ByteBuffer
import java.nio.CharBuffer
import java.nio.charset.Charset
import java.nio.file.Files
import java.nio.file.Path

/**
 * A file known to be text, with what its beginning says about it.
 *
 * @property file the file.
 * @property charset encoding, from the byte order mark; without one UTF-8, or Windows-1252, which holds Latin-1, where
 * the first bytes are none.
 * @property platypus version of the Platypus log it is, or null where it is none.
 * @property head the first lines, without a byte order mark; of a Sea-Bird file as [SeaBirdTable] has them.
 * @property seaBird header of the Sea-Bird file it is, or null where it is none.
 */
internal class LogContent private constructor(
    val file: Path,
    val charset: Charset,
    private val markLength: Int,
    private val written: List<String>,
    val seaBird: SeaBirdHeader?,
) {
    val head: List<String> = if (seaBird == null) written else SeaBirdHeader.table(written, seaBird, charset)

    /** Whether the file is in an encoding of one byte for each character. */
    val isOneByte: Boolean get() = charset == WINDOWS_1252

    val platypus: PlatypusVersion? = PlatypusVersion.of(head)

    /**
     * The text after its first [skippedLines]; [progress] hears the number of bytes read, of a long file on another
     * thread. Bytes that are no text become U+FFFD. Close it.
     */
    fun reader(skippedLines: Int = 0, progress: (Long) -> Unit): Reader {
        val stream = CountingStream(Files.newInputStream(file), progress)
        stream.skipNBytes(markLength.toLong())
        val decoded = InputStreamReader(table(stream), charset)
        val text = ShortZeros(if (Files.size(file) < LONG) decoded else ReadAhead(decoded))
        if (skippedLines == 0) return text
        return BufferedReader(text).apply { repeat(skippedLines) { readLine() } }
    }

    /** Bytes of a zero character. */
    val unit: Int get() = if (charset == Charsets.UTF_16LE || charset == Charsets.UTF_16BE) 2 else 1

    /** Hands on the byte order mark, empty without one, and the bytes after it; the stream is closed in the end. */
    fun <T> raw(use: (mark: ByteArray, text: InputStream) -> T): T =
        Files.newInputStream(file).buffered().use { use(it.readNBytes(markLength), table(it)) }

    /** The same log, a Sea-Bird file, with its times from the column [name]; this where that is none of time. */
    fun timedBy(name: String): LogContent {
        val other = seaBird?.timedBy(name) ?: return this
        return LogContent(file, charset, markLength, written, other)
    }

    private fun table(text: InputStream) = if (seaBird == null) text else SeaBirdTable(text, seaBird, charset)

    companion object {
        private const val HEAD_BYTES = 1 shl 16

        /** Files of so many bytes are decoded ahead, on another core. */
        private const val LONG = 4_000_000L
        private val WINDOWS_1252 = Charset.forName("windows-1252")
        private val SEA_BIRD = "* Sea-Bird".toByteArray()
        private val GZIP = byteArrayOf(0x1f, 0x8b.toByte())
        private val ZIP = byteArrayOf(0x50, 0x4b, 3, 4)
        private val CONTROLS = 1.toByte()..31.toByte()
        private val BLANKS = "\t\n\u000b\u000c\r\u001a".toByteArray()
        private val UTF_32 = listOf(byteArrayOf(-1, -2, 0, 0), byteArrayOf(0, 0, -2, -1))
        private val PDF = "%PDF-".toByteArray()

        fun of(file: Path): LogContent {
            val bytes = firstBytes(file)
            fun problem(expected: String, found: String) = LogProblem(file, null, null, expected, found)
            if (bytes.isEmpty()) throw problem("a log", "an empty file")
            if (bytes.startsWith(GZIP)) throw problem("a text log", "a gzip archive: unpack it first")
            if (bytes.startsWith(ZIP)) throw problem("a text log", "a zip archive or a workbook: save its sheet as CSV")
            // Before UTF-16: its mark begins that of UTF-32.
            if (UTF_32.any { bytes.startsWith(it) }) throw problem("text in UTF-8 or UTF-16", "text in UTF-32")
            if (bytes.startsWith(PDF)) throw problem("a text log", "a PDF document")
            val (charset, mark) = when {
                bytes.startsWith(byteArrayOf(0xEF.toByte(), 0xBB.toByte(), 0xBF.toByte())) -> Charsets.UTF_8 to 3
                bytes.startsWith(byteArrayOf(0xFF.toByte(), 0xFE.toByte())) -> Charsets.UTF_16LE to 2
                bytes.startsWith(byteArrayOf(0xFE.toByte(), 0xFF.toByte())) -> Charsets.UTF_16BE to 2
                else -> (if (bytes.isUtf8()) Charsets.UTF_8 else WINDOWS_1252) to 0
            }
            if (mark != 2 && !bytes.isText()) throw problem("a text log", "binary data" + remedy(bytes))
            val text = String(bytes, mark, bytes.size - mark, charset)
            // Lines with zeros show nothing of how the log is written.
            val lines = text.lineSequence().map { if ('\u0000' in it) "" else it.trimEnd('\r') }.toList()
            // The last line of the head may be cut.
            val head = if (lines.size > 1 && bytes.size == HEAD_BYTES) lines.dropLast(1) else lines
            val firstIsCut = lines.dropLast(1).all { it.isBlank() } && lines.last().isNotBlank()
            if (bytes.size == HEAD_BYTES && firstIsCut) {
                throw LogProblem(file, lines.size.toLong(), null, "a header within $HEAD_BYTES bytes", "a longer one")
            }
            if (head.all { it.isBlank() }) throw problem("a log", "nothing but blank lines")
            return LogContent(file, charset, mark, head, seaBird(file, charset, head))
        }

        /**
         * Whether that is text, if perhaps with zeros after its first line, where data never reached the disk: rows say
         * that they are bad. Zeros that more follows are taken for such only beside no other byte that text has not.
         */
        private fun ByteArray.isText(): Boolean {
            val first = indexOf(0)
            if (first < 0) return true
            if (indexOf('\n'.code.toByte()) !in 0 until first) return false
            val isTail = (first until size).all { this[it] == 0.toByte() }
            return isTail || (!startsWith(SEA_BIRD) && none { it in CONTROLS && it !in BLANKS })
        }

        private fun remedy(bytes: ByteArray) =
            if (bytes.startsWith(SEA_BIRD)) ": convert it to file_type = ascii" else ""

        /** Its table is made byte by byte. */
        private fun seaBird(file: Path, charset: Charset, head: List<String>): SeaBirdHeader? {
            if (charset != Charsets.UTF_8 && charset != WINDOWS_1252) return null
            return SeaBirdHeader.of(head) { line, expected, found ->
                LogProblem(file, line?.toLong(), null, expected, found)
            }
        }

        private fun firstBytes(file: Path): ByteArray {
            fun problem(found: String) = LogProblem(file, null, null, "a log file", found)
            if (!Files.exists(file)) throw problem("no such file")
            if (Files.isDirectory(file)) throw problem("a directory")
            // A pipe gives its bytes once only, and opening one may wait for ever.
            if (!Files.isRegularFile(file)) {
                throw LogProblem(file, null, null, "a regular file (it is read twice)", "a pipe or device")
            }
            return try {
                Files.newInputStream(file).use { it.readNBytes(HEAD_BYTES) }
            } catch (_: IOException) {
                throw problem("a file that cannot be read")
            }
        }

        /** Whether that is UTF-8, as far as it goes: its last character may be cut. */
        private fun ByteArray.isUtf8(): Boolean {
            val decoder = Charsets.UTF_8.newDecoder()
            return !decoder.decode(ByteBuffer.wrap(this), CharBuffer.allocate(size), false).isError
        }

        private fun ByteArray.startsWith(mark: ByteArray) =
            size >= mark.size && mark.indices.all { this[it] == mark[it] }
    }
}
