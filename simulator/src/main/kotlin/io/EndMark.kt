package stillwater.io

import java.io.FilterReader
import java.io.Reader

/**
 * A CSV text followed by one more row, [TEXT]: where a quote was never closed that row turns up inside a field.
 *
 * Confined to one thread.
 */
internal class EndMark(text: Reader) : FilterReader(text) {
    private var last = '\n'
    private var mark: String? = null
    private var given = 0

    override fun read(): Int {
        val one = CharArray(1)
        return if (read(one, 0, 1) < 0) -1 else one[0].code
    }

    override fun read(buffer: CharArray, offset: Int, length: Int): Int {
        if (length == 0) return 0
        if (mark == null) {
            val count = super.read(buffer, offset, length)
            if (count > 0) last = buffer[offset + count - 1]
            if (count >= 0) return count
        }
        val text = mark ?: (if (last == '\n' || last == '\r') TEXT else "\n$TEXT").also { mark = it }
        if (given == text.length) return -1
        val count = minOf(length, text.length - given)
        text.toCharArray(buffer, offset, given, given + count)
        given += count
        return count
    }

    companion object {
        /** Begins with a code point that no text holds. */
        const val TEXT = "\uFFFFend of the log"
    }
}
