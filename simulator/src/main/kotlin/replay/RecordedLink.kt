package stillwater.replay

import stillwater.wire.ByteLink

/** A link on which a recorded board speaks. What is sent is handed to [answer]; nothing else becomes of it. */
internal class RecordedLink(private val answer: (String) -> Unit = {}) : ByteLink {
    private var waiting = ByteArray(0)
    private var taken = 0

    /** Lets the board say [line], one byte a character. */
    fun say(line: String) {
        waiting = waiting.copyOfRange(taken, waiting.size) + (line + "\n").toByteArray(Charsets.ISO_8859_1)
        taken = 0
    }

    override fun read(into: ByteArray): Int {
        val count = minOf(into.size, waiting.size - taken)
        waiting.copyInto(into, 0, taken, taken + count)
        taken += count
        return count
    }

    override fun write(bytes: ByteArray): Boolean {
        answer(bytes.decodeToString())
        return true
    }
}
