package stillwater.survey

import org.junit.jupiter.api.Test
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class KeptReadingsTest {
    @Test
    fun handsReadingsOnInTheirOrder() {
        val kept = KeptReadings()
        val full = block(from = 0)
        while (!full.isFull) full.add(full.size.toDouble(), 0.0, 0.0, 0.0)
        val count = full.size + 2
        kept.take(full)
        kept.take(block(from = full.size, count = 2))
        assertTrue(kept.holds(count.toLong()))
        assertFalse(kept.holds(count + 1L))
        var next = 0
        kept.read { time, _, _, _, _ -> assertEquals(next++.toDouble(), time.seconds) }
        assertEquals(count, next)
    }

    @Test
    fun aReadingIsWhatWasAdded() {
        val block = ReadingBlock()
        block.add(1.0, 2.0, 3.0, 4.0)
        val read = ArrayList<List<Double>>()
        block.read { time, x, y, value, _ -> read += listOf(time.seconds, x, y, value) }
        assertEquals(listOf(listOf(1.0, 2.0, 3.0, 4.0)), read)
    }

    @Test
    fun ofALogTooLongNothingIsKept() {
        val kept = KeptReadings()
        val full = ReadingBlock()
        while (!full.isFull) full.add(0.0, 0.0, 0.0, 0.0)
        var taken = 0L
        while (taken + full.size <= KeptReadings.MOST) {
            kept.take(full)
            taken += full.size
            assertTrue(kept.holds(taken))
        }
        kept.take(full)
        assertFalse(kept.holds(taken + full.size))
        var read = 0
        kept.read { _, _, _, _, _ -> read++ }
        assertEquals(0, read)
    }

    private fun block(from: Int, count: Int = 0) = ReadingBlock().also { block ->
        repeat(count) { block.add((from + it).toDouble(), 0.0, 0.0, 0.0) }
    }
}
