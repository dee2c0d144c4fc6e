package stillwater.diagnose.evidence

import stillwater.diagnose.Verdict
import stillwater.diagnose.noise.CorrelatedNoise
import java.util.Random
import kotlin.math.exp
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertNotNull
import kotlin.test.assertNull

/** Noise of which an instrument has taken means is told from noise that wanders, swings or repeats. Seeds fixed before the first run. */
class AveragedNoiseTest {
    private val n = 2000

    /** A row every [step] s. */
    private fun times(step: Double) = DoubleArray(n) { it * step }

    /** [noise] whitened by the noise model that suits it about as well as any. */
    private fun whitened(noise: DoubleArray, time: Double): DoubleArray {
        val out = DoubleArray(n)
        CorrelatedNoise(times(1.0), 0.95, time, BooleanArray(n) { true }).whiten(noise, out)
        return out
    }

    private fun normal(seed: Long) = Random(seed).let { random -> DoubleArray(n) { random.nextGaussian() } }

    private fun averaged(over: Int, seed: Long): DoubleArray {
        val noise = normal(seed)
        return DoubleArray(n) { i -> (maxOf(i - over + 1, 0)..i).sumOf { noise[it] } / over }
    }

    @Test
    fun theRowsThatAreAveragedAreFound() {
        for ((k, over) in listOf(6, 9, 13, 25, 40).withIndex()) {
            val values = averaged(over, 1200L + k)
            val found = assertNotNull(AveragedNoise.of(whitened(values, over / 2.0), values, times(0.5)), "$over rows")
            assertEquals(over, found.rows)
            assertEquals(over * 0.5, found.time, 1e-9)
            assertContains(found.words(), "averages over ${"%.3g".format(over * 0.5)} s")
            assertNull(found.sentenceBeside(Verdict.Unexplained(found.words())), "it is not said twice")
            assertNotNull(found.sentenceBeside(Verdict.Consistent))
        }
    }

    @Test
    fun whereRowsAreUnevenTheTimeIsThatOfTheRows() {
        val values = averaged(10, 1300)
        val times = DoubleArray(n) { it * 1.5 + (it % 2) * 0.5 }
        assertEquals(15.0, assertNotNull(AveragedNoise.of(whitened(values, 5.0), values, times)).time, 0.5)
    }

    @Test
    fun independentNoiseAndNoiseThatWandersAreNoMeans() {
        for (seed in 1400L until 1440L) {
            val noise = normal(seed)
            assertNull(AveragedNoise.of(noise, noise, times(1.0)), "independent, seed $seed")
            val wanders = DoubleArray(n)
            for (i in 1 until n) wanders[i] = exp(-1 / 8.0) * wanders[i - 1] + noise[i]
            assertNull(AveragedNoise.of(whitened(wanders, 3.0), wanders, times(1.0)), "wandering, seed $seed")
        }
    }

    @Test
    fun wavesAreNoMeans() {
        for (seed in 1440L until 1460L) {
            val noise = normal(seed)
            val rolls = DoubleArray(n) { sin(it * 2 * Math.PI / 14) + 0.3 * noise[it] }
            assertNull(AveragedNoise.of(rolls, rolls, times(1.0)), "even waves, seed $seed")
            // A boat that rolls in irregular waves, of 12 rows.
            val swings = DoubleArray(n)
            for (i in 2 until n) swings[i] = 1.64 * swings[i - 1] - 0.9 * swings[i - 2] + noise[i]
            assertNull(AveragedNoise.of(swings, swings, times(1.0)), "irregular waves, seed $seed")
        }
    }

    @Test
    fun readingsThatAreRepeatedAreNoMeans() {
        for (seed in 1460L until 1480L) {
            val noise = normal(seed)
            val held = DoubleArray(n) { noise[it / 8] }
            assertNull(AveragedNoise.of(whitened(held, 4.0), held, times(1.0)), "seed $seed")
        }
    }
}
