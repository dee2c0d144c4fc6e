package stillwater.io

import java.io.Reader

/**
 * The lines of a text, one after the other; of a line longer than [longest] only its begin and [MARK], which no reader
 * takes for a line of its own.
 *
 * A file that is no text may be a single line of gigabytes. Lines end in CR, LF or both. Confined to one thread.
 *
 * @param text closed with this. Retained.
 */
internal class BoundedLines(private val text: Reader, private val longest: Int = LONGEST) :
    Iterator<String>,
    AutoCloseable {
    private val buffer = CharArray(BUFFER)
    private var at = 0
    private var end = 0
    private val line = StringBuilder()
    private var coming: String? = null

    override fun hasNext(): Boolean {
        if (coming == null) coming = read()
        return coming != null
    }

    /** The line that [next] would give, which stays; null at the end. */
    fun peek(): String? = if (hasNext()) coming else null

    override fun next(): String {
        if (!hasNext()) throw NoSuchElementException()
        return checkNotNull(coming).also { coming = null }
    }

    override fun close() = text.close()

    private fun read(): String? {
        if (!fill()) return null
        line.setLength(0)
        var isCut = false
        while (fill()) {
            var stop = at
            while (stop < end && buffer[stop] != '\n' && buffer[stop] != '\r') stop++
            if (line.length + stop - at > longest) isCut = true
            line.appendRange(buffer, at, minOf(stop, at + longest - line.length))
            at = stop
            if (stop < end) {
                endLine()
                break
            }
        }
        return if (isCut) line.take(BEGIN).toString() + MARK else line.toString()
    }

    private fun endLine() {
        val wasReturn = buffer[at++] == '\r'
        if (wasReturn && fill() && buffer[at] == '\n') at++
    }

    /** Whether there is a character at [at]. */
    private fun fill(): Boolean {
        if (at < end) return true
        at = 0
        end = maxOf(0, text.read(buffer))
        return end > 0
    }

    companion object {
        /**
         * Longest line, characters: several times what a mission, with which its log begins, has of an area with the
         * most edges and all digits. A board that never stops talking makes shorter ones.
         */
        const val LONGEST = 1 shl 22

        /** Stands where a line was cut. */
        const val MARK = "\u2026 (cut)"
        private const val BEGIN = 200
        private const val BUFFER = 1 shl 14
    }
}
