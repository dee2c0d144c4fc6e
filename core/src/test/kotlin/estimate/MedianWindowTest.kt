package stillwater.estimate

import org.junit.jupiter.api.Test
import stillwater.property.drawn
import stillwater.property.forEvery
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class MedianWindowTest {
    @Test
    fun dropsASingleOutlier() {
        val window = MedianWindow(3)
        val medians = listOf(1.0, 2.0, 900.0, 4.0, 5.0).mapIndexed { i, value ->
            window.add(i.toDouble(), value)
            window.median
        }
        assertEquals(listOf(2.0, 4.0, 5.0), medians.drop(2))
    }

    @Test
    fun passesAMonotoneSignalWithItsTiming() {
        for (size in listOf(1, 3, 5, 9)) {
            val window = MedianWindow(size)
            for (i in 0 until 40) {
                window.add(100.0 + i, 3.0 * (100 + i))
                if (window.full) assertEquals(3.0 * window.time, window.median, 0.0, "size $size")
            }
        }
    }

    @Test
    fun isFullAfterItsSizeAndEmptyAfterClear() {
        val window = MedianWindow(3)
        for (i in 0 until 2) {
            window.add(i.toDouble(), 1.0)
            assertFalse(window.full)
        }
        window.add(2.0, 1.0)
        assertTrue(window.full)
        window.clear()
        assertFalse(window.full)
        for (i in 10 until 13) window.add(i.toDouble(), i.toDouble())
        // Nothing of the ones before the clear is left.
        assertEquals(11.0, window.median, 0.0)
        assertEquals(11.0, window.time, 0.0)
    }

    @Test
    fun agreesWithSortingTheLastSamples() {
        forEvery(drawn(::History), cases = 500) { history ->
            val window = MedianWindow(history.size)
            val kept = ArrayList<Pair<Double, Double>>()
            for ((time, value) in history.samples) {
                if (value.isNaN()) {
                    window.clear()
                    kept.clear()
                    continue
                }
                window.add(time, value)
                kept += time to value
                assertEquals(kept.size >= history.size, window.full)
                if (!window.full) continue
                val last = kept.takeLast(history.size)
                // The window moves numbers and computes none: exact.
                assertEquals(last.map { it.second }.sorted()[history.size / 2], window.median, 0.0)
                assertEquals(last[history.size / 2].first, window.time, 0.0)
            }
        }
    }

    @Test
    fun sizeIsOddAndPositive() {
        for (size in listOf(0, -1, 2, 10)) {
            val error = assertFailsWith<IllegalArgumentException> { MedianWindow(size) }
            assertEquals("median window ($size samples) must be odd and at least 1", error.message)
        }
    }

    /** Repeated values, neighbouring numbers, zeros of both signs, large stamps, and now and then a clear (NaN). */
    private class History(random: Random) {
        val size = 1 + 2 * random.nextInt(8)
        val samples = List(random.nextInt(1, 120)) {
            val value = when (random.nextInt(10)) {
                in 0..4 -> random.nextInt(-2, 3) * 0.5
                5 -> -0.0
                6 -> 0.5 + random.nextInt(4) * 1e-15
                7 -> if (random.nextInt(6) == 0) Double.NaN else 1e300
                else -> random.nextDouble(-1.0, 1.0)
            }
            1.6e9 + it * 0.1 to value
        }

        override fun toString() = "size $size, $samples"
    }
}
