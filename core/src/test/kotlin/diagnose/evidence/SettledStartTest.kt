package stillwater.diagnose.evidence

import stillwater.diagnose.Diagnosis
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import java.util.Random
import kotlin.math.exp
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertIs

/** A sensor that is let down into the water from the air, far from anything that the water is. */
class SettledStartTest {
    private val n = 1200
    private val times = DoubleArray(n) { 2.0 * it }
    private val truth = DoubleArray(n) { 8 + sin(times[it] / 60) + 0.7 * sin(times[it] / 23 + 1) }

    /** What a lag of 20 s shows that grows by [growth] over the log, begun at [first]. */
    private fun verdict(growth: Double, first: Double): Verdict {
        val random = Random(SEED)
        var shown = first
        val values = DoubleArray(n) { i ->
            // Fine steps, since the lag changes all the time.
            for (k in 1..STEPS) {
                val at = i + k.toDouble() / STEPS
                val tau = 20 * exp(growth * (at / n - 0.5))
                val now = truth[i] + (truth[minOf(i + 1, n - 1)] - truth[i]) * (k - 0.5) / STEPS
                if (i < n - 1) shown = now + (shown - now) * exp(-2.0 / STEPS / tau)
            }
            shown
        }
        val noisy = DoubleArray(n) { (if (it == 0) first else values[it - 1]) + 0.005 * random.nextGaussian() }
        return Diagnosis(MeasuredSeries(times, DoubleArray(n), DoubleArray(n), noisy, truth)).run().verdict
    }

    @Test
    fun aLagThatGrowsIsToldWhereverTheSensorBegan() {
        for (first in listOf(truth[0], 20.0)) {
            val verdict = assertIs<Verdict.Unexplained>(verdict(0.25, first), "begun at $first, seed $SEED")
            assertContains(verdict.what, "the rate of change, more at some times than at others")
        }
    }

    @Test
    fun aLagThatStaysIsConsistent() = assertEquals(Verdict.Consistent, verdict(0.0, 20.0), "seed $SEED")

    private companion object {
        const val SEED = 20_272L
        const val STEPS = 20
    }
}
