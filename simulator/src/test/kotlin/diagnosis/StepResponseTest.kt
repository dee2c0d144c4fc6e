package stillwater.diagnosis

import org.junit.jupiter.api.Test
import stillwater.model.Conditions
import stillwater.plot.Series
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.abs
import kotlin.math.exp
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** What is left of a step is what the lags, paths and delays of a sensor leave of it, and nothing else. */
class StepResponseTest {
    private val base = SensorSpec("base", listOf(SensorStage.Lag(8.0)))

    private fun curves(vararg stages: SensorStage) =
        StepResponse(base, SensorSpec("extended", stages.toList()), Conditions(mapOf(Conditions.SPEED to 1.0))).curves()

    /** What [series] has left at [time] s. */
    private fun left(series: Series, time: Double) = series.y[series.x.indices.minBy { abs(series.x[it] - time) }]

    @Test
    fun aLagIsAnExponentialThatEndsWhereItHasSettled() {
        val (one, other) = curves(SensorStage.Lag(3.0))
        for (time in listOf(0.0, 8.0, 24.0)) assertEquals(exp(-time / 8), left(one, time), 0.03 * exp(-time / 8))
        assertEquals(exp(-2.0), left(other, 6.0), 0.05 * exp(-2.0))
        assertTrue(left(other, 40.0).isNaN(), "below a thousandth nothing is drawn")
        assertTrue(one.x.last() in 50.0..60.0, "${one.x.last()} s: a thousandth is left after 55 s")
    }

    @Test
    fun aDelayLeavesAllUntilItIsOver() {
        val (_, late) = curves(SensorStage.Delay(5.0), SensorStage.Lag(8.0))
        assertEquals(1.0, left(late, 4.0))
        assertEquals(exp(-1.0), left(late, 13.0), 0.03)
    }

    @Test
    fun whatIsNoResponseIsLeftOut() {
        val noisy = curves(
            SensorStage.Calibration(2.0, 5.0),
            SensorStage.LimitedLag(8.0, 1e-3),
            SensorStage.Drifting(0.1),
            SensorStage.Quantum(0.5),
            SensorStage.Noise(0.3),
        )
        assertEquals(noisy[0].y.toList(), noisy[1].y.toList())
    }
}
