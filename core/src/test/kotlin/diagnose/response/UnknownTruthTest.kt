package stillwater.diagnose.response

import stillwater.diagnose.MeasuredSeries
import kotlin.math.PI
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** What a reference leaves open between its rows. */
class UnknownTruthTest {
    private val n = 900
    private val times = DoubleArray(n) { it.toDouble() }

    private fun of(truth: (Int) -> Double): UnknownTruth {
        val reference = DoubleArray(n, truth)
        return UnknownTruth.of(MeasuredSeries(times, times, DoubleArray(n), DoubleArray(n), reference))
    }

    private fun rounded(value: Double) = Math.rint(value * 1000) / 1000

    @Test
    fun slowWaterThatIsRoundedIsNotSharp() {
        // It stands still in most rows, and moves by a step of the rounding in others.
        val slow = of { rounded(8 + 0.03 * sin(2 * PI * it / 600)) }
        assertFalse(slow.isSharp || slow.isMostly, "${slow.isBroken.count { it }} rows")
    }

    @Test
    fun samplesThatAreChangedAtOnceAreSharp() {
        val bench = of { rounded(8 + 0.5 * (it / 60 % 4)) }
        assertTrue(bench.isSharp && !bench.isMostly)
    }
}
