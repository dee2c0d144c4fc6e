package stillwater.diagnose.evidence

import stillwater.diagnose.Cause
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.DiagnosisResult
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import java.util.Random
import kotlin.math.exp
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertIs
import kotlin.test.assertTrue

class UnevenNoiseTest {
    private val n = 1500
    private val times = DoubleArray(n) { it + 0.2 * (it % 3) }

    /** Water from 0 to 10. */
    private val truth = DoubleArray(n) { 5 + 3 * sin(times[it] / 90) + 2 * sin(times[it] / 31 + 1) }

    /** A lag of 8 s with noise of 0.02 times [factor] of the row, of which [draw] is one of unit variance. */
    private fun diagnosed(
        change: (Int) -> Double = { 0.0 },
        draw: Random.() -> Double = Random::nextGaussian,
        factor: (Int) -> Double,
    ): DiagnosisResult {
        val random = Random(SEED)
        var shown = truth[0]
        val values = DoubleArray(n) { i ->
            if (i > 0) shown = truth[i] + (shown - truth[i]) * exp(-(times[i] - times[i - 1]) / 8)
            shown + 0.02 * factor(i) * random.draw() + change(i)
        }
        return Diagnosis(MeasuredSeries(times, DoubleArray(n), DoubleArray(n), values, truth)).run()
    }

    @Test
    fun noiseThatGoesWithTheValueIsUnexplained() {
        val verdict = assertIs<Verdict.Unexplained>(diagnosed { 1 + 2 * truth[it] / 10 }.verdict, "seed $SEED")
        assertContains(verdict.what, "the noise goes with the value")
        assertContains(verdict.what, "as much where it is high as where it is low")
    }

    @Test
    fun noiseThatShrinksWithTimeIsUnexplained() {
        val verdict = assertIs<Verdict.Unexplained>(diagnosed { 3 - 2.0 * it / n }.verdict, "seed $SEED")
        assertContains(verdict.what, "the noise goes with the time")
        assertContains(verdict.what, "as much early as late in the log")
    }

    @Test
    fun noiseThatIsLargerForAWhileIsUnexplained() {
        val result = diagnosed { if (it in 600..800) 4.0 else 1.0 }
        val verdict = assertIs<Verdict.Unexplained>(result.verdict, "seed $SEED")
        assertContains(verdict.what, "the noise comes and goes: readings scatter")
    }

    /** Student's t of three degrees of freedom has wilder readings than any probe. */
    @Test
    fun evenNoiseIsConsistentHoweverHeavyItsTails() {
        val tailed: Random.() -> Double = {
            nextGaussian() / sqrt(List(3) { nextGaussian() }.sumOf { it * it } / 3) / sqrt(3.0)
        }
        assertEquals(Verdict.Consistent, diagnosed { 1.0 }.verdict, "seed $SEED")
        assertTrue(diagnosed(draw = tailed) { 1.0 }.verdict !is Verdict.Unexplained, "seed $SEED")
    }

    @Test
    fun besideACauseItIsTold() {
        val result = diagnosed({ 1e-4 * times[it] }) { 1 + 2 * truth[it] / 10 }
        assertIs<Verdict.Named>(result.verdict, "seed $SEED")
        assertTrue(result.warnings.any { "Beside what was named the noise goes with the value" in it }, "seed $SEED")
    }

    /** Readings that stand still at an end, behind the noise, scatter less there than anywhere. */
    @Test
    fun anEndOfTheRangeMakesNoiseNoneTheLessEven() {
        val random = Random(SEED)
        var shown = truth[0]
        val values = DoubleArray(n) { i ->
            if (i > 0) shown = truth[i] + (shown - truth[i]) * exp(-(times[i] - times[i - 1]) / 8)
            minOf(shown + 0.02 * random.nextGaussian(), 7.0)
        }
        val result = Diagnosis(MeasuredSeries(times, DoubleArray(n), DoubleArray(n), values, truth)).run()
        assertEquals(listOf(Cause.SATURATION), assertIs<Verdict.Named>(result.verdict, "seed $SEED").causes)
        assertTrue(result.warnings.none { "the noise goes with" in it }, "${result.warnings}, seed $SEED")
    }

    private companion object {
        const val SEED = 20_271L
    }
}
