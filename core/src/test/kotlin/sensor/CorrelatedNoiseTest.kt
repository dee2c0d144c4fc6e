package stillwater.sensor

import org.junit.jupiter.api.Test
import stillwater.model.Conditions
import kotlin.math.exp
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class CorrelatedNoiseTest {
    private fun CorrelatedNoise.step(input: Double, dt: Double) = step(input, dt, Conditions.NONE)

    /** The mean of the products of numbers [lag] apart; its standard error by 20 parts of the log. */
    private fun product(numbers: DoubleArray, lag: Int): Pair<Double, Double> {
        val products = DoubleArray(numbers.size - lag) { numbers[it] * numbers[it + lag] }
        val parts = products.toList().chunked(products.size / PARTS).take(PARTS).map { it.average() }
        val mean = parts.average()
        return mean to sqrt(parts.sumOf { (it - mean) * (it - mean) } / (PARTS - 1) / PARTS)
    }

    @Test
    fun fadesOverItsTimeAndKeepsItsSpreadHoweverLongTheSteps() {
        for (dt in listOf(0.5, 3.0)) {
            val noise = CorrelatedNoise(0.2, TIME, Random(21))
            val draws = DoubleArray(COUNT) { noise.step(5.0, dt) - 5 }
            for (lag in listOf(0, 1, 4, 10)) {
                val (mean, error) = product(draws, lag)
                assertEquals(0.04 * exp(-lag * dt / TIME), mean, 4 * error, "steps of $dt s, $lag apart")
                assertTrue(error < 0.004, "$error would let anything pass")
            }
        }
    }

    @Test
    fun beginsAnywhereWithinItsSpread() {
        val first = DoubleArray(2000) { CorrelatedNoise(0.2, TIME, Random(it)).step(0.0, 1e-9) }
        // Standard error of a standard deviation σ/√(2n); four of them.
        assertEquals(0.2, sqrt(first.sumOf { it * it } / first.size), 4 * 0.2 / sqrt(2.0 * first.size))
    }

    @Test
    fun withoutTimeNothingWanders() {
        val noise = CorrelatedNoise(0.2, TIME, Random(3))
        val before = noise.step(0.0, 1.0)
        for (dt in listOf(0.0, -1.0, Double.NaN, Double.POSITIVE_INFINITY)) assertEquals(before, noise.step(0.0, dt))
        assertTrue(noise.step(Double.NaN, 0.0).isNaN())
    }

    @Test
    fun badNumbersAreRefused() {
        for (bad in listOf(Double.NaN, -1.0, Double.POSITIVE_INFINITY)) {
            assertFailsWith<IllegalArgumentException> { CorrelatedNoise(bad, 1.0, Random(0)) }
            assertFailsWith<IllegalArgumentException> { CorrelatedNoise(1.0, bad, Random(0)) }
        }
        assertFailsWith<IllegalArgumentException> { CorrelatedNoise(1.0, 0.0, Random(0)) }
    }

    private companion object {
        const val COUNT = 100_000
        const val PARTS = 20
        const val TIME = 6.0
    }
}
