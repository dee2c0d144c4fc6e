package stillwater.diagnose

import kotlin.math.PI
import kotlin.math.exp
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertIs
import kotlin.test.assertTrue

/** Logs as a laboratory makes them: a probe moved between samples, or a reference that is an instrument itself. */
class BenchTest {
    private val random = java.util.Random(20260917)
    private val n = 500

    /** Samples of [hold] s and more, changed at any instant. */
    private fun samples(hold: Double): (Double) -> Double {
        val levels = doubleArrayOf(0.2, 2.5, 5.0, 8.2, 11.5)
        val starts = ArrayList<Double>().also { it += 0.0 }
        while (starts.last() < 2 * n) starts += starts.last() + hold * (1 + 0.2 * random.nextDouble())
        return { time -> levels[(3 * starts.indexOfLast { it <= maxOf(time, 0.0) }) % levels.size] }
    }

    /** What a lag of [lag] s shows of [truth] each second, [late] s later, without noise. */
    private fun lagged(truth: (Double) -> Double, lag: Double, late: Double = 0.0): DoubleArray {
        val per = 20
        var state = truth(-late)
        return DoubleArray(n) { row ->
            if (row > 0) {
                for (k in 0 until per) {
                    state += (1 - exp(-1.0 / per / lag)) * (truth(row - 1 + (k + 0.5) / per - late) - state)
                }
            }
            state
        }
    }

    private fun noisy(column: DoubleArray, spread: Double) =
        DoubleArray(column.size) { column[it] + spread * random.nextGaussian() }

    private fun log(values: DoubleArray, reference: DoubleArray) =
        MeasuredSeries(DoubleArray(n) { it.toDouble() }, DoubleArray(n), DoubleArray(n), values, reference)

    @Test
    fun aDeadTimeOfSeveralRowsBehindSharpStepsMakesNoJumps() {
        val truth = samples(hold = 50.0)
        val values = noisy(lagged(truth, 8.0, late = 7.0), 0.015)
        val result = Diagnosis(log(values, DoubleArray(n) { truth(it.toDouble()) })).run()
        assertTrue((result.verdict as? Verdict.Named)?.causes.orEmpty().all { it == Cause.DEAD_TIME }, "${result.verdict}")
        val numbers = result.candidates.first { it.cause == Cause.DEAD_TIME }.parameters
        val interval = checkNotNull(numbers.first { it.name == "dead_time_s" }.interval)
        assertTrue(7.0 in interval.lower..interval.upper, "$interval")
    }

    @Test
    fun aReferenceThatIsLateIsToldWhereTheTruthMovesThrice() {
        val truth = samples(hold = 140.0)
        val reference = DoubleArray(n) { truth(it - 3.5) }
        val result = Diagnosis(log(noisy(lagged(truth, 12.0), 0.1), reference)).run()
        assertContains(assertIs<Verdict.Unexplained>(result.verdict).what, "ahead of the reference")
    }

    @Test
    fun aReferenceWithALagOfItsOwnMakesNoSecondPath() {
        val water = { time: Double -> 6 + sin(time / 9) + 0.7 * sin(time / 23 + 1) }
        val result = Diagnosis(log(noisy(lagged(water, 12.0), 0.015), noisy(lagged(water, 4.0), 0.003))).run()
        assertContains(assertIs<Verdict.Unexplained>(result.verdict).what, "a lag of its own, of about 4")
    }

    @Test
    fun wildReadingsBesideNoiseThatWandersAreNoBubbles() {
        val water = { time: Double -> 6 + sin(time / 9) + 0.7 * sin(time / 23 + 1) }
        var wander = 0.0
        val values = lagged(water, 8.0)
        for (i in values.indices) {
            wander = 0.6 * wander + 0.016 * random.nextGaussian()
            values[i] += wander + 0.002 * random.nextGaussian()
            if (i % 40 == 17) values[i] += 3.0 + random.nextDouble()
        }
        val result = Diagnosis(log(values, DoubleArray(n) { water(it.toDouble()) })).run()
        assertEquals(Verdict.Named(listOf(Cause.OUTLIERS)), result.verdict)
    }

    @Test
    fun aTruthThatNeverMovesShowsNoLag() {
        val result = Diagnosis(log(noisy(DoubleArray(n) { 8.2 }, 0.015), DoubleArray(n) { 8.2 })).run()
        assertIs<Verdict.InsufficientData>(result.verdict)
    }

    @Test
    fun aTruthThatStandsStillIsNotInDoubt() {
        // A cubic through numbers that are no sums of powers of two is off by errors of arithmetic.
        val truth = DoubleArray(n) { if (it < n / 2) 9.1 else 0.3 }
        val unknown = UnknownTruth.of(log(truth, truth))
        assertTrue(unknown.isInDoubt(n / 2))
        assertFalse((10 until n / 2 - 10).any(unknown::isInDoubt))
    }

    @Test
    fun whatIsInDoubtIsSeenAsMuchLaterAsTheReadingsAre() {
        val truth = DoubleArray(n) { if (it < n / 2) 9.1 else 0.3 }
        val seen = UnknownTruth.of(log(truth, truth)).seen(20.0)
        assertTrue(seen.isInDoubt(n / 2 + 20))
        assertFalse(seen.isInDoubt(n / 2))
    }

    @Test
    fun twoLagsThatAreAlikeHaveNoIntervalOfManyPowersOfTen() {
        val water = { time: Double -> 6 + sin(2 * PI * time / 60) + 0.7 * sin(2 * PI * time / 140 + 1) }
        val values = noisy(lagged(water, 6.0, late = 9.0), 0.015)
        val result = Diagnosis(log(values, DoubleArray(n) { water(it.toDouble()) })).run()
        val numbers = result.candidates.flatMap { it.parameters }.filter { it.name.endsWith("time_constant_s") }
        assertTrue(numbers.mapNotNull { it.interval }.all { it.upper < 1e4 * it.lower }, "$numbers")
    }
}
