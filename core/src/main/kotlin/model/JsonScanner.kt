package stillwater.model

/**
 * Reads a JSON text from its begin to its end, as RFC 8259 has it and no more leniently, and says where it is not so.
 *
 * @param text the whole text.
 */
internal class JsonScanner(private val text: String) {
    /** What was read is not what it should be: at [offset], [expected], [found]. */
    class Fault(val offset: Int, val expected: String, val found: String) : Exception()

    /** Offset of what is read next. */
    var at = 0

    /** What is read next, blanks passed over; [END] at the end. */
    fun next(): Char {
        while (at < text.length && text[at] in BLANKS) at++
        return text.getOrElse(at) { END }
    }

    /** Takes [character] if it is next, blanks passed over. */
    fun take(character: Char): Boolean = (next() == character).also { if (it) at++ }

    /** Takes [character], or says that [expected] is not there. */
    fun demand(character: Char, expected: String) {
        if (!take(character)) fail(expected)
    }

    /** Goes through the members of the object that is next; [member] reads a value, told its name and where that stands. */
    fun members(expected: String, member: (name: String, offset: Int) -> Unit) {
        demand('{', expected)
        if (take('}')) return
        val seen = HashMap<String, Int>()
        do {
            next()
            val offset = at
            val name = string("a field's name in quotes")
            seen.put(name, offset)?.let {
                throw Fault(offset, "each field once", "'$name' again, which ${placeOf(it)} has already")
            }
            demand(':', "a colon")
            member(name, offset)
        } while (take(','))
        demand('}', "a comma or a closing brace")
    }

    /** Goes through the items of the list that is next; [item] reads one, told its index. */
    fun items(expected: String, item: (index: Int) -> Unit) {
        demand('[', expected)
        if (take(']')) return
        var index = 0
        do item(index++) while (take(','))
        demand(']', "a comma or a closing bracket")
    }

    /** Any value. */
    fun any(depth: Int = 0) {
        if (depth > DEEPEST) fail("no more than $DEEPEST brackets one within the other")
        when (next()) {
            '{' -> members("") { _, _ -> any(depth + 1) }
            '[' -> items("") { any(depth + 1) }
            '"' -> string("")
            else -> if (word() !in LITERALS) number("a value") else at += word().length
        }
    }

    /** The string that is next. */
    fun string(expected: String): String {
        if (next() != '"') fail(expected)
        val begin = at++
        val characters = StringBuilder()
        while (true) {
            val character = text.getOrElse(at) { throw Fault(begin, "a closing quotation mark", "none") }
            val isControl = character < ' '
            if (isControl) throw Fault(at, "no control character in a text", "one; a quotation mark may be missing")
            at++
            if (character == '"') return characters.toString()
            characters.append(if (character == '\\') escaped() else character)
        }
    }

    /** The number that is next, as it is written. */
    fun number(expected: String): String {
        val written = word()
        if (!NUMBER.matches(written)) fail(expected)
        at += written.length
        return written
    }

    /** What is next up to a blank, comma, colon or bracket. */
    fun word(): String {
        next()
        var end = at
        while (end < text.length && text[end] !in BLANKS && text[end] !in ",:]}[{\"") end++
        return text.substring(at, end)
    }

    /** Nothing may be next. */
    fun end() {
        if (next() != END || at < text.length) fail("nothing more")
    }

    /** Says that [expected] is not next. */
    fun fail(expected: String): Nothing {
        val found = found()
        throw Fault(if (at >= text.length) text.trimEnd().length else at, expected, found)
    }

    private fun found(): String = when (next()) {
        '{' -> "an object in braces"
        '[' -> "a list in brackets"
        '"' -> {
            val begin = text.substring(at + 1, minOf(at + 1 + 2 * SHORT, text.length))
            "the text '${short(begin.substringBefore('"'))}'"
        }
        END -> if (at >= text.length) "the end" else "a zero byte"
        else -> "'" + short(word().ifEmpty { text[at].toString() }) + "'"
    }

    private fun escaped(): Char {
        val begin = at - 1
        when (val letter = text.getOrElse(at++) { END }) {
            '"', '\\', '/' -> return letter
            'b' -> return '\b'
            'f' -> return '\u000c'
            'n' -> return '\n'
            'r' -> return '\r'
            't' -> return '\t'
            'u' -> {
                val digits = text.substring(at, minOf(at + HEX_DIGITS, text.length))
                if (digits.length == HEX_DIGITS && digits.all { it in HEX }) {
                    at += HEX_DIGITS
                    return digits.toInt(HEX_BASE).toChar()
                }
            }
        }
        throw Fault(
            begin,
            "an escape of JSON such as \\n, \\\" or \\u00b5",
            "another; a backslash itself is written twice",
        )
    }

    private fun short(words: String) = if (words.length <= SHORT) words else words.take(SHORT) + "..."

    private fun placeOf(offset: Int) = JsonPlace(text).lineAndColumn(offset)

    companion object {
        /** Stands for the end of the text. */
        const val END = '\u0000'

        /** Brackets one within the other that a text may have, far more than a form of ours needs. */
        const val DEEPEST = 64
        private const val BLANKS = " \t\r\n"
        private const val SHORT = 40
        private const val HEX = "0123456789abcdefABCDEF"
        private const val HEX_DIGITS = 4
        private const val HEX_BASE = 16
        private val LITERALS = setOf("true", "false", "null")
        private val NUMBER = Regex("""-?(0|[1-9]\d*)(\.\d+)?([eE][+-]?\d+)?""")
    }
}
