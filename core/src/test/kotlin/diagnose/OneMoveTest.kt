package stillwater.diagnose

import stillwater.diagnose.evidence.AnyResponse
import kotlin.math.exp
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertIs
import kotlin.test.assertTrue

/** A probe dunked once: all that the log has of the response is how it follows one step. */
class OneMoveTest {
    /**
     * A probe whose foil oxygen diffuses into, as a thick one's does (Crank 1975, equation 4.18: a sum of lags whose time
     * constants are the first one over the squares of odd numbers), and a fast reference that takes some rows.
     */
    private fun dunked(seed: Long): MeasuredSeries {
        val random = java.util.Random(seed)
        val truth = DoubleArray(ROWS) { row ->
            val after = row - MOVED
            70 + (if (after < 0) 0.0 else 24.5 * (1 - 0.45 * exp(-after / 1.6))) + 0.03 * random.nextGaussian()
        }
        val readings = DoubleArray(ROWS) { row ->
            val after = row - MOVED + 0.4
            val odd = 1..9 step 2
            val left = odd.sumOf { exp(-after * it * it / SLOWEST) / (it * it) } / odd.sumOf { 1.0 / (it * it) }
            70 + (if (after < 0) 0.0 else 24.5 * (1 - left)) + 0.02 * random.nextGaussian()
        }
        val still = DoubleArray(ROWS)
        return MeasuredSeries(DoubleArray(ROWS) { it.toDouble() }, still, still, readings, truth)
    }

    @Test
    fun anotherShapeOfResponseIsNoEndOfTheRangeNorAJump() {
        for (seed in 1L..3L) {
            val result = Diagnosis(dunked(seed)).run()
            val named = (result.verdict as? Verdict.Named)?.causes.orEmpty()
            assertEquals(emptySet(), named.toSet() intersect CONFUSED, "seed $seed: ${result.verdict}")
            val gain = result.extended?.parameters?.firstOrNull { it.name == "gain" }?.value ?: 1.0
            assertTrue(gain > 0, "gain $gain, seed $seed")
        }
    }

    /** What a response cannot do is named all the same: a jump long after the step. */
    @Test
    fun aJumpLongAfterTheStepIsNamed() {
        val random = java.util.Random(4)
        var state = 70.0
        val truth = DoubleArray(4 * ROWS) { if (it < MOVED) 70.0 else 94.5 }
        val readings = DoubleArray(4 * ROWS) { row ->
            state += (1 - exp(-1 / 8.0)) * (truth[row] - state)
            state + (if (row < 3 * ROWS) 0.0 else 0.4) + 0.02 * random.nextGaussian()
        }
        val still = DoubleArray(4 * ROWS)
        val log = MeasuredSeries(DoubleArray(4 * ROWS) { it.toDouble() }, still, still, readings, truth)
        assertEquals(listOf(Cause.OFFSET_STEPS), assertIs<Verdict.Named>(Diagnosis(log).run().verdict).causes)
    }

    @Test
    fun aReferenceThatGoesUpOnceOrThereAndBackHardlyTurns() {
        fun hardlyTurns(truth: (Int) -> Double): Boolean {
            val reference = DoubleArray(ROWS, truth)
            val still = DoubleArray(ROWS)
            val times = DoubleArray(ROWS) { it.toDouble() }
            return AnyResponse.hardlyTurns(MeasuredSeries(times, still, still, still, reference))
        }
        assertTrue(hardlyTurns { if (it < MOVED) 70.0 else 94.5 })
        assertTrue(hardlyTurns { -it.toDouble() + 0.3 * sin(it.toDouble()) })
        assertTrue(hardlyTurns { if (it < ROWS / 2) it.toDouble() else ROWS - it.toDouble() })
        assertFalse(hardlyTurns { sin(it / 5.0) })
    }

    private companion object {
        const val ROWS = 80
        const val MOVED = 12
        const val SLOWEST = 30.0
        val CONFUSED = setOf(
            Cause.SATURATION,
            Cause.OFFSET_STEPS,
            Cause.HYSTERESIS,
            Cause.DRIFT,
            Cause.ASYMMETRIC_RESPONSE,
        )
    }
}
