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

    /** The byte at the cursor after blanks, or 0 at the end. */
    fun peek(): Byte {
        if (at < end) {
            val next = bytes[at]
            if (next != BLANK && next != TAB) return next
        }
        while (at < end && (bytes[at] == BLANK || bytes[at] == TAB)) at++
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
        val text = bytes
        val last = end
        var here = at
        start = here
        while (here < last) {
            val byte = text[here]
            if (byte == QUOTE) {
                stop = here
                at = here + 1
                return true
            }
            here += if (byte == BACKSLASH) 2 else 1
        }
        at = last
        return false
    }

    /** Reads a word that is no string: a number, true, false or null. */
    fun word(): Boolean {
        peek()
        val text = bytes
        val last = end
        var here = at
        start = here
        while (here < last && text[here] >= 0 && WORD[text[here].toInt()]) here++
        stop = here
        at = here
        return here > start
    }

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
        private const val MAX_DEPTH = 8
        private val WORD = BooleanArray(128) {
            val char = it.toChar()
            char in 'a'..'z' || char in '0'..'9' || char == '-' || char == '+' || char == '.' || char == 'E'
        }
    }
}
