package stillwater.diagnose.response

import stillwater.diagnose.MeasuredSeries
import kotlin.math.PI
import kotlin.math.exp
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertNotNull
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

    /** By row, how far a step of one between rows 449 and 450 shakes readings of a lag of two rows, in deviations of their noise. */
    private fun shaken(delay: Double = 0.0, second: Double = 0.0): Map<Int, Double> {
        val unknown = of { if (it < n / 2) 0.0 else 1.0 }
        val sensor = Shaken(DoubleArray(n) { 2.0 }, 1.0, isHeld = false, delay, second)
        val variance = assertNotNull(unknown.shocks(sensor, 0.01, Doubt())).variance
        return variance.indices.filter { variance[it] > 0 }.associateWith { sqrt(variance[it]) }
    }

    @Test
    fun aSharpStepIsInDoubtInItsOwnRowAlone() {
        assertEquals(setOf(n / 2), shaken().keys)
        // Half a step, as far as a lag of two rows follows it within one.
        assertEquals(50 * (1 - exp(-0.5)), shaken().getValue(n / 2), 0.5)
    }

    @Test
    fun afterADelayItIsInTheTwoRowsThatTheStepMayArriveIn() {
        val whole = shaken().getValue(n / 2)
        assertEquals(mapOf(n / 2 + 3 to whole), shaken(delay = 3.0))
        val parted = shaken(delay = 3.25)
        assertEquals(setOf(n / 2 + 3, n / 2 + 4), parted.keys)
        assertEquals(0.75 * whole, parted.getValue(n / 2 + 3), 1e-9)
        assertEquals(0.25 * whole, parted.getValue(n / 2 + 4), 1e-9)
    }

    @Test
    fun fromASecondLagItGoesOnToArrive() {
        val shaken = shaken(second = 4.0)
        assertEquals(exp(-0.25), shaken.getValue(n / 2 + 3) / shaken.getValue(n / 2 + 2), 1e-9)
    }
}
