package stillwater.diagnose.reference

import stillwater.diagnose.Diagnosis
import stillwater.diagnose.DiagnosisSettings
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.response.ExtendedSensor
import stillwater.diagnose.response.Fitting
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Scales
import stillwater.diagnose.response.Steps
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.abs
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

/** A sensor that is given means in the diagnosis what it means in the simulator. */
class GivenSensorTest {
    private val n = 400
    private val truth = DoubleArray(n) { 5 + sin(it / 9.0) + 0.7 * sin(it / 23.0 + 1) }
    private val warmth = DoubleArray(n) { 15 + 6 * sin(it / 61.0) }
    private val conditions = mapOf(Conditions.TEMPERATURE to warmth)
    private val times = DoubleArray(n) { it.toDouble() }

    /** What the simulator shows; the log begins when the sensor does. */
    private fun run(stages: List<SensorStage>): DoubleArray {
        val sensor = SensorSpec("given", stages).build(truth[0], Random(1))
        return DoubleArray(n) {
            val now = Conditions(mapOf(Conditions.TEMPERATURE to warmth[it]))
            if (it ==
                0
            ) {
                stages.fold(truth[0]) { shown, stage -> stage.settled(shown) }
            } else {
                sensor.step(truth[it], 1.0, now)
            }
        }
    }

    private fun model(stages: List<SensorStage>): Pair<ResponseModel, DoubleArray> {
        val series = MeasuredSeries(times, DoubleArray(n), DoubleArray(n), run(stages), truth, conditions)
        val scales = Scales(series)
        val given = GivenSensor(SensorSpec("given", stages), scales)
        // The simulator holds the truth over a step.
        val model = ResponseModel(series, given.terms, Steps.HELD, scales)
        return model to given.numbers(model)
    }

    private fun assertPredicted(stages: List<SensorStage>) {
        val (model, numbers) = model(stages)
        val predicted = DoubleArray(n).also { model.predict(numbers, it) }
        val shown = run(stages)
        val worst = (SETTLED until n).maxOf { abs(predicted[it] - shown[it]) }
        assertTrue(worst < 2e-3, "$stages: $worst")
    }

    @Test
    fun whatStandsBeforeAGainIsAsLargeAsItIsShown() {
        for (gain in listOf(0.5, -2.0)) {
            for (stage in listOf(
                SensorStage.Slew(0.05),
                SensorStage.Backlash(0.2),
                SensorStage.Range(4.5, 5.8),
                SensorStage.Drifting(1e-3),
                SensorStage.Jumps(listOf(150.5, 300.5), listOf(0.6, -0.4)),
                SensorStage.Cross(Conditions.TEMPERATURE, 12.0, 0.1),
            )) {
                assertPredicted(listOf(SensorStage.Lag(3.0), stage, SensorStage.Calibration(gain, 0.3)))
                assertPredicted(listOf(SensorStage.Lag(3.0), SensorStage.Calibration(gain, 0.3), stage))
            }
        }
    }

    @Test
    fun stagesOfAKindAddUpOrStandInEitherOrder() {
        assertPredicted(listOf(SensorStage.Delay(2.0), SensorStage.Delay(1.0), SensorStage.Lag(3.0)))
        assertPredicted(listOf(SensorStage.Lag(3.0), SensorStage.Drifting(1e-3), SensorStage.Drifting(-3e-3)))
        assertPredicted(listOf(SensorStage.Asymmetric(6.0, 4.0), SensorStage.Lag(2.0)))
        assertPredicted(listOf(SensorStage.Lag(6.0), SensorStage.Lag(2.0)))
        assertPredicted(
            listOf(SensorStage.LimitedLag(3.0, 0.05), SensorStage.Lag(2.0), SensorStage.Calibration(0.5, 0.3)),
        )
    }

    @Test
    fun anExtendedSensorIsReadAgainAsItWasWritten() {
        for (response in listOf(
            listOf(SensorStage.Lag(3.0), SensorStage.Slew(0.05)),
            listOf(SensorStage.LimitedLag(3.0, 0.05), SensorStage.Lag(2.0)),
        )) {
            val stages = response + SensorStage.Calibration(0.5, 0.3)
            val (model, numbers) = model(stages)
            val free = BooleanArray(numbers.size)
            val fit = Fitting.fit(model, numbers, free, BooleanArray(n) { true }, 20.0)
            val written = ExtendedSensor(fit, null).spec("extended").stages.filter { it !is SensorStage.Noise }
            assertEquals(stages, written)
        }
    }

    @Test
    fun whatWouldBeLostIsRefused() {
        for ((stages, words) in listOf(
            List(3) { SensorStage.Lag(2.0) } to "at most two lags",
            listOf(SensorStage.Asymmetric(2.0, 3.0), SensorStage.FlowLag(2.0, 1.0, 0.5)) to "at most two lags",
            listOf(SensorStage.Slew(0.1), SensorStage.Slew(0.2)) to "at most one slew limit",
            listOf(SensorStage.LimitedLag(3.0, 0.1), SensorStage.Slew(0.2)) to "at most one slew limit",
            listOf(SensorStage.Cross("salinity", 30.0, 0.1)) to "--condition salinity=COLUMN",
            listOf(SensorStage.Combined(5.0, relativeChange = 0.1)) to "--condition temperature=COLUMN",
        )) {
            val series = MeasuredSeries(times, DoubleArray(n), DoubleArray(n), truth, truth)
            val problem = assertFailsWith<IllegalArgumentException> {
                Diagnosis(series, DiagnosisSettings(base = SensorSpec("given", stages)))
            }
            assertContains(problem.message.orEmpty(), words)
        }
    }

    private companion object {
        /** Rows until the sensor has forgotten how it began. */
        const val SETTLED = 60
    }
}
