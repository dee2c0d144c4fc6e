package stillwater.wire

/**
 * Reads JSON's small words out of bytes, in place. Every call answers whether it could; none throws.
 *
 * Strings with escapes are passed over as they stand: no board sends them. Confined to one thread.
 */
internal class ByteCursor {
    var bytes: ByteArray = ByteArray(0)
        private set
    var at = 0
    var end = 0
        private set

    /** Where the string or number last read lies. */
    var start = 0
        private set
    var stop = 0
        private set

    fun open(bytes: ByteArray, start: Int, end: Int) {
        this.bytes = bytes
        at = start
        this.end = end
    }

    fun skipBlanks() {
        while (at < end && (bytes[at] == BLANK || bytes[at] == TAB)) at++
    }

    /** The byte at the cursor after blanks, or 0 at the end. */
    fun peek(): Byte {
        skipBlanks()
        return if (at < end) bytes[at] else 0
    }

    /** Passes [byte] if it is next. */
    fun pass(byte: Byte): Boolean {
        if (peek() != byte) return false
        at++
        return true
    }

    /** Reads a string; its content lies from [start] until [stop]. */
    fun string(): Boolean {
        if (!pass(QUOTE)) return false
        start = at
        while (at < end) {
            val byte = bytes[at]
            if (byte == QUOTE) {
                stop = at++
                return true
            }
            at += if (byte == BACKSLASH) 2 else 1
        }
        at = end
        return false
    }

    /** Reads a word that is no string: a number, true, false or null. */
    fun word(): Boolean {
        skipBlanks()
        start = at
        while (at < end && isWord(bytes[at])) at++
        stop = at
        return stop > start
    }

    private fun isWord(byte: Byte): Boolean = byte in 'a'.code..'z'.code || byte in '0'.code..'9'.code ||
        byte == MINUS || byte == '+'.code.toByte() || byte == '.'.code.toByte() || byte == 'E'.code.toByte()

    /** Passes any value: a string, a word, an object or an array, to a depth of [MAX_DEPTH]. */
    fun skipValue(): Boolean {
        var depth = 0
        do {
            val next = peek()
            val ok = when {
                next == QUOTE -> string()
                next == OPEN || next == '['.code.toByte() -> {
                    depth++
                    at++
                    depth <= MAX_DEPTH
                }
                (next == CLOSE || next == ']'.code.toByte()) && depth > 0 -> {
                    depth--
                    at++
                    true
                }
                (next == COMMA || next == COLON) && depth > 0 -> {
                    at++
                    true
                }
                else -> word()
            }
            if (!ok) return false
        } while (depth > 0)
        return true
    }

    /** Whether what was last read is [text], all ASCII. */
    fun reads(text: ByteArray): Boolean {
        if (stop - start != text.size) return false
        for (i in text.indices) if (bytes[start + i] != text[i]) return false
        return true
    }

    /** What was last read, as text. Allocates. */
    fun text(): String = String(bytes, start, stop - start, Charsets.ISO_8859_1)

    companion object {
        const val BLANK: Byte = 32
        const val TAB: Byte = 9
        const val QUOTE: Byte = 34
        const val BACKSLASH: Byte = 92
        const val OPEN: Byte = 123
        const val CLOSE: Byte = 125
        const val COLON: Byte = 58
        const val COMMA: Byte = 44
        const val MINUS: Byte = 45
        private const val MAX_DEPTH = 8
    }
}
