package stillwater.diagnose

import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class CorrelatedNoiseTest {
    private val times = DoubleArray(4000) { it + 0.2 * (it % 3) }
    private val used = BooleanArray(times.size) { true }

    /**
     * Noise of unit variance, of which [share] is correlated over [time]; sums of twelve even numbers are nearly
     * normal.
     */
    private fun noise(share: Double, time: Double): DoubleArray {
        val random = Random(5)
        fun normal() = (1..12).sumOf { random.nextDouble() } - 6
        var state = normal()
        return DoubleArray(times.size) { i ->
            val keep = if (i == 0) 0.0 else exp(-(times[i] - times[i - 1]) / time)
            state = keep * state + sqrt(1 - keep * keep) * normal()
            sqrt(share) * state + sqrt(1 - share) * normal()
        }
    }

    @Test
    fun whiteningLeavesNoCorrelationBetweenNeighbours() {
        val z = DoubleArray(times.size)
        CorrelatedNoise(times, 0.7, 8.0, used).whiten(noise(0.7, 8.0), z)
        val next = (1 until z.size).sumOf { z[it] * z[it - 1] } / squares(z)
        // Three standard errors of the correlation of 4000 independent numbers are 0.047.
        assertTrue(abs(next) < 0.047, "correlation $next")
        assertEquals(1.0, squares(z) / z.size, 0.07, "variance: three standard errors, sqrt(2 / 4000) each")
    }

    @Test
    fun theLikeliestNoiseIsNearTheTrueOne() {
        val series = MeasuredSeries(times, times, times, times, null)
        val found = CorrelatedNoise.of(Scales(series), noise(0.7, 8.0), used, 200.0)
        // About four standard errors at this length, from repeated draws.
        assertEquals(0.7, found.share, 0.1)
        assertEquals(8.0, found.time, 3.0)
    }

    @Test
    fun rowsNotInUseCountForNothing() {
        val half = BooleanArray(times.size) { it % 2 == 0 }
        val z = DoubleArray(times.size)
        CorrelatedNoise(times, 0.5, 8.0, half).whiten(noise(0.5, 8.0), z)
        assertTrue(z.indices.all { half[it] || z[it] == 0.0 })
    }
}
