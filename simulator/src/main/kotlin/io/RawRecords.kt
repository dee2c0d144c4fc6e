package stillwater.io

import java.io.InputStream
import java.nio.charset.Charset

/**
 * The records of a CSV text as they stand, byte for byte: each with its quotes, blanks and line end, so that it can be
 * written again unchanged. Characters are code units of the encoding (bytes, or pairs of bytes in UTF-16), which is
 * enough to find separators, quotes and line ends.
 *
 * A quote opens only at the beginning of a field, as in the reader of [CsvSurvey]. Confined to one thread.
 *
 * @param bytes the text, after any byte order mark. Read, not closed.
 */
internal class RawRecords(private val bytes: InputStream, charset: Charset, private val separator: Char) {
    private val wide = charset == Charsets.UTF_16LE || charset == Charsets.UTF_16BE
    private val littleEnd = charset == Charsets.UTF_16LE
    private var ahead = NOTHING

    /** The record without its line end. */
    val text = StringBuilder()

    /** What ended the record: a line feed, carriage return or both; empty at the end of the text. */
    var lineEnd = ""
        private set

    /** Fields of the record, without the quotes around them and with doubled ones single. */
    val fields = ArrayList<String>()

    private val field = StringBuilder()

    /** Goes to the next record; false at the end of the text. */
    fun next(): Boolean {
        text.clear()
        fields.clear()
        field.clear()
        lineEnd = ""
        var unit = take()
        if (unit < 0) return false
        var quoted = false
        var atStart = true
        while (unit >= 0) {
            val c = unit.toChar()
            if (!quoted && (c == '\n' || c == '\r')) {
                endLine(c)
                break
            }
            text.append(c)
            when {
                quoted && c == '"' -> quoted = isDoubled()
                quoted -> field.append(c)
                c == separator -> endField()
                c == '"' && atStart -> quoted = true
                else -> field.append(c)
            }
            atStart = c == separator && !quoted
            unit = take()
        }
        endField()
        return true
    }

    /** Goes to the end of the line, whatever quotes are in it; its text is [text], and it has no [fields]. */
    fun nextLine() {
        text.clear()
        fields.clear()
        lineEnd = ""
        var unit = take()
        while (unit >= 0) {
            val c = unit.toChar()
            if (c == '\n' || c == '\r') return endLine(c)
            text.append(c)
            unit = take()
        }
    }

    /** Whether a quote inside quotes is followed by another, which is then taken: one that is meant. */
    private fun isDoubled(): Boolean {
        if (peek() != '"'.code) return false
        text.append(take().toChar())
        field.append('"')
        return true
    }

    private fun endLine(c: Char) {
        lineEnd = if (c == '\r' && peek() == '\n'.code) "\r${take().toChar()}" else c.toString()
    }

    private fun endField() {
        fields += field.toString()
        field.clear()
    }

    private fun peek(): Int {
        if (ahead == NOTHING) ahead = read()
        return ahead
    }

    private fun take(): Int = peek().also { ahead = NOTHING }

    private fun read(): Int {
        val first = bytes.read()
        if (!wide || first < 0) return first
        val second = bytes.read()
        // Half a unit at the end of the file is no text.
        if (second < 0) return -1
        return if (littleEnd) first or (second shl 8) else (first shl 8) or second
    }

    /** [units], of this text or ASCII, as the bytes that they stand for. */
    fun bytes(units: CharSequence): ByteArray {
        if (!wide) return ByteArray(units.length) { units[it].code.toByte() }
        return ByteArray(2 * units.length) {
            val code = units[it / 2].code
            (if ((it % 2 == 0) == littleEnd) code else code shr 8).toByte()
        }
    }

    private companion object {
        const val NOTHING = -2
    }
}
