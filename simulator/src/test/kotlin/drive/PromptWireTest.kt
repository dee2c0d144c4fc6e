package stillwater.drive

import org.junit.jupiter.api.Test
import stillwater.wire.ByteLink
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class PromptWireTest {
    /** A link that gives one of [pieces] at each reading: nothing where it is empty, lost where it is null. */
    private class Slow(private vararg val pieces: String?) : ByteLink {
        private var next = 0
        var reads = 0
            private set

        override fun read(into: ByteArray): Int {
            reads++
            val piece = if (next < pieces.size) pieces[next++] else ""
            return piece?.toByteArray()?.also { it.copyInto(into) }?.size ?: ByteLink.LOST
        }

        override fun write(bytes: ByteArray): Boolean = true
    }

    private fun PromptWire.readAll(): String {
        val buffer = ByteArray(3)
        val text = StringBuilder()
        while (true) {
            val count = read(buffer)
            if (count <= 0) return text.toString()
            text.append(String(buffer, 0, count))
        }
    }

    @Test
    fun whatWasSentIsWaitedForAndReadInOrder() {
        val wire = PromptWire(Slow("", "ab", "", "", "cdef", "", "gh"))
        wire.await(6)
        assertEquals("abcdef", wire.readAll())
        wire.await(8)
        assertEquals("gh", wire.readAll())
        // The wire was opened anew, and what it sends counts from 0 again.
        wire.await(0)
        assertEquals("", wire.readAll())
    }

    @Test
    fun whatWasLostIsWaitedForOnce() {
        val link = Slow("ab")
        var wall = 0L
        val wire = PromptWire(link) { wall.also { wall += PromptWire.PATIENCE_NANOS / 10 } }
        wire.await(10)
        assertEquals(1, wire.timesLate)
        assertEquals("ab", wire.readAll())
        val reads = link.reads
        wire.await(10)
        assertEquals(reads, link.reads)
        assertEquals(1, wire.timesLate)
    }

    @Test
    fun aWireThatIsLostMeanwhileSaysSoAfterWhatItHad() {
        val wire = PromptWire(Slow("ab", null))
        wire.await(10)
        val buffer = ByteArray(10)
        assertEquals(2, wire.read(buffer))
        assertEquals(ByteLink.LOST, wire.read(buffer))
        assertEquals(0, wire.read(buffer))
    }

    /** A virtual boat that says it has sent more than there is, and never stops sending. */
    @Test
    fun whatNeverEndsIsNeitherWaitedForNorHeldWithoutEnd() {
        val endless = object : ByteLink {
            var given = 0L

            override fun read(into: ByteArray): Int = into.size.also { given += it }

            override fun write(bytes: ByteArray): Boolean = true
        }
        val wire = PromptWire(endless) { 0L }
        wire.await(Long.MAX_VALUE)
        assertEquals(1, wire.timesLate)
        assertTrue(endless.given < 1_000_000, "held ${endless.given} bytes")
    }
}
