package stillwater.diagnose.blind

import org.junit.jupiter.api.Tag
import stillwater.diagnose.Cause
import stillwater.diagnose.CrossingTrack
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import stillwater.diagnose.track.PassShift
import stillwater.sensor.SensorStage
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertNotNull
import kotlin.test.assertNull
import kotlin.test.assertTrue

/** Water that takes longer through a tube than the sensor's lag is, without a reference. */
class LongDelayTest {
    private val rows = 900
    private val late = 30
    private val track = CrossingTrack(rows + late)

    /** A lag of 5 s that shows the water [late] seconds late; [spread] is that of noise. */
    private fun log(late: Int, spread: Double = 0.004): MeasuredSeries {
        val random = java.util.Random(SEED)
        val shown = track.shown(5.0)
        val values = DoubleArray(rows) { shown[it] + spread * random.nextGaussian() }
        fun DoubleArray.after() = copyOfRange(late, late + rows)
        return MeasuredSeries(track.times.copyOf(rows), track.x.after(), track.y.after(), values, null)
    }

    @Test
    fun theShiftThatSuitsPassesHoldsTheDelayAndTheLag() {
        val shift = assertNotNull(PassShift(log(late)).late(), "seed $SEED")
        assertTrue(shift in 30.0..40.0, "seed $SEED: $shift s")
        // Of noise alone no shift makes more sense than another.
        assertNull(PassShift(log(late, spread = 1e3)).late(), "seed $SEED")
    }

    @Test
    @Tag("long")
    fun itIsNamedAndTheLagBesideItToldRight() {
        val result = Diagnosis(log(late)).run()
        assertEquals(Verdict.Named(listOf(Cause.DEAD_TIME)), result.verdict, "seed $SEED")
        val numbers = result.candidates.first { it.cause == Cause.DEAD_TIME }.parameters.associateBy { it.name }
        // A tenth is what a strong cause's number may be off.
        assertEquals(30.0, numbers.getValue("dead_time_s").value, 3.0, "seed $SEED")
        // What is left of it once most is taken off may as well be a second lag.
        val sensor = assertNotNull(result.extendedSensor)
        val lags = sensor.stages.filterIsInstance<SensorStage.Lag>().sumOf { it.timeConstant }
        assertEquals(35.0, GivenLag.delay(sensor) + lags, 1.0, "seed $SEED: $sensor")
        assertTrue(GivenLag.delay(sensor) > 20, "seed $SEED: $sensor")
    }

    private companion object {
        const val SEED = 31L
    }
}
