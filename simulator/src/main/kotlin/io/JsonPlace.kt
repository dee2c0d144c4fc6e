package stillwater.io

/**
 * Where in a JSON text a value stands, so that a message can point at it. Lenient: what is not JSON ends the search.
 *
 * @param text the whole text.
 */
internal class JsonPlace(private val text: String) {
    private var at = 0

    /**
     * Offset of the value at [path], such as `$.area.shore[2].x_m`, or of the innermost value on the way to it that is
     * there; the text's first character that is not blank at worst.
     */
    fun of(path: String): Int {
        at = 0
        skipBlank()
        var found = at
        for (step in STEP.findAll(path)) {
            val index = step.groupValues[2].toIntOrNull()
            val isThere = if (index != null) enterArray(index) else enterObject(step.groupValues[1])
            if (!isThere) return found
            found = at
        }
        return found
    }

    /** The value at [offset] as it is written, cut to a readable length. */
    fun token(offset: Int): String {
        val rest = text.drop(offset)
        if (rest.startsWith('"')) return quoted(rest.drop(1).substringBefore('"'))
        return quoted(rest.takeWhile { it !in ",}]\r\n" })
    }

    /** `LINE:COLUMN` of [offset], both counted from 1. */
    fun lineAndColumn(offset: Int): String {
        val before = text.take(offset)
        return "${before.count { it == '\n' } + 1}:${offset - before.lastIndexOf('\n')}"
    }

    private fun enterObject(name: String): Boolean {
        if (!take('{')) return false
        while (true) {
            skipBlank()
            val key = string() ?: return false
            skipBlank()
            if (!take(':')) return false
            skipBlank()
            if (key == name) return at < text.length
            if (!skipValue()) return false
            skipBlank()
            if (!take(',')) return false
        }
    }

    private fun enterArray(index: Int): Boolean {
        if (!take('[')) return false
        repeat(index) {
            skipBlank()
            if (!skipValue()) return false
            skipBlank()
            if (!take(',')) return false
        }
        skipBlank()
        return at < text.length
    }

    /** Skips a value: brackets are counted, strings passed over. */
    private fun skipValue(): Boolean {
        var depth = 0
        while (at < text.length) {
            when (text[at]) {
                '"' -> string() ?: return false
                '{', '[' -> {
                    depth++
                    at++
                }
                '}', ']' -> if (depth-- == 0) return true else at++
                ',' -> if (depth == 0) return true else at++
                else -> at++
            }
        }
        return false
    }

    private fun string(): String? {
        if (!take('"')) return null
        val start = at
        while (at < text.length && text[at] != '"') at += if (text[at] == '\\') 2 else 1
        if (at >= text.length) return null
        return text.substring(start, at++)
    }

    private fun skipBlank() {
        while (at < text.length && text[at].isWhitespace()) at++
    }

    private fun take(character: Char): Boolean {
        if (at >= text.length || text[at] != character) return false
        at++
        return true
    }

    private companion object {
        val STEP = Regex("""\.([^.\[\]]+)|\[(\d+)]""")
    }
}
