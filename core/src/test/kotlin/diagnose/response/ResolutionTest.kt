package stillwater.diagnose.response

import java.util.Random
import kotlin.math.round
import kotlin.test.Test
import kotlin.test.assertEquals

class ResolutionTest {
    private fun rounded(step: Double, digits: Double) = Random(SEED).let { random ->
        DoubleArray(2000) { round(round((20 + 2 * random.nextGaussian()) / step) * step * digits) / digits }
    }

    @Test
    fun aStepIsFoundToAllDigitsThatTheLogHas() {
        // Written with three digits the readings are 0.096 and 0.097 apart.
        assertEquals(0.09619, Resolution.of(rounded(0.09619, 1e3)), 2e-5, "seed $SEED")
        assertEquals(0.53038, Resolution.of(rounded(0.53038, 1e3)), 1e-4, "seed $SEED")
    }

    @Test
    fun aDecimalStepIsItself() {
        assertEquals(0.01, Resolution.of(rounded(0.01, 1e2)), 1e-9, "seed $SEED")
    }

    @Test
    fun readingsThatAreNotRoundedHaveNone() {
        val random = Random(SEED)
        assertEquals(0.0, Resolution.of(DoubleArray(500) { random.nextGaussian() }), "seed $SEED")
    }

    /** A converter's levels that a logger then wrote with so few decimals that they are no multiples of the least. */
    @Test
    fun aStepIsFoundBehindDecimalsThatHideIt() {
        for ((step, digits) in listOf(0.0456 to 1e3, 0.343 to 1e2, 0.0047 to 1e3, 0.61 to 1e1)) {
            assertEquals(step, Resolution.of(rounded(step, digits)), 0.02 / digits, "$step, seed $SEED")
        }
    }

    @Test
    fun fewDecimalsAloneAreNoStepOfAConverter() {
        val random = Random(SEED)
        repeat(200) { log ->
            // Few readings, of which hardly two are in neighbouring hundredths.
            val readings = DoubleArray(12 + log % 30) { round(1e2 * (20 + 3 * random.nextGaussian())) / 1e2 }
            val found = Resolution.of(readings)
            assertEquals(0.0, (found * 1e2).mod(1.0).let { minOf(it, 1 - it) }, 1e-6, "$found, log $log, seed $SEED")
        }
    }

    private companion object {
        const val SEED = 20261129L
    }
}
