package stillwater.diagnosis

import org.junit.jupiter.api.Test
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.sqrt
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class CorrelatedNoiseTest {
    @Test
    fun theMeanOfWhiteNoiseFallsWithTheRootOfTheRows() {
        val times = List(25) { it.toDouble() }
        assertEquals(0.4, CorrelatedNoise(2.0, 0.0, 10.0).ofMean(times), 1e-12)
        assertEquals(0.4, CorrelatedNoise(2.0, 1.0, 0.0).ofMean(times), 1e-12, "over no time")
    }

    @Test
    fun itIsTheSumOverAllPairsOfRows() {
        val times = listOf(0.0, 1.0, 1.5, 7.0, 30.0, 31.0)
        var sum = 0.0
        for (t in times) for (u in times) sum += if (t == u) 1.0 else 0.6 * exp(-abs(t - u) / 4.0)
        assertEquals(2.0 * sqrt(sum) / 6, CorrelatedNoise(2.0, 0.6, 4.0).ofMean(times), 1e-12)
    }

    /** As many rows, all in a row or from all over the log, as those of one heading are. */
    @Test
    fun rowsFarApartTellMore() {
        val noise = CorrelatedNoise(1.0, 0.95, 30.0)
        val together = noise.ofMean(List(80) { it.toDouble() })
        val apart = noise.ofMean(List(80) { it * 20.0 })
        // Of 80 s in a row only two or three are not one and the same; of 1600 s about 50.
        assertTrue(together > 0.6 && apart < 0.25, "$together, $apart")
    }
}
