package stillwater.diagnose

import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.PI
import kotlin.math.atan
import kotlin.math.exp
import kotlin.math.hypot
import kotlin.math.pow
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertIs

/** Effects that a careful look just shows, by what is said of them. Seeds are fixed, the cases no tuned ones. */
class SmallEffectsTest {
    private val n = 1200
    private val noise = 0.01
    private val random = java.util.Random(7)
    private val waves = List(24) {
        val period = 12 * exp(random.nextDouble() * 2.8)
        Triple(2 * PI / period, 2 * PI * random.nextDouble(), 0.2 * minOf(period / 40, 1.0))
    }
    private val times = DoubleArray(n) { it.toDouble() }
    private val truth = DoubleArray(n) { water(it.toDouble()) }
    private val speeds = DoubleArray(n) { 0.8 + 0.4 * sin(it / 37.0) }

    private fun water(time: Double) = waves.sumOf { (rate, phase, height) -> height * sin(rate * time + phase) }

    private fun shown(
        stage: SensorStage,
        condition: String = Conditions.SPEED,
        column: DoubleArray = speeds,
    ): DoubleArray {
        val sensor = SensorSpec("", listOf(stage)).build(truth[0], kotlin.random.Random(1))
        return DoubleArray(n) { row ->
            var shown = sensor.step(truth[row], 0.0, Conditions.NONE)
            if (row > 0) {
                repeat(10) { k ->
                    val share = (k + 0.5) / 10
                    val between = column[row - 1] + share * (column[row] - column[row - 1])
                    shown = sensor.step(water(row - 1 + share), 0.1, Conditions(mapOf(condition to between)))
                }
            }
            shown
        }
    }

    private fun diagnosed(
        clean: DoubleArray,
        base: SensorSpec? = null,
        conditions: Map<String, DoubleArray> = mapOf(Conditions.SPEED to speeds),
    ): Verdict {
        val values = DoubleArray(n) { clean[it] + noise * random.nextGaussian() }
        val series = MeasuredSeries(times, times, DoubleArray(n), values, truth, conditions)
        return Diagnosis(series, DiagnosisSettings(base = base)).run().verdict
    }

    /** Twelve standard errors of it: what it does itself must not count as correlation of what is left. */
    @Test
    fun aSlightlyCurvedCalibrationIsUnexplained() {
        val clean = shown(SensorStage.Lag(8.0))
        val verdict = assertIs<Verdict.Unexplained>(diagnosed(DoubleArray(n) { clean[it] + 0.004 * clean[it].pow(2) }))
        assertContains(verdict.what, "value")
    }

    /** Halfway between two frequencies of which the log holds whole periods; seven standard errors. */
    @Test
    fun aPeriodBetweenTwoFrequenciesIsSeen() {
        val clean = shown(SensorStage.Lag(8.0))
        val frequency = 63.5 / (n - 1)
        val verdict = diagnosed(DoubleArray(n) { clean[it] + 0.003 * sin(2 * PI * frequency * it) })
        assertContains(assertIs<Verdict.Unexplained>(verdict).what, "every 18.9 s")
    }

    @Test
    fun anOffsetThatSettlesIsToldAsOne() {
        val clean = shown(SensorStage.Lag(8.0))
        val verdict = diagnosed(DoubleArray(n) { clean[it] + 0.08 * (1 - exp(-it / 200.0)) })
        assertContains(assertIs<Verdict.Unexplained>(verdict).what, "and settles within some")
    }

    /** Ten standard errors; a drift or a jump explains most of it. */
    @Test
    fun aSmallOffsetThatSettlesIsNoDriftAndNoJump() {
        val clean = shown(SensorStage.Lag(8.0))
        for (time in listOf(90.0, 200.0)) {
            val verdict = diagnosed(DoubleArray(n) { clean[it] + 0.012 * exp(-it / time) })
            assertContains(assertIs<Verdict.Unexplained>(verdict).what, "settles", message = "$time")
        }
        val drifting = diagnosed(DoubleArray(n) { clean[it] + 6e-6 * it })
        assertEquals(listOf(Cause.DRIFT), assertIs<Verdict.Named>(drifting).causes)
    }

