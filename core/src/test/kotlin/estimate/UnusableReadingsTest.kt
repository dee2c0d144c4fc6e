package stillwater.estimate

import org.junit.jupiter.api.Test
import kotlin.math.exp
import kotlin.math.sin
import kotlin.math.tanh
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class UnusableReadingsTest {
    private fun series(values: DoubleArray) =
        TrackSeries(DoubleArray(values.size) { it.toDouble() }, values, values, values)

    private fun found(values: DoubleArray, resolution: Double = DIGIT) =
        UnusableReadings.of(series(values), resolution)

    private fun rounded(value: Double, digit: Double = DIGIT) = digit * Math.rint(value / digit)

    private fun wavy(random: Random, noise: Double = 0.02) = DoubleArray(ROWS) {
        rounded(8 + sin(it / 17.0) + 0.6 * sin(it / 6.0) + noise * random.nextDouble(-1.7, 1.7))
    }

    @Test
    fun everySpikeIsFoundAndNothingElse() {
        val random = Random(4)
        val values = wavy(random)
        // Two of them side by side.
        val spikes = (List(25) { 20 + 30 * it } + 21).toSet()
        for (i in spikes) values[i] += if (random.nextBoolean()) 2.5 else -3.5
        val unusable = found(values)
        assertEquals(spikes, values.indices.filter { unusable.wild[it] }.toSet())
        assertTrue(unusable.ends.all { it.toInt() == 0 })
    }

    /** A slow sensor's readings are smooth: its steps on a slope are many times its noise. */
    @Test
    fun spikesOnASlopeAreFoundAndNothingElse() {
        val random = Random(8)
        val values = DoubleArray(ROWS) { rounded(8 + 4 * sin(it / 12.0) + 0.02 * random.nextDouble(-1.7, 1.7)) }
        val spikes = setOf(37, 113, 188, 189, 301, 302, 415, 490, 529, 604)
        for (i in spikes) values[i] = if (i > 300) 0.0 else 30.0
        val unusable = found(values)
        assertEquals(spikes, values.indices.filter { unusable.wild[it] }.toSet())
    }

    /** A probe that is switched on, that a logger does not hear for some rows, and that is switched off at the end. */
    @Test
    fun numbersInPlaceOfReadingsAreFound() {
        val values = wavy(Random(9))
        val codes = setOf(0, 1) + (200..203) + (500..519) + (ROWS - 1)
        for (i in codes) values[i] = if (i in 200..203) 65535.0 else 0.0
        val unusable = found(values)
        assertEquals(codes, values.indices.filter { unusable.wild[it] }.toSet())
        assertTrue(unusable.ends.all { it.toInt() == 0 })
    }

    /** Of other water a few rows, which are not twice the same; a slow sensor does not come into any in one row. */
    @Test
    fun aShortVisitToOtherWaterStays() {
        val random = Random(10)
        val fast = wavy(random)
        for (i in 600 until 606) fast[i] = rounded(40 + 0.1 * random.nextDouble())
        val slow = wavy(random)
        var shown = slow[600]
        for (i in 600 until ROWS) {
            shown += ((if (i < 606) 40.0 else slow[i]) - shown) / 5
            slow[i] = rounded(shown)
        }
        for (values in listOf(fast, slow)) assertTrue(found(values).isNone)
    }

    /** A sensor without a lag crosses a front from one row to the next, and a patch in three. */
    @Test
    fun whatIsConfirmedByTheRowsAfterItStays() {
        val random = Random(5)
        val front = DoubleArray(ROWS) { rounded((if (it < 300) 4.0 else 9.0) + 0.02 * random.nextDouble(-1.7, 1.7)) }
        val ramp = DoubleArray(ROWS) { rounded(6 + 2 * tanh((it - 300) / 1.5) + 0.02 * random.nextDouble(-1.7, 1.7)) }
        val patch = wavy(random).also { values -> for (i in -2..2) values[400 + i] += 3 * exp(-i * i / 2.0) }
        for (values in listOf(front, ramp, patch)) assertTrue(found(values).isNone)
    }

    @Test
    fun readingsAtAnEndOfTheRangeAreFoundOnItsSide() {
        val values = wavy(Random(6))
        val clipped = DoubleArray(ROWS) { minOf(values[it], 9.0) }
        val turned = DoubleArray(ROWS) { -clipped[it] }
        val top = found(clipped)
        assertEquals(values.indices.filter { values[it] >= 9.0 }, values.indices.filter { top.ends[it] > 0 })
        assertEquals(values.indices.filter { values[it] >= 9.0 }, values.indices.filter { found(turned).ends[it] < 0 })
        assertTrue(top.mirrored().ends.none { it > 0 })
    }

    /** Rounding makes runs of equal readings as well, the longest of them where the water turns; so does a stuck sensor. */
    @Test
    fun readingsThatAreRoundedCoarselyEndNowhere() {
        val noisy = wavy(Random(7)).also { for (i in it.indices) it[i] = rounded(it[i], 0.5) }
        for (values in listOf(noisy, DoubleArray(ROWS) { 8.0 })) assertTrue(found(values, 0.1).isNone)
    }

    /** A wave that comes again and again, whose crest falls anywhere within the last digit. */
    @Test
    fun smoothWaterThatIsRoundedEndsNowhere() {
        for (step in listOf(0.02, 0.05, 0.1)) {
            for (amplitude in 0 until 40) {
                val height = 1 + amplitude / 40.0
                val wave = DoubleArray(2 * ROWS) { rounded(8 + height * sin(2 * Math.PI * it / 300), step) }
                assertTrue(found(wave, step).isNone, "amplitude $height, step $step")
            }
        }
    }

    @Test
    fun aReadingADigitBelowAKnownEndIsUsable() {
        val values = DoubleArray(45) { if (it % 9 == 0) 5.0 else 4 + 0.99 * (it % 9) / 8 }
        val unusable = UnusableReadings.of(series(values), DIGIT, Double.NEGATIVE_INFINITY..5.0)
        assertEquals(values.indices.filter { values[it] == 5.0 }, values.indices.filter { unusable.ends[it] > 0 })
    }

    @Test
    fun wildReadingsAreBridged() {
        val values = doubleArrayOf(9.0, 9.0, 1.0, 9.0, 9.0, 4.0, 9.0)
        val wild = BooleanArray(values.size) { values[it] == 9.0 }
        val bridged = UnusableReadings(wild, ByteArray(values.size)).bridged(series(values).retimed(TIMES))
        assertEquals(listOf(1.0, 1.0, 1.0, 2.0, 2.5, 4.0, 4.0), bridged.toList())
        assertEquals(values.toList(), UnusableReadings.none(values.size).bridged(series(values)).toList())
    }

    @Test
    fun anEndThatIsKnownIsNotLookedFor() {
        val values = doubleArrayOf(4.0, 5.0, 5.0, 4.5, 3.0) + DoubleArray(40) { 4 + 0.01 * it }
        val unusable = UnusableReadings.of(series(values), DIGIT, 3.001..5.001)
        assertEquals(listOf(1, 2), values.indices.filter { unusable.ends[it] > 0 })
        assertEquals(listOf(4), values.indices.filter { unusable.ends[it] < 0 })
    }

    private companion object {
        const val ROWS = 800
        const val DIGIT = 0.01
        val TIMES = doubleArrayOf(0.0, 1.0, 2.0, 4.0, 5.0, 8.0, 9.0)
    }
}
