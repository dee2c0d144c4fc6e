package stillwater.io

import java.io.ByteArrayOutputStream
import java.io.InputStream
import java.nio.charset.Charset

/**
 * A Sea-Bird `.cnv` file as CSV, line by line: the lines before `*END*` as they are, the names of the columns in place
 * of `*END*`, and rows with commas for the blanks, NaN for the bad flag and the time in seconds before them.
 *
 * So that what reads CSV reads it, and lines keep their numbers. Confined to one thread.
 *
 * @param file the file's bytes; closed with this. @param header its header.
 * @param charset its encoding, in which ASCII is one byte.
 */
internal class SeaBirdTable(
    private val file: InputStream,
    private val header: SeaBirdHeader,
    private val charset: Charset,
) : InputStream() {
    private val input = ByteArray(BUFFER)
    private var inputAt = 0
    private var inputEnd = 0
    private var line = Line()
    private val output = Output()
    private var lines = 0
    private var scans = 0L

    /** What the column of scans has, or would have, in the first row; NaN before that is known. */
    private var firstScan = Double.NaN

    /** The bytes of a line without its end, and where its fields are. */
    private class Line {
        var text = CharArray(WIDE)
        var length = 0

        fun add(byte: Int) {
            if (length == text.size) text = text.copyOf(2 * length)
            text[length++] = byte.toChar()
        }
    }

    /** Bytes that are ready to be read. */
    private class Output : ByteArrayOutputStream(WIDE) {
        var at = 0
        val left: Int get() = count - at

        fun take(buffer: ByteArray, offset: Int, length: Int): Int {
            val taken = minOf(length, left)
            System.arraycopy(buf, at, buffer, offset, taken)
            at += taken
            return taken
        }

        override fun reset() {
            super.reset()
            at = 0
        }

        fun text(text: String) {
            for (c in text) write(c.code)
        }
    }

    override fun read(): Int {
        val one = ByteArray(1)
        return if (read(one, 0, 1) < 0) -1 else one[0].toInt() and BYTE
    }

    override fun read(buffer: ByteArray, offset: Int, length: Int): Int {
        if (length == 0) return 0
        while (output.left == 0) {
            output.reset()
            if (!nextLine()) return -1
        }
        return output.take(buffer, offset, length)
    }

    override fun close() = file.close()

    private fun byte(): Int {
        if (inputAt == inputEnd) {
            inputEnd = file.read(input, 0, input.size)
            inputAt = 0
            if (inputEnd <= 0) {
                inputEnd = 0
                return -1
            }
        }
        return input[inputAt++].toInt() and BYTE
    }

    /** Puts the next line into [output]; false at the end of the file. */
    private fun nextLine(): Boolean {
        line.length = 0
        var byte = byte()
        if (byte < 0) return false
        while (byte >= 0 && byte != '\n'.code) {
            line.add(byte)
            byte = byte()
        }
        lines++
        val hasReturn = line.length > 0 && line.text[line.length - 1] == '\r'
        if (hasReturn) line.length--
        when {
            lines == header.endLine -> output.writeBytes(header.csvHeader().toByteArray(charset))
            lines < header.endLine || !isRow() -> for (i in 0 until line.length) output.write(line.text[i].code)
            else -> row()
        }
        if (hasReturn) output.write('\r'.code)
        if (byte >= 0) output.write('\n'.code)
        return true
    }

    private fun isRow(): Boolean {
        val first = start(0)
        return first < line.length && line.text[first] != '*' && !CellText.isRemark(line.text[first])
    }

    /** Where the next field begins from [from] on. */
    private fun start(from: Int): Int {
        var i = from
        while (i < line.length && line.text[i] <= ' ') i++
        return i
    }

    private fun end(from: Int): Int {
        var i = from
        while (i < line.length && line.text[i] > ' ') i++
        return i
    }

    private fun row() {
        header.clock?.let(::time)
        var begin = start(0)
        var isFirst = header.clock == null
        while (begin < line.length) {
            val end = end(begin)
            if (!isFirst) output.write(','.code)
            isFirst = false
            if (DecimalText.parse(line.text, begin, end - begin) == header.badFlag) {
                output.text(NONE)
            } else {
                for (i in begin until end) output.write(line.text[i].code)
            }
            begin = start(end)
        }
        scans++
    }

    private fun time(clock: SeaBirdHeader.Clock) {
        val units = if (clock.column == SeaBirdHeader.BY_COUNT) scans.toDouble() else field(clock.column)
        if (clock.fromFirst && firstScan.isNaN() && units != header.badFlag) firstScan = units - scans
        val sinceZero = if (clock.fromFirst) units - firstScan else units
        val seconds = sinceZero * clock.factor + (clock.zero ?: 0.0)
        output.text(if (units == header.badFlag || !seconds.isFinite()) NONE else decimal(seconds))
    }

    /** The number in the field [column], NaN where there is none. */
    private fun field(column: Int): Double {
        var begin = start(0)
        repeat(column) { begin = start(end(begin)) }
        return DecimalText.parse(line.text, begin, end(begin) - begin)
    }

    /** [seconds] to 10 µs: as many digits as a number since 1970 has exactly and fast. */
    private fun decimal(seconds: Double): String {
        val parts = Math.round(Math.abs(seconds) * PARTS)
        val fraction = (parts % PARTS).toString().padStart(DECIMALS, '0')
        return (if (seconds < 0 && parts > 0) "-" else "") + "${parts / PARTS}.$fraction"
    }

    private companion object {
        const val BUFFER = 1 shl 16
        const val WIDE = 512
        const val BYTE = 0xff
        const val DECIMALS = 5
        const val PARTS = 100_000L
        const val NONE = "NaN"
    }
}