    /** Nine standard errors for who knows the noise; the base model takes them for noise that wanders. */
    @Test
    fun twoSmallJumpsThatUndoEachOtherAreNamed() {
        val clean = shown(SensorStage.Lag(8.0))
        val verdict = diagnosed(DoubleArray(n) { clean[it] + if (it in 480 until 850) 0.006 else 0.0 })
        assertEquals(listOf(Cause.OFFSET_STEPS), assertIs<Verdict.Named>(verdict).causes)
    }

    /** Lags of 8 s and [second] s in a row, in slow water. */
    private fun twice(second: Double): DiagnosisResult {
        val slow = List(12) { k -> Triple(2 * PI / (40 + 13 * k), 2 * PI * random.nextDouble(), 0.2) }
        val lags = listOf(8.0, second)
        val still = DoubleArray(n) { i -> slow.sumOf { (rate, phase, height) -> height * sin(rate * i + phase) } }
        val values = DoubleArray(n) { i ->
            slow.sumOf { (rate, phase, height) ->
                val late = lags.sumOf { atan(rate * it) }
                val lower = lags.fold(height) { left, tau -> left / hypot(1.0, rate * tau) }
                lower * sin(rate * i + phase - late)
            } + 5e-4 * random.nextGaussian()
        }
        val series = MeasuredSeries(times, times, DoubleArray(n), values, still, emptyMap())
        return Diagnosis(series).run()
    }

    /** As a dead time of as much, from which nothing tells it there. */
    @Test
    fun aSecondLagMuchShorterThanARowIsNoDeadTimeForCertain() {
        val sets = assertIs<Verdict.Ambiguous>(twice(0.08).verdict).sets
        assertEquals(setOf(Cause.SECOND_ORDER_RESPONSE, Cause.DEAD_TIME), sets.single().toSet())
    }

    /** So much is half a step of a simulation with fifty steps a row, however surely it shows. */
    @Test
    fun aShiftOfAHundredthOfARowIsToldAndNotNamed() {
        val result = twice(0.01)
        assertEquals(Verdict.Consistent, result.verdict)
        val told = result.warnings.single { "not named" in it }
        assertContains(told, Regex("(second-order-response|dead-time) of 0\\.0\\d* s was fitted beside"))
    }

    /** At which speed the given time constant was found nobody said: 0.9 m/s is as good as the log's usual 0.8 m/s. */
    @Test
    fun aGivenTimeConstantThatGoesWithSpeedIsNotWrongBesides() {
        val given = SensorSpec("given", listOf(SensorStage.Lag(8.0), SensorStage.Calibration(1.0, 0.0)))
        val verdict = diagnosed(shown(SensorStage.FlowLag(8.0, 0.9, 0.3)), given)
        assertEquals(Verdict.Named(listOf(Cause.FLOW_DEPENDENT_RESPONSE)), verdict)
    }

    /** Calibrated in a laboratory at 20 °C, and used in a lake of 5 to 8 °C. */
    @Test
    fun aGivenTimeConstantOfWarmerWaterThanTheLogsIsNotWrongBesides() {
        val given = SensorSpec("given", listOf(SensorStage.Lag(5.0), SensorStage.Calibration(1.0, 0.0)))
        val cold = DoubleArray(n) { 6.5 + 1.5 * sin(it / 37.0) }
        val lag = SensorStage.TemperatureLag(5.0, 20.0, 0.05)
        val conditions = mapOf(Conditions.TEMPERATURE to cold)
        val verdict = diagnosed(shown(lag, Conditions.TEMPERATURE, cold), given, conditions)
        assertEquals(Verdict.Named(listOf(Cause.TEMPERATURE_DEPENDENT_RESPONSE)), verdict)
    }

    @Test
    fun aGivenTimeConstantOfNoSpeedOfTheLogIsWrongBesides() {
        val given = SensorSpec("given", listOf(SensorStage.Lag(4.0), SensorStage.Calibration(1.0, 0.0)))
        val verdict = diagnosed(shown(SensorStage.FlowLag(8.0, 0.9, 0.3)), given)
        assertEquals(Verdict.Named(listOf(Cause.TIME_CONSTANT, Cause.FLOW_DEPENDENT_RESPONSE)), verdict)
    }
}
