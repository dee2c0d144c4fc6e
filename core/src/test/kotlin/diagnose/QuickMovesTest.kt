package stillwater.diagnose

import org.junit.jupiter.api.Tag
import kotlin.math.abs
import kotlin.math.ceil
import kotlin.math.exp
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertIs
import kotlin.test.assertTrue

/** A bench where samples change at once every eight rows or so: more often than in one row of twelve. */
class QuickMovesTest {
    /** A lag of [falling] s where readings fall and 2.5 s where they rise; samples change so much of a row before it, by [moment]. */
    private fun bench(seed: Long, falling: Double, moment: (java.util.Random) -> Double): MeasuredSeries {
        val random = java.util.Random(seed)
        var sample = 10 * random.nextDouble()
        var next = sample
        var state = sample
        var change = STAY.toDouble()
        val truth = DoubleArray(ROWS)
        val readings = DoubleArray(ROWS)
        for (step in 0 until ROWS * FINE) {
            val time = (step + 1) / FINE.toDouble()
            if (time > change) {
                while (abs(next - sample) < 1) next = 10 * random.nextDouble()
                sample = next
                change += STAY - 2 + random.nextInt(5)
                change = ceil(change) - moment(random)
            }
            val lag = if (sample > state) 2.5 else falling
            state += (1 - exp(-1 / (FINE * lag))) * (sample - state)
            if (step % FINE == FINE - 1) {
                truth[step / FINE] = sample + 0.003 * random.nextGaussian()
                readings[step / FINE] = 0.97 * state + 0.1 + 0.01 * random.nextGaussian()
            }
        }
        val still = DoubleArray(ROWS)
        return MeasuredSeries(DoubleArray(ROWS) { it + 1.0 }, still, still, readings, truth)
    }

    @Test
    fun aCauseShowsWhereSamplesChangeJustAtRows() {
        val result = Diagnosis(bench(1, 4.5) { 1.0 }).run()
        assertEquals(listOf(Cause.ASYMMETRIC_RESPONSE), assertIs<Verdict.Named>(result.verdict).causes)
    }

    @Test
    @Tag("long")
    fun itShowsAtAnyMomentOfARow() {
        for (seed in 2L..4L) {
            val verdict = Diagnosis(bench(seed, 4.5) { it.nextDouble() }).run().verdict
            val isRight = verdict is Verdict.Named && verdict.causes == listOf(Cause.ASYMMETRIC_RESPONSE)
            assertTrue(isRight || verdict is Verdict.InsufficientData, "seed $seed: $verdict")
        }
    }

    @Test
    @Tag("long")
    fun momentsAreNoCause() {
        for (seed in 5L..8L) {
            val verdict = Diagnosis(bench(seed, 2.5) { it.nextDouble() }).run().verdict
            assertTrue(verdict is Verdict.Consistent || verdict is Verdict.InsufficientData, "seed $seed: $verdict")
        }
    }

    private companion object {
        const val STAY = 8
        const val ROWS = 1200
        const val FINE = 20
    }
}
