package stillwater.closedloop

import stillwater.wire.ByteLink
import kotlin.random.Random

/** A line of the probe's as the board sent it and as it reached the phone. */
internal class ProbeLine(val step: Int, val truth: Double, val said: String, val isWhole: Boolean)

/**
 * The phone's end of a link on which lines are spoilt; what the board truly said is kept for the observer.
 *
 * Works on what the board sent, line by line, before it changes bytes: so it knows of each of the probe's lines what was
 * in it and whether all of it arrived.
 */
internal class FaultyLink(private val inner: ByteLink, private val random: Random) : ByteLink {
    /** Probability that a byte arrives as another. */
    var corruption = 0.0

    /** Whether what the board says does not arrive, and what it is told. */
    var isDeaf = false
    var isMute = false

    /** What the probe's next lines say in place of the truth; null for the truth. */
    var spoilt: (String) -> String? = { null }

    var step = 0
    val probeLines = ArrayList<ProbeLine>()
    var changedBytes = 0L
        private set

    private val buffer = ByteArray(SIZE)
    private val line = StringBuilder()
    private var ready = ByteArray(0)
    private var wasWhole = true

    override fun read(into: ByteArray): Int {
        val count = inner.read(buffer)
        for (i in 0 until count) {
            line.append(Char(buffer[i].toInt() and BYTE))
            if (buffer[i] == '\n'.code.toByte()) pass()
        }
        val size = minOf(ready.size, into.size)
        ready.copyInto(into, 0, 0, size)
        ready = ready.copyOfRange(size, ready.size)
        return size
    }

    override fun write(bytes: ByteArray): Boolean {
        if (isMute) return true
        return inner.write(ByteArray(bytes.size) { changed(bytes[it]) })
    }

    /** What is on the way is lost, as when the phone opens its end anew. */
    fun flush() {
        while (inner.read(buffer) > 0) line.clear()
        ready = ByteArray(0)
        line.clear()
        wasWhole = true
    }

    private fun pass() {
        var text = line.toString()
        line.clear()
        val truth = PROBE.find(text)?.groupValues?.get(1)
        val said = truth?.let(spoilt)
        if (truth != null && said != null) text = text.replace("\"$truth\"", "\"$said\"")
        val bytes = ByteArray(text.length) { text[it].code.toByte() }
        val arrived = ByteArray(bytes.size) { changed(bytes[it]) }
        // A line whose predecessor lost its end is one with it.
        val isWhole = bytes.contentEquals(arrived)
        if (truth != null) {
            probeLines += ProbeLine(step, truth.toDouble(), said ?: truth, isWhole && wasWhole && !isDeaf)
        }
        wasWhole = isWhole || isDeaf
        if (!isDeaf) ready += arrived
    }

    private fun changed(byte: Byte): Byte {
        if (corruption == 0.0 || random.nextDouble() >= corruption) return byte
        changedBytes++
        return (byte + random.nextInt(1, BYTE + 1)).toByte()
    }

    private companion object {
        const val SIZE = 4096
        const val BYTE = 255
        val PROBE = Regex("\"atlas_do\",\"data\":\"([0-9.]+)\"")
    }
}
