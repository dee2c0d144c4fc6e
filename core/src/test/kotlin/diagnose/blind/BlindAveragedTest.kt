package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import java.util.Random
import kotlin.math.exp
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Without a reference an instrument that averages is told, and no delay is named for it. Seeds fixed before the first run. */
class BlindAveragedTest {
    /** Legs of 100 s to and fro, 4 m apart, over smooth water, by a lag of 6 s whose noisy readings are averaged over [over] rows. */
    private fun survey(over: Int, seed: Long): MeasuredSeries {
        val random = Random(seed)
        val rows = 1200
        val x = DoubleArray(rows) { row -> (row % 200).let { if (it < 100) it else 200 - it }.toDouble() }
        val y = DoubleArray(rows) { 4.0 * (it / 100) }
        var state = Double.NaN
        val noisy = DoubleArray(rows) { row ->
            val water = 8 + sin(x[row] / 12 + seed) + sin(y[row] / 15) + 0.5 * sin((x[row] - y[row]) / 17)
            state = if (state.isNaN()) water else state + (1 - exp(-1 / 6.0)) * (water - state)
            state + 0.03 * random.nextGaussian()
        }
        val values = DoubleArray(rows) { row ->
            (maxOf(row - over + 1, 0)..row).sumOf { noisy[it] } /
                minOf(over, row + 1)
        }
        return MeasuredSeries(DoubleArray(rows) { it.toDouble() }, x, y, values, null)
    }

    @Test
    fun itIsToldAndNoDelayIsNamed() {
        for (seed in 4101L..4103L) {
            val result = Diagnosis(survey(over = 13, seed)).run()
            // Once, in the answer or beside it.
            val told = result.warnings + listOfNotNull((result.verdict as? Verdict.Unexplained)?.what)
            assertEquals(1, told.count { "averages over 13.0 s" in it }, "seed $seed: ${result.verdict}")
            val named = (result.verdict as? Verdict.Named)?.causes.orEmpty()
            assertTrue(named.none { it == Cause.DEAD_TIME || it == Cause.SECOND_ORDER_RESPONSE }, "seed $seed: $named")
        }
    }

    @Test
    fun independentNoiseIsNone() {
        for (seed in 4104L..4106L) {
            val result = Diagnosis(survey(over = 1, seed)).run()
            assertTrue("averages" !in result.warnings.joinToString(), "seed $seed")
        }
    }
}
