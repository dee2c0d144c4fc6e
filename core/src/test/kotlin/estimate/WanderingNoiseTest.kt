package stillwater.estimate

import org.junit.jupiter.api.Test
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertNotNull
import kotlin.test.assertTrue

/** Readings whose noise wanders: what it is, and intervals that hold the water for all that. */
class WanderingNoiseTest {
    private val n = 2400
    private val times = DoubleArray(n) { it + 0.2 * sin(it * 1.7) }
    private val lag = listOf(SensorStage.Lag(8.0))
    private val wander = SensorStage.Wander(0.02, 12.0)
    private val white = SensorStage.Noise(0.008)
    private val truth: DoubleArray = run {
        val random = Random(4)
        val waves = List(30) { Triple(random.nextDouble(0.004, 0.12), random.nextDouble(6.3), random.nextDouble(0.3)) }
        DoubleArray(n) { i -> 5 + waves.sumOf { (rate, phase, height) -> height * sin(rate * times[i] + phase) } }
    }

    private fun readings(stages: List<SensorStage>): TrackSeries {
        val sensor = SensorSpec("", stages).build(truth[0], Random(9))
        // Stepped within the row, as no sensor waits for a row.
        val values = DoubleArray(n) { i ->
            if (i > 0) {
                val dt = (times[i] - times[i - 1]) / 20
                for (part in 1 until 20) {
                    sensor.step(truth[i - 1] + (truth[i] - truth[i - 1]) * part / 20, dt, Conditions.NONE)
                }
                sensor.step(truth[i], dt, Conditions.NONE)
            } else {
                sensor.step(truth[0], 1e-9, Conditions.NONE)
            }
        }
        return TrackSeries(times, DoubleArray(n) { 0.8 * times[it] }, DoubleArray(n), values)
    }

    private fun learned(stages: List<SensorStage>) =
        ReferenceLearner(readings(stages), truth).wander(Response(lags = listOf(ResponseLag(8.0))))

    @Test
    fun aReferenceShowsHowTheNoiseWanders() {
        val found = assertNotNull(learned(lag + white + wander))
        // Two hundred times T: a standard error of some 7 % of the deviation, of 15 % of T.
        assertEquals(wander.standardDeviation, found.standardDeviation, 0.2 * wander.standardDeviation)
        assertEquals(wander.correlationTime, found.correlationTime, 0.5 * wander.correlationTime)
    }

    @Test
    fun whiteNoiseDoesNotWander() = assertEquals(null, learned(lag + SensorStage.Noise(0.02)))

    private fun covered(track: CorrectedTrack) =
        (0 until n).count { truth[it] in track.lower[it]..track.upper[it] } / n.toDouble()

    @Test
    fun aSensorWhoseNoiseIsToldToWanderHasIntervalsThatHold() {
        for (stages in listOf(lag, listOf(SensorStage.Delay(6.0)), listOf(SensorStage.TwoPath(5.0, 40.0, 0.3)))) {
            val series = readings(stages + white + wander)
            fun corrected(told: List<SensorStage>): CorrectedTrack {
                val sensor = UndoableSensor.of(SensorSpec("", told))
                return TrackCorrector(series, wander = sensor.wander)
                    .correct(listOf(LikelyResponse(listOf(sensor.response), 1.0)))
            }
            val track = corrected(stages + white + wander)
            // Rows are alike over T: two hundred of their own, of which two standard errors are 3 %.
            assertEquals(0.95, covered(track), 0.05, "$stages")
            val silent = corrected(stages + white)
            assertTrue(covered(silent) < 0.85, "$stages: ${covered(silent)} without being told")
            fun error(track: CorrectedTrack) = (0 until n).sumOf { (track.values[it] - truth[it]).let { d -> d * d } }
            assertTrue(error(track) < error(silent), "$stages")
        }
    }

    @Test
    fun whatWandersIsInTheUnitsBeforeTheGain() {
        val sensor = UndoableSensor.of(
            SensorSpec(
                "",
                listOf(
                    SensorStage.Lag(8.0),
                    SensorStage.Wander(3.0, 5.0),
                    SensorStage.Calibration(-2.0, 1.0),
                    SensorStage.Wander(8.0, 12.0),
                    SensorStage.Wander(0.0, 99.0),
                ),
            ),
        )
        assertEquals(SensorStage.Wander(5.0, 12.0), sensor.wander)
        assertEquals(null, UndoableSensor.of(SensorSpec("", lag + white)).wander)
    }
}
