package stillwater.diagnose

import org.junit.jupiter.api.Tag
import stillwater.diagnose.reference.ChangingWater
import stillwater.diagnose.response.ReferenceNoise
import kotlin.math.abs
import kotlin.math.cos
import kotlin.math.exp
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.math.tanh
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertIs
import kotlin.test.assertTrue

/** What a reference does not say must not become a cause. */
class ReferenceLimitsTest {
    private val n = 600
    private val random = java.util.Random(11)

    private fun water(time: Double) = 5 + sin(time / 9) + 0.7 * sin(time / 23 + 1)

    @Test
    fun aGapInTheLogIsNoJump() {
        // Steps of a second, and one of five minutes in the middle of which the boat went on.
        val times = DoubleArray(n) { it + if (it >= n / 2) 300.0 else 0.0 }
        var state = water(0.0)
        var now = 0.0
        val values = DoubleArray(n) { row ->
            while (now < times[row] - 1e-9) {
                state += (1 - exp(-0.1 / 12)) * (water(now + 0.05) - state)
                now += 0.1
            }
            state + 0.005 * random.nextGaussian()
        }
        val truth = DoubleArray(n) { water(times[it]) }
        val log = MeasuredSeries(times, DoubleArray(n), DoubleArray(n), values, truth)
        assertEquals(Verdict.Consistent, Diagnosis(log).run().verdict)
    }

    @Test
    fun theNoiseOfAReferenceIsFoundAndMostOfItTakenOff() {
        val times = DoubleArray(n) { it.toDouble() }
        val noisy = DoubleArray(n) { water(times[it]) + 0.05 * random.nextGaussian() }
        val noise = ReferenceNoise(times, noisy, BooleanArray(n))
        // The error of a spread from 600 numbers is 3 %; five of them.
        assertEquals(0.05, noise.spread, 0.0075)
        val smooth = noise.smoothed()
        val left = sqrt((0 until n).sumOf { (smooth[it] - water(times[it])).let { e -> e * e } } / n)
        assertTrue(left < 0.025, "$left")
    }

    @Test
    @Tag("long")
    fun whatIsLeftOfTheNoiseOfAReferenceIsNoResponse() {
        // As noisy as the readings of a sensor that is no later than the water.
        val times = DoubleArray(LONG) { it.toDouble() }
        fun noisy() = DoubleArray(LONG) { 2 * water(times[it]) + 0.05 * random.nextGaussian() }
        val log = MeasuredSeries(times, times, DoubleArray(LONG), noisy(), noisy())
        assertEquals(Verdict.Consistent, Diagnosis(log).run().verdict)
    }

    /** A sensor that steps with the truth, half a step ahead of one that follows it, beside what ends its range. */
    @Test
    fun aTruthHeldOverStepsBesideAnEndOfTheRangeIsNoPlaceAhead() {
        val rows = 900
        val times = DoubleArray(rows) { it.toDouble() }
        var state = water(0.0)
        val values = DoubleArray(rows) { row ->
            state += (1 - exp(-1 / 12.0)) * (water(times[row]) - state)
            minOf(state, 5.0) + 0.02 * random.nextGaussian()
        }
        val x = DoubleArray(rows) { times[it] + 0.2 * random.nextGaussian() }
        val y = DoubleArray(rows) { 0.2 * random.nextGaussian() }
        val reference = DoubleArray(rows) { water(times[it]) + 0.02 * random.nextGaussian() }
        val verdict = Diagnosis(MeasuredSeries(times, x, y, values, reference)).run().verdict
        assertEquals(Verdict.Named(listOf(Cause.SATURATION)), verdict)
    }

    /** A truth that goes from sample to sample at once, on a row, as [shown] by a sensor. */
    private fun bench(shown: (truth: (Double) -> Double) -> DoubleArray): DiagnosisResult {
        val starts = List(n / 57 + 1) { 57.0 * it }
        val levels = List(starts.size) { 2 + 9 * random.nextDouble() }
        fun truth(time: Double) = levels[starts.indexOfLast { it <= time }.coerceAtLeast(0)]
        val times = DoubleArray(n) { it.toDouble() }
        val values = shown(::truth)
        for (i in values.indices) values[i] += 0.02 * random.nextGaussian()
        val reference = DoubleArray(n) { truth(times[it]) + 0.02 * random.nextGaussian() }
        return Diagnosis(MeasuredSeries(times, DoubleArray(n), DoubleArray(n), values, reference)).run()
    }

