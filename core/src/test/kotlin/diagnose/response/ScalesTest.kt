package stillwater.diagnose.response

import stillwater.diagnose.MeasuredSeries
import java.util.Random
import kotlin.test.Test
import kotlin.test.assertEquals

class ScalesTest {
    private fun rounded(step: Double, digits: Double) = Random(SEED).let { random ->
        DoubleArray(2000) { Math.rint(Math.rint((20 + 2 * random.nextGaussian()) / step) * step * digits) / digits }
    }

    @Test
    fun aStepIsFoundToAllDigitsThatTheLogHas() {
        // Written with three digits the readings are 0.096 and 0.097 apart.
        assertEquals(0.09619, Scales.resolution(rounded(0.09619, 1e3)), 2e-5, "seed $SEED")
        assertEquals(0.53038, Scales.resolution(rounded(0.53038, 1e3)), 1e-4, "seed $SEED")
    }

    @Test
    fun aDecimalStepIsItself() {
        assertEquals(0.01, Scales.resolution(rounded(0.01, 1e2)), 1e-9, "seed $SEED")
    }

    @Test
    fun readingsThatAreNotRoundedHaveNone() {
        val random = Random(SEED)
        assertEquals(0.0, Scales.resolution(DoubleArray(500) { random.nextGaussian() }), "seed $SEED")
    }

    @Test
    fun theOrdinarySpeedOfABoatThatStandsMostOfTheTimeIsThatUnderWay() {
        fun ordinary(standing: Int): Double {
            val n = 100
            val speed = DoubleArray(n) { if (it < standing) 0.01 else 0.6 + 0.001 * it }
            val times = DoubleArray(n) { it.toDouble() }
            return Scales(MeasuredSeries(times, times, times, times, times, mapOf("speed" to speed))).ordinarySpeed
        }
        assertEquals(0.69, ordinary(standing = 80), 0.002)
        assertEquals(0.65, ordinary(standing = 0), 0.002)
    }

    private companion object {
        const val SEED = 20261129L
    }
}
