package stillwater.sensor

import org.junit.jupiter.api.Test
import stillwater.model.Conditions
import kotlin.math.abs
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertNotEquals
import kotlin.test.assertTrue

class GaussianNoiseTest {
    private fun GaussianNoise.step(input: Double) = step(input, 1.0, Conditions.NONE)

    private fun draws(count: Int, seed: Int, standardDeviation: Double = 1.0, input: Double = 0.0): DoubleArray {
        val noise = GaussianNoise(standardDeviation, Random(seed))
        return DoubleArray(count) { noise.step(input) }
    }

    @Test
    fun hasTheMeanAndTheSpreadAskedFor() {
        val draws = draws(COUNT, seed = 11, standardDeviation = 0.02, input = 5.0)
        val mean = draws.average()
        val spread = sqrt(draws.sumOf { (it - mean) * (it - mean) } / COUNT)
        // Standard error of a mean σ/√n, of a standard deviation σ/√(2n); four of them, for one fixed seed.
        assertEquals(5.0, mean, 4 * 0.02 / sqrt(COUNT.toDouble()))
        assertEquals(0.02, spread, 4 * 0.02 / sqrt(2.0 * COUNT))
    }

    @Test
    fun hasTheTailsOfANormalDistribution() {
        val draws = draws(COUNT, seed = 12)
        // Shares within 1, 2 and 3 σ; binomial standard error √(p (1 − p)/n), four of them.
        for ((bound, share) in listOf(1.0 to 0.682689492, 2.0 to 0.954499736, 3.0 to 0.997300204)) {
            val seen = draws.count { abs(it) < bound }.toDouble() / COUNT
            assertEquals(share, seen, 4 * sqrt(share * (1 - share) / COUNT), "within $bound sigma")
        }
    }

    @Test
    fun drawsAreIndependentOfTheOnesBefore() {
        val draws = draws(COUNT, seed = 13)
        // The polar method makes pairs: lag 1 is the partner, lag 2 the next pair. Standard error of r is 1/√n.
        for (lag in 1..3) {
            val correlation = (0 until COUNT - lag).sumOf { draws[it] * draws[it + lag] } / (COUNT - lag)
            assertTrue(abs(correlation) < 4 / sqrt(COUNT.toDouble()), "lag $lag: $correlation")
        }
        // Partners are independent in size too, not merely uncorrelated. E z² = 1, Var(z²) = 2.
        val sizes = (0 until COUNT - 1).sumOf { (draws[it] * draws[it] - 1) * (draws[it + 1] * draws[it + 1] - 1) }
        assertTrue(abs(sizes / (2 * COUNT)) < 4 / sqrt(COUNT.toDouble()) * 2, "${sizes / (2 * COUNT)}")
    }

    @Test
    fun theSameSeedGivesTheSameNoiseAndAnotherSeedAnother() {
        assertTrue(draws(100, seed = 1).contentEquals(draws(100, seed = 1)))
        assertNotEquals(draws(100, seed = 1).toList(), draws(100, seed = 2).toList())
    }

    @Test
    fun doesNotDependOnTheInputOrTheStep() {
        val still = GaussianNoise(0.5, Random(3))
        val moving = GaussianNoise(0.5, Random(3))
        for (i in 0 until 50) {
            val noise = still.step(0.0, 1.0, Conditions.NONE)
            // The sum is rounded at magnitude 64.
            assertEquals(noise, moving.step(64.0, 0.1 * i, Conditions.NONE) - 64.0, 2e-14)
        }
    }

    @Test
    fun noSpreadIsNoNoise() {
        assertTrue(draws(10, seed = 4, standardDeviation = 0.0, input = 3.25).all { it == 3.25 })
    }

    @Test
    fun whatIsNotFinitePassesUnchanged() {
        val noise = GaussianNoise(1.0, Random(5))
        assertTrue(noise.step(Double.NaN).isNaN())
        assertEquals(Double.POSITIVE_INFINITY, noise.step(Double.POSITIVE_INFINITY))
        assertEquals(Double.NEGATIVE_INFINITY, noise.step(Double.NEGATIVE_INFINITY))
        assertTrue(noise.step(1.0).isFinite())
    }

    @Test
    fun impossibleNumbersAreRefusedByName() {
        for (spread in listOf(-0.1, Double.NaN, Double.POSITIVE_INFINITY)) {
            val error = assertFailsWith<IllegalArgumentException> { GaussianNoise(spread, Random(0)) }
            assertEquals("standardDeviation ($spread) must be at least 0 and finite", error.message)
        }
    }

    private companion object {
        const val COUNT = 100_000
    }
}
