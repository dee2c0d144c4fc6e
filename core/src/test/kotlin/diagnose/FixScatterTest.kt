package stillwater.diagnose

import org.junit.jupiter.api.Test
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertNotNull

class FixScatterTest {
    private val n = 900
    private val track = CrossingTrack(n)
    private val values: DoubleArray = run {
        val sensor = SensorSpec("", listOf(SensorStage.Lag(5.0), SensorStage.Noise(0.004)))
            .build(track.truth[0], Random(7))
        DoubleArray(n) { sensor.step(track.truth[it], 1.0, Conditions.NONE) }
    }

    /** What is said of fixes that are off by [scatter], m, on either axis. */
    private fun warning(scatter: Double): String? {
        val random = java.util.Random(3)
        fun off(column: DoubleArray) = DoubleArray(n) { column[it] + scatter * random.nextGaussian() }
        val log = MeasuredSeries(DoubleArray(n) { it.toDouble() }, off(track.x), off(track.y), values, null)
        return Diagnosis(log).run().warnings.firstOrNull { "fixes scatter" in it }
    }

    @Test
    fun fixesThatScatterByMoreThanTheReadingsDoAreTold() {
        assertEquals(null, warning(0.0))
        val told = assertNotNull(warning(0.8))
        // A parabola through the fixes about each one takes part of its own error.
        val scatter = Regex("scatter by ([0-9.]+) m about").find(told)?.groupValues?.get(1)?.toDouble()
        assertEquals(0.8, assertNotNull(scatter, told), 0.1, told)
    }
}
