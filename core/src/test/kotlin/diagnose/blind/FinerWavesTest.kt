package stillwater.diagnose.blind

import stillwater.diagnose.CrossingTrack
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.noise.CorrelatedNoise
import stillwater.diagnose.track.SmoothTrack
import stillwater.diagnose.water.WaterModes
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class FinerWavesTest {
    private val n = 400
    private val track = CrossingTrack(n)
    private val x = track.x
    private val y = track.y
    private val series = run {
        val truth = DoubleArray(n) { sin(x[it] / 2) + sin(y[it] / 3 + 1) }
        val stages = listOf(SensorStage.Lag(4.0), SensorStage.Noise(0.01))
        val sensor = SensorSpec("hidden", stages).build(truth[0], Random(7))
        val values = DoubleArray(n) { sensor.step(truth[it], 1.0, Conditions.NONE) }
        MeasuredSeries(DoubleArray(n) { it.toDouble() }, x, y, values, null)
    }
    private val search = BlindSearch(series)

    /** The water as waves of [shortest] m and longer; that of the log has some of 4π and 6π m. */
    private fun state(shortest: Double, spread: Double = 1.0): BlindState {
        val white = CorrelatedNoise(series.times, 0.0, 10.0, BooleanArray(n) { true })
        val modes = WaterModes.flat(series, SmoothTrack.of(series), MOST, shortest)
        val noise = BlindNoise(white, DoubleArray(n) { spread })
        return search.settled(emptyList(), doubleArrayOf(3.5, 1.0, 0.0, 0.0), noise, DoubleArray(0), ROUNDS, modes)
    }

    @Test
    fun wavesThatTheModelHasNotAreSeenMissing() {
        val coarse = state(shortest = 15.0)
        assertFalse(FinerWaves.isNone(coarse, search), "${FinerWaves.excess(coarse, search)}")
        val fine = state(shortest = 9.0)
        assertTrue(FinerWaves.isNone(fine, search), "${FinerWaves.excess(fine, search)}")
    }

    /** How noise is scaled between its spread and its variance is nobody's concern. */
    @Test
    fun heldOutErrorsAreInTheReadingsOwnUnits() {
        val one = BlindHeldOut.score(state(shortest = 9.0))
        val three = BlindHeldOut.score(state(shortest = 9.0, spread = 3.0))
        // Variances of waves end where some rounds of their fixed point end.
        assertEquals(one.rmse, three.rmse, 0.02 * one.rmse)
        assertEquals(one.logLikelihood, three.logLikelihood, 0.02 * n)
    }

    private companion object {
        const val MOST = 200
        const val ROUNDS = 12
    }
}
