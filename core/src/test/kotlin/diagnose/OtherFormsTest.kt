package stillwater.diagnose

import org.junit.jupiter.api.Tag
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.concurrent.thread
import kotlin.math.exp
import kotlin.math.round
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertIs

/**
 * Effects as others would simulate them: quantities measured with noise of their own, limits to the lag's own rate,
 * disturbances that come and go. Seeds are fixed, the cases no tuned ones.
 */
class OtherFormsTest {
    private val n = 1200
    private val times = DoubleArray(n) { it.toDouble() }

    private fun water(time: Double) = 8 + 1.2 * sin(time / 11) + 0.9 * sin(time / 27 + 1) + 0.5 * sin(time / 70 + 2)

    private fun warmth(time: Double) = 18 + 1.5 * sin(time / 160) + 0.3 * sin(time / 31)

    private fun shown(vararg stages: SensorStage): DoubleArray {
        val sensor = SensorSpec("", stages.toList()).build(water(0.0), kotlin.random.Random(1))
        return DoubleArray(n) { row ->
            var value = sensor.step(water(row.toDouble()), 0.0, Conditions.NONE)
            if (row > 0) {
                repeat(20) { k -> value = sensor.step(water(row - 1 + (k + 0.5) / 20), 0.05, Conditions.NONE) }
            }
            value
        }
    }

    private fun diagnosed(
        values: DoubleArray,
        conditions: Map<String, DoubleArray> = emptyMap(),
        given: List<SensorStage>? = null,
    ): DiagnosisResult {
        val reference = DoubleArray(n) { water(times[it]) }
        val settings = DiagnosisSettings(base = given?.let { SensorSpec("given", it) })
        return Diagnosis(MeasuredSeries(times, times, DoubleArray(n), values, reference, conditions), settings).run()
    }

    /** White and wandering noise, half each: under such a base's noise what goes from row to row counts most. */
    private fun noise(random: java.util.Random, spread: Double): DoubleArray {
        var slow = random.nextGaussian()
        return DoubleArray(n) {
            slow = 0.8 * slow + 0.6 * random.nextGaussian()
            0.7 * spread * (slow + random.nextGaussian())
        }
    }

    /** Seeds fixed before the first run. */
    @Test
    fun aDeadBandOfTheWaterIsToldFromOneOfWhatTheLagShows() {
        val band = SensorStage.Backlash(0.3)
        val lag = SensorStage.Lag(9.0)
        for ((seed, stages) in mapOf(20261221L to listOf(band, lag), 20261222L to listOf(lag, band))) {
            val added = noise(java.util.Random(seed), 0.02)
            val clean = shown(*stages.toTypedArray())
            val values = DoubleArray(n) { clean[it] + added[it] }
            val result = diagnosed(values)
            assertEquals(Verdict.Named(listOf(Cause.HYSTERESIS)), result.verdict, "seed $seed")
            val numbers = checkNotNull(result.extended).parameters.associate { it.name to it.value }
            assertEquals(0.3, numbers.getValue("width"), 0.03, "seed $seed: $numbers")
            assertEquals(9.0, numbers.getValue("time_constant_s"), 0.3, "seed $seed: $numbers")
            val kinds = stages.map { it::class }
            val found = checkNotNull(result.extendedSensor).stages.map { it::class }.filter { it in kinds }
            assertEquals(kinds, found, "seed $seed")
            assertEquals(Verdict.Consistent, diagnosed(values, given = stages).verdict, "seed $seed, given")
        }
    }

    @Test
    fun aCrossSensitivityToAQuantityWithNoiseOfItsOwnIsNamedAloneWithItsNumber() {
        for (seed in 1L..2L) {
            val random = java.util.Random(seed)
            val values = shown(SensorStage.Lag(6.0))
            val added = noise(random, 0.01)
            for (i in 0 until n) values[i] += 0.5 * (warmth(times[i]) - 18) + added[i]
            // A thermometer's noise, and one that shows tenths.
            for (step in listOf(0.001, 0.1)) {
                val measured =
                    DoubleArray(n) { round((warmth(times[it]) + 0.01 * random.nextGaussian()) / step) * step }
                val result = diagnosed(values, mapOf(Conditions.TEMPERATURE to measured))
                assertEquals(Verdict.Named(listOf(Cause.CROSS_SENSITIVITY)), result.verdict, "seed $seed, step $step")
                val number = result.effects.single().parameters.first { "coefficient" in it.name }.value
                // The interval of 95 % is of some 0.003.
                assertEquals(0.5, number, 0.02, "seed $seed, step $step")
            }
        }
    }

