package stillwater.replay

import stillwater.wire.ByteLink

/** A link on which a recorded board speaks. What is sent is handed to [answer]; nothing else becomes of it. */
internal class RecordedLink(private val answer: (String) -> Unit = {}) : ByteLink {
    private var waiting = ByteArray(0)
    private var taken = 0
    private var end = 0

    /** Lets the board say [line], one byte a character. */
    fun say(line: String) {
        val bytes = (line + "\n").toByteArray(Charsets.ISO_8859_1)
        if (end + bytes.size > waiting.size) {
            // At least twice what is needed, so that many short lines cost no more than one long one.
            val room = ByteArray(2 * (end - taken + bytes.size))
            waiting.copyInto(room, 0, taken, end)
            waiting = room
            end -= taken
            taken = 0
        }
        bytes.copyInto(waiting, end)
        end += bytes.size
    }

    override fun read(into: ByteArray): Int {
        val count = minOf(into.size, end - taken)
        waiting.copyInto(into, 0, taken, taken + count)
        taken += count
        return count
    }

    override fun write(bytes: ByteArray): Boolean {
        answer(bytes.decodeToString())
        return true
    }
}
