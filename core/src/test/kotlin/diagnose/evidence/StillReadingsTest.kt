package stillwater.diagnose.evidence

import org.junit.jupiter.api.Tag
import stillwater.diagnose.Cause
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import stillwater.diagnose.noise.CorrelatedNoise
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Scales
import stillwater.diagnose.response.Steps
import stillwater.sensor.SensorStage
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertIs
import kotlin.test.assertNotNull
import kotlin.test.assertNull
import kotlin.test.assertTrue

/** What the digits of readings say, beside a reference: that a logger hung, and how much of the noise is rounding. */
class StillReadingsTest {
    private val n = 600
    private val truth = DoubleArray(n) { 5 + sin(it / 14.0) + 0.7 * sin(it / 37.0 + 1) }
    private val random = java.util.Random(5)

    private fun readings(noise: () -> Double): DoubleArray {
        var state = truth[0]
        val lagged = DoubleArray(n) { i ->
            if (i > 0) state += (1 - exp(-1 / 8.0)) * (truth[i] - state)
            state
        }
        return DoubleArray(n) { lagged[it] + noise() }
    }

    private fun normal() = readings { 0.01 * random.nextGaussian() }

    private fun diagnosed(values: DoubleArray) =
        Diagnosis(MeasuredSeries(DoubleArray(n) { it.toDouble() }, DoubleArray(n), DoubleArray(n), values, truth)).run()

    private fun rounded(values: DoubleArray, step: Double) = DoubleArray(n) { step * Math.rint(values[it] / step) }

    @Test
    fun readingsThatAreFrozenAreNoJump() {
        val values = normal()
        for (from in listOf(100, 300, 450)) values.fill(values[from], from, from + 15)
        val reason = assertIs<Verdict.Unexplained>(diagnosed(values).verdict).what
        assertContains(reason, "stand still to the last digit for 15 rows, 3 times")
    }

    @Test
    fun singleReadingsThatRepeatTheOneBeforeAreCounted() {
        val values = normal()
        assertNull(StillReadings(fit(values)).repeats())
        assertNull(StillReadings(fit(rounded(values, 0.005))).repeats(), "what rounding repeats")
        for (i in 40 until n step 60) values[i] = values[i - 1]
        assertContains(assertNotNull(StillReadings(fit(values)).repeats()), "10 readings repeat the one before")
        assertTrue(diagnosed(values).warnings.any { "10 readings repeat" in it })
        // A logger that writes each reading twice is none that missed some.
        for (i in 1 until n step 2) values[i] = values[i - 1]
        assertNull(StillReadings(fit(values)).repeats())
    }

    /** A converter whose levels are 0.0133, 0.0134 or 0.0160 apart, with noise as large, as a board of two thermometers has. */
    @Test
    fun levelsThatAreNotAsFarApartAsEachOtherAreNoLoggerThatHung() {
        val steps = doubleArrayOf(0.0133, 0.0134, 0.0133, 0.0160)
        val levels = (0 until 800).runningFold(0.0) { level, i -> level + steps[i % steps.size] }
        for (seed in 1L..5L) {
            val noise = java.util.Random(seed)
            val values = readings { 0.014 * noise.nextGaussian() }
            for (i in values.indices) values[i] = levels.minBy { abs(it - values[i]) }
            val still = StillReadings(fit(values))
            assertNull(still.words(0.05), "seed $seed")
            assertNull(still.repeats(), "seed $seed")
        }
    }

    @Test
    fun oneNumberInThePlaceOfReadingsIsToldThoughItMakesTheNoiseLarge() {
        val values = normal()
        for (from in listOf(100, 300, 450)) values.fill(-9.0, from, from + 8)
        assertContains(assertIs<Verdict.Unexplained>(diagnosed(values).verdict).what, "8 rows, 3 times")
    }

    /** A sonde's own filter shows a new number only now and then, for longer than noise would let it stand still. */
    @Test
    fun anInstrumentThatShowsItsReadingForRowsHasNotHung() {
        val values = rounded(normal(), 0.002)
        for (i in 1 until n) if (random.nextDouble() < 0.6) values[i] = values[i - 1]
        assertNull(StillReadings(fit(values)).words(1e-3))
        values.fill(values[300], 300, 350)
        assertContains(checkNotNull(StillReadings(fit(values)).words(1e-3)), "rows, once")
    }

    /** A range that ends before the noise: some readings beside the end are beyond it, by the noise. */
    @Test
    fun readingsThatStandStillWhereTheRangeEndsAreSaturated() {
        val values = normal()
        val ended = DoubleArray(n) { if (values[it] > 6.2) 6.2 else values[it] }
        ended[ended.indexOfFirst { it == 6.2 } - 1] = 6.21
        assertEquals(Verdict.Named(listOf(Cause.SATURATION)), diagnosed(ended).verdict)
    }

