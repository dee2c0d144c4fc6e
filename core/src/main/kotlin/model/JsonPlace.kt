package stillwater.model

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

    /** Offsets of the values in the object at [path], by their names; empty where none is there. */
    fun members(path: String): Map<String, Int> {
        of(path)
        val found = LinkedHashMap<String, Int>()
        eachMember { name ->
            found[name] = at
            true
        }
        return found
    }

    /** `LINE:COLUMN` of [offset], both counted from 1. */
    fun lineAndColumn(offset: Int): String {
        val before = text.take(offset)
        return "${before.count { it == '\n' } + 1}:${offset - before.lastIndexOf('\n')}"
    }

    private fun enterObject(name: String): Boolean {
        var isFound = false
        eachMember {
            isFound = it == name
            !isFound
        }
        return isFound && at < text.length
    }

    /** Goes through the object here; stays at a member's value where [goesOn] says no to its name. */
    private fun eachMember(goesOn: (String) -> Boolean) {
        if (!take('{')) return
        while (true) {
            skipBlank()
            val key = string() ?: return
            skipBlank()
            if (!take(':')) return
            skipBlank()
            if (!goesOn(key) || !skipValue()) return
            skipBlank()
            if (!take(',')) return
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