    @Test
    fun aGivenCrossSensitivityThatIsRightIsNotNamedForTheNoiseOfItsQuantity() {
        val random = java.util.Random(5)
        val values = shown(SensorStage.Lag(6.0))
        for (i in 0 until n) values[i] += 0.5 * (warmth(times[i]) - 18) + 0.01 * random.nextGaussian()
        val measured = DoubleArray(n) { round(warmth(times[it]) / 0.1) * 0.1 }
        val given = listOf(SensorStage.Lag(6.0), SensorStage.Cross(Conditions.TEMPERATURE, 18.0, 0.5))
        assertEquals(Verdict.Consistent, diagnosed(values, mapOf(Conditions.TEMPERATURE to measured), given).verdict)
    }

    @Test
    fun aGivenDeadTimeThatIsNotThereIsNamed() {
        val random = java.util.Random(6)
        val values = shown(SensorStage.Lag(8.0))
        for (i in 0 until n) values[i] += 0.01 * random.nextGaussian()
        val verdict = diagnosed(values, given = listOf(SensorStage.Delay(2.0), SensorStage.Lag(8.0))).verdict
        assertEquals(Verdict.Named(listOf(Cause.DEAD_TIME)), verdict)
    }

    @Test
    fun trialsOnTwoThreadsComeToTheSameBits() {
        val random = java.util.Random(7)
        val values = shown(SensorStage.LimitedLag(8.0, 0.06))
        for (i in 0 until n) values[i] += 0.5 * (warmth(times[i]) - 18) + 0.01 * random.nextGaussian()
        val warm = mapOf(Conditions.TEMPERATURE to DoubleArray(n) { warmth(times[it]) })
        val series = MeasuredSeries(times, times, DoubleArray(n), values, DoubleArray(n) { water(times[it]) }, warm)
        val atOnce = Loops { count, task ->
            val odd = thread { for (i in 1 until count step 2) task(i) }
            for (i in 0 until count step 2) task(i)
            odd.join()
        }
        val one = Diagnosis(series).run()
        val other = Diagnosis(series, DiagnosisSettings(), atOnce).run()
        assertEquals(one.verdict, other.verdict)
        assertEquals(one.candidates.map { it.pValue }, other.candidates.map { it.pValue })
        assertEquals(one.extendedSensor, other.extendedSensor)
    }

    @Test
    @Tag("long")
    fun aLagWhoseOwnRateIsLimitedIsASlewLimitAlone() {
        for (seed in 1L..2L) {
            val random = java.util.Random(seed)
            val values = shown(SensorStage.LimitedLag(8.0, 0.06))
            for (i in 0 until n) values[i] += 0.005 * random.nextGaussian()
            val result = diagnosed(values)
            assertEquals(Verdict.Named(listOf(Cause.SLEW_LIMIT)), result.verdict, "seed $seed")
            val stages = checkNotNull(result.extendedSensor).stages
            val lag = assertIs<SensorStage.LimitedLag>(stages.first(), "seed $seed")
            // Within the row in which the limit begins to act nothing is known of it.
            assertEquals(8.0, lag.timeConstant, 0.2, "seed $seed")
            assertEquals(0.06, lag.rate, 0.002, "seed $seed")
        }
    }

    @Test
    fun aLimitBehindTheLagIsStillOne() {
        val random = java.util.Random(4)
        val values = shown(SensorStage.Lag(8.0), SensorStage.Slew(0.06))
        for (i in 0 until n) values[i] += 0.005 * random.nextGaussian()
        val result = diagnosed(values)
        assertEquals(Verdict.Named(listOf(Cause.SLEW_LIMIT)), result.verdict)
        assertEquals(
            listOf(SensorStage.Lag::class, SensorStage.Slew::class),
            checkNotNull(result.extendedSensor).stages.take(2).map { it::class },
        )
    }

    @Test
    fun dipsThatComeAndFadeAreUnexplained() {
        for (seed in 1L..2L) {
            val random = java.util.Random(seed)
            val values = shown(SensorStage.Lag(8.0))
            val added = noise(random, 0.01)
            val begins = List(4) { n * (it + 0.2 + 0.6 * random.nextDouble()) / 4 }
            for (i in 0 until n) {
                values[i] += added[i]
                for (at in begins) if (times[i] >= at) values[i] -= 0.4 * exp(-(times[i] - at) / 40)
            }
            val verdict = assertIs<Verdict.Unexplained>(diagnosed(values).verdict, "seed $seed")
            assertContains(verdict.what, Regex("comes and goes|come back|time"), "seed $seed")
        }
    }
}
