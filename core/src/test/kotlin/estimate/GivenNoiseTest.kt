package stillwater.estimate

import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.abs
import kotlin.math.hypot
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** What a sensor's file says of its white noise is taken: in water as rough as a row is long readings cannot tell it. */
class GivenNoiseTest {
    @Test
    fun noiseBehindTheResponseIsThatOfTheReadings() {
        fun noise(vararg stages: SensorStage) = UndoableSensor.of(SensorSpec("", stages.toList())).noise
        val lag = SensorStage.Lag(5.0)
        val twice = SensorStage.Calibration(2.0, 1.0)
        assertEquals(0.0, noise(lag))
        assertEquals(0.1, noise(lag, SensorStage.Noise(0.1)))
        assertEquals(hypot(0.1, 0.15), noise(lag, SensorStage.Noise(0.1), twice, SensorStage.Noise(0.3)), 1e-12)
        assertEquals(0.0, noise(SensorStage.Noise(0.1), lag), "a lag smooths what comes before it")
    }

    @Test
    fun intervalsOfRoughWaterHoldWithTheNoiseThatIsGiven() {
        val random = java.util.Random(SEED)
        var water = 0.0
        val truth = DoubleArray(ROWS) {
            water = 0.9 * water + 0.3 * random.nextGaussian()
            water
        }
        val values = DoubleArray(ROWS) { truth[it] + NOISE * random.nextGaussian() }
        val times = DoubleArray(ROWS) { it.toDouble() }
        val series = TrackSeries(times, times, DoubleArray(ROWS), values)

        fun corrected(noise: Double) =
            TrackCorrector(series, noise = noise).correct(listOf(LikelyResponse(listOf(Response()), 1.0)))

        fun held(track: CorrectedTrack) =
            truth.indices.count { truth[it] in track.lower[it]..track.upper[it] } / ROWS.toDouble()
        val given = corrected(NOISE)
        // Of 1000 independent rows five standard errors are 0.035.
        assertEquals(0.95, held(given), 0.035, "seed $SEED")
        assertEquals(1.96 * NOISE, given.meanHalfWidth, 0.1 * NOISE, "seed $SEED")
        val learned = corrected(0.0)
        assertTrue(abs(held(learned) - 0.95) > abs(held(given) - 0.95), "${held(learned)}, seed $SEED")
    }

    private companion object {
        const val ROWS = 1000
        const val SEED = 20261130L
        const val NOISE = 0.03
    }
}