    @Test
    fun standingStillAtBothAnEndAndElsewhereIsNoEnd() {
        val ended = normal().map { minOf(it, 6.2) }.toDoubleArray()
        val fit = fit(ended)
        assertTrue(StillReadings(fit).atEnd < 1e-9, "${StillReadings(fit).atEnd}")
        assertEquals(SensorStage.Range(upper = 6.2), StillReadings(fit).range(1e-3))
        ended.fill(ended[300], 300, 330)
        assertEquals(1.0, StillReadings(fit(ended)).atEnd)
    }

    /** Water that a model has to guess may be too low beside the longest of several stretches at an end. */
    @Test
    fun theLongestOfSeveralStretchesAtAnEndIsThereToo() {
        val ended = normal().map { minOf(it, 6.2) }.toDoubleArray()
        val from = ended.indices.filter { ended[it] == 6.2 && ended[it - 1] != 6.2 }
        val longest = from.map { at -> at until (at until n).first { ended[it] != 6.2 } }.maxBy { it.count() }
        assertTrue(from.size > 2, "$from")
        val still = StillReadings(fit(ended, low = longest))
        assertNull(still.words(1e-3))
        assertEquals(SensorStage.Range(upper = 6.2), still.range(1e-3))
        val once = DoubleArray(n) { if (ended[it] == 6.2 && it !in longest) 6.2 - 1e-3 * (it % 3) else ended[it] }
        assertNotNull(StillReadings(fit(once, low = longest)).words(1e-3))
    }

    /** The true model, without its end, of readings [values]; its water is a unit too low in rows [low]. */
    private fun fit(values: DoubleArray, low: IntRange = IntRange.EMPTY): ModelFit {
        val series = MeasuredSeries(DoubleArray(n) { it.toDouble() }, DoubleArray(n), DoubleArray(n), values, truth)
        val model = ResponseModel(series, emptyList(), Steps.HELD, Scales(series))
        val numbers = doubleArrayOf(8.0, 1.0, 0.0, 0.0)
        val shown = DoubleArray(n).also { model.predict(numbers, it) }
        val left = DoubleArray(n) { values[it] - minOf(shown[it], 6.2) + if (it in low) 1.0 else 0.0 }
        val noise = CorrelatedNoise(series.times, 0.0, 1.0, BooleanArray(n) { true })
        return ModelFit(model, numbers, BooleanArray(4) { true }, noise, left, left, 0.0)
    }

    @Test
    fun readingsThatNeverChangeAreNoEndOfARange() {
        val found = diagnosed(DoubleArray(n) { 8.0 })
        assertContains(assertIs<Verdict.InsufficientData>(found.verdict).why, "the readings never change, though the")
        assertEquals(emptyList(), found.spikes)
        assertEquals(emptyList(), found.warnings)
        assertEquals(emptyList(), found.baseline.parameters)
    }

    @Test
    fun readingsThatAreTheReferenceShowNothing() {
        val found = diagnosed(truth.copyOf())
        assertContains(assertIs<Verdict.InsufficientData>(found.verdict).why, "the same column")
    }

    @Test
    fun readingsThatStandStillOfThemselvesAreNotFrozen() {
        val coarse = diagnosed(rounded(normal(), 0.06))
        assertEquals(Verdict.Named(listOf(Cause.QUANTISATION)), coarse.verdict)
        // Rounding is in the extended sensor once: its noise is that before it.
        val stages = assertNotNull(coarse.extendedSensor).stages
        assertEquals(0.06, stages.filterIsInstance<SensorStage.Quantum>().single().step, 1e-9)
        assertEquals(0.01, stages.filterIsInstance<SensorStage.Noise>().single().standardDeviation, 0.005)
        val ended = diagnosed(normal().map { minOf(it, 6.2) }.toDoubleArray())
        assertEquals(Verdict.Named(listOf(Cause.SATURATION)), ended.verdict)
        val repeated = normal()
        val held = diagnosed(DoubleArray(n) { repeated[it - it % 5] }).verdict
        assertFalse(held is Verdict.Unexplained && "stand still" in held.what, "$held")
    }

    @Test
    fun roundingIsNamedByItsPartOfTheNoise() {
        assertEquals(Verdict.Named(listOf(Cause.QUANTISATION)), diagnosed(rounded(normal(), 0.025)).verdict)
        assertEquals(Verdict.Consistent, diagnosed(rounded(normal(), 0.01)).verdict)
    }

    @Test
    @Tag("long")
    fun noiseWithTailsInAShortLogIsNoOutlier() {
        val named = (1..12).count {
            val verdict = diagnosed(
                readings {
                    0.01 * random.nextGaussian() / sqrt(List(5) { random.nextGaussian() }.sumOf { it * it } / 5)
                },
            ).verdict
            verdict != Verdict.Consistent
        }
        assertTrue(named <= 1, "$named of 12 logs without an effect")
    }
}
