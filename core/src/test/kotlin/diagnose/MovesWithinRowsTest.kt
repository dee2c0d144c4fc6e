package stillwater.diagnose

import org.junit.jupiter.api.Tag
import kotlin.math.exp
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertIs

/** A bench whose samples are changed at moments anywhere between two rows, each another one, of a lag of two rows. */
class MovesWithinRowsTest {
    /** Readings that drift by [drift], of the noise's deviation, over the log. */
    private fun bench(seed: Long, drift: Double): MeasuredSeries {
        val random = java.util.Random(seed)
        var state = LOW
        var sample = LOW
        var moment = 40 + 50 * random.nextDouble()
        val truth = DoubleArray(ROWS)
        val readings = DoubleArray(ROWS)
        for (row in 0 until ROWS) {
            truth[row] = sample
            readings[row] = state + NOISE * (random.nextGaussian() + drift * row / ROWS)
            for (step in 0 until FINE) {
                if (row + step / FINE.toDouble() >= moment) {
                    sample = if (sample == LOW) HIGH else LOW
                    moment += 15 + 40 * random.nextDouble()
                }
                state += (1 - exp(-1.0 / FINE / LAG)) * (sample - state)
            }
        }
        val still = DoubleArray(ROWS)
        return MeasuredSeries(DoubleArray(ROWS) { it.toDouble() }, still, still, readings, truth)
    }

    /** The moments themselves shake readings by up to ten times their noise, each in its own row. */
    @Test
    fun aLagAloneIsConsistent() {
        for (seed in 1L..2L) {
            val result = Diagnosis(bench(seed, 0.0)).run()
            assertIs<Verdict.Consistent>(result.verdict, "seed $seed")
            assertEquals(LAG, result.baseline.parameters.first().value, 0.03, "seed $seed")
        }
    }

    @Test
    @Tag("long")
    fun soItIsWithOtherMoments() {
        for (seed in 3L..10L) assertIs<Verdict.Consistent>(Diagnosis(bench(seed, 0.0)).run().verdict, "seed $seed")
    }

    @Test
    fun aDriftOfTwoDeviationsOfTheNoiseIsNamed() {
        val result = Diagnosis(bench(11, 2.0)).run()
        assertEquals(Verdict.Named(listOf(Cause.DRIFT)), result.verdict)
        val rate = result.effects.single().parameters.first { it.name == "rate_per_s" }.value
        assertEquals(2 * NOISE / ROWS, rate, 0.15 * 2 * NOISE / ROWS)
    }

    private companion object {
        const val ROWS = 1300
        const val FINE = 20
        const val LAG = 2.0
        const val LOW = 4.6
        const val HIGH = 6.9
        const val NOISE = 0.03
    }
}