    @Test
    @Tag("long")
    fun aDelayOfLessThanARowBehindSharpStepsIsNoDeadTime() {
        val result = bench { truth ->
            var state = truth(0.0)
            var shown = state
            DoubleArray(n) { row ->
                if (row > 0) state += (1 - exp(-1 / 8.0)) * (truth(row - 0.5) - state)
                shown = shown.coerceIn(state - 0.15, state + 0.15)
                shown
            }
        }
        assertEquals(Verdict.Named(listOf(Cause.HYSTERESIS)), result.verdict)
        assertTrue(result.warnings.any { "cannot show" in it }, "${result.warnings}")
    }

    @Test
    fun aShiftOfLessThanATenthOfARowIsNamedWithACaution() {
        val times = DoubleArray(LONG) { it.toDouble() }
        val truth = DoubleArray(LONG) { water(times[it]) }
        var state = water(0.0)
        val values = DoubleArray(LONG) { row ->
            if (row > 0) repeat(20) { k -> state += (1 - exp(-0.05 / 8)) * (water(row - 1.035 + 0.05 * k) - state) }
            state + 0.002 * random.nextGaussian()
        }
        val result = Diagnosis(MeasuredSeries(times, DoubleArray(LONG), DoubleArray(LONG), values, truth)).run()
        val ambiguous = assertIs<Verdict.Ambiguous>(result.verdict)
        assertEquals(setOf(Cause.SECOND_ORDER_RESPONSE, Cause.DEAD_TIME), ambiguous.sets.single().toSet())
        assertTrue(result.warnings.any { "is a shift of less than a tenth of a row" in it }, "${result.warnings}")
    }

    /** Rounds of a circle, a little apart, in water that rises by [rise] a second. */
    private fun rounds(rise: Double): ChangingWater {
        val angle = DoubleArray(n) { it / 20.0 }
        val x = DoubleArray(n) { (20 + it / 600.0) * cos(angle[it]) + 0.05 * random.nextGaussian() }
        val y = DoubleArray(n) { (20 + it / 600.0) * sin(angle[it]) + 0.05 * random.nextGaussian() }
        val times = DoubleArray(n) { it.toDouble() }
        val truth = DoubleArray(n) {
            sin((20 + it / 600.0) * cos(angle[it]) / 6) + rise * times[it] + 0.01 * random.nextGaussian()
        }
        return ChangingWater(MeasuredSeries(times, x, y, truth, truth), truth)
    }

    @Test
    fun waterThatChangesShowsWhereATrackFollowsItself() {
        val changed = rounds(0.001)
        assertTrue(changed.pValue < 1e-6, "${changed.pValue}")
        assertEquals(0.001, changed.rate, 3 * changed.error)
        assertTrue(rounds(0.0).pValue > 0.01)
    }

    /** One cast down and up through a thermocline that warms by [rise] a second, seen by a reference late by [late] s. */
    private fun cast(rise: Double, late: Double): ChangingWater {
        val depth = DoubleArray(n) { 30 - abs(30 - 60.0 * it / n) }
        val times = DoubleArray(n) { it / 4.0 }
        fun there(time: Double) = 30 - abs(30 - 60.0 * 4 * time / n)
        val truth = DoubleArray(n) {
            tanh((there(times[it] - late) - 12) / 4) + rise * times[it] + 0.001 * random.nextGaussian()
        }
        return ChangingWater(MeasuredSeries(times, depth, DoubleArray(n), truth, truth), truth)
    }

    @Test
    fun aReferenceThatIsLateOnTheWayDownAndUpIsNoChangeOfTheWater() {
        assertTrue(cast(0.0, 0.4).pValue > 0.01, "${cast(0.0, 0.4).pValue}")
        val changed = cast(0.001, 0.4)
        assertTrue(changed.pValue < 1e-6, "${changed.pValue}")
        assertEquals(0.001, changed.rate, 3 * changed.error)
    }

    @Test
    fun standingStillWhereItStoodBeforeIsOneMeeting() {
        // Two minutes at the surface, down and up, and two minutes there again; one reading of the reference is off.
        val times = DoubleArray(n) { it.toDouble() }
        val depth = DoubleArray(n) { maxOf(0.0, 165 - abs(it - 300.0)) / 4 }
        val truth = DoubleArray(n) { cos(depth[it] / 5) + 0.01 * random.nextGaussian() }
        truth[0] += 0.03
        val water = ChangingWater(MeasuredSeries(times, depth, DoubleArray(n), truth, truth), truth)
        assertTrue(water.pValue > 0.01, "${water.pValue}")
    }

    private companion object {
        /** Rows in which what a short log hides shows. */
        const val LONG = 2000
    }
}
