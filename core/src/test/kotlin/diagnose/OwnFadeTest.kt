package stillwater.diagnose

import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertNotNull

/**
 * What a sensor saw in a gap is hundreds of deviations of a good sensor's noise, and fades as the sensor does: as one a
 * hundredth slower it would leave several.
 */
class OwnFadeTest {
    private val rows = 1200
    private val period = 0.5

    /** Water that goes to and fro within a minute and less. */
    private fun water(seconds: Double) =
        9 + sin(seconds / 7.3) + 0.7 * sin(seconds / 3.1 + 1) + 0.4 * sin(seconds / 19 + 2)

    /** A log of the sensor of [stages], twenty steps a row, of which ten rows are missing in four places. */
    private fun log(seed: Long, vararg stages: SensorStage): MeasuredSeries {
        val sensor = SensorSpec("hidden", stages.toList()).build(water(0.0), Random(seed))
        val random = java.util.Random(seed)
        val values = DoubleArray(rows) { row ->
            var shown = 0.0
            for (step in 1..STEPS) {
                shown = sensor.step(water((row + (step - 0.5) / STEPS) * period), period / STEPS, Conditions.NONE)
            }
            shown + NOISE * random.nextGaussian()
        }
        val kept = (0 until rows).filter { row -> GAPS.none { row in it until it + 10 } }
        val times = DoubleArray(kept.size) { (kept[it] + 1) * period }
        val still = DoubleArray(kept.size)
        val read = DoubleArray(kept.size) { values[kept[it]] }
        return MeasuredSeries(times, still, still, read, DoubleArray(kept.size) { water(times[it]) })
    }

    @Test
    fun aSlowSensorWithLittleNoiseIsConsistentAcrossGaps() {
        for (seed in 1L..3L) {
            val result = Diagnosis(log(seed, SensorStage.Lag(26.0))).run()
            assertEquals(Verdict.Consistent, result.verdict, "seed $seed")
            val lag = result.baseline.parameters.first()
            assertEquals(26.0, lag.value, 0.05, "seed $seed")
            assertEquals(NOISE, result.baseline.noiseSpread, 0.15 * NOISE, "seed $seed")
        }
    }

    /** The delay goes on to bring what was there in the gap, and the lag that is left is half of the base's. */
    @Test
    fun aDeadTimeIsFoundAcrossGaps() {
        val log = log(4, SensorStage.Delay(3.7), SensorStage.Lag(3.3))
        val result = Diagnosis(log).run()
        assertEquals(Verdict.Named(listOf(Cause.DEAD_TIME)), result.verdict)
        val numbers = assertNotNull(result.extended).parameters.associate { it.name to it.value }
        assertEquals(3.3, numbers.getValue("time_constant_s"), 0.05, "$numbers")
        assertEquals(3.7, numbers.getValue("dead_time_s"), 0.05, "$numbers")
    }

    /** As where the file of another probe is at hand. */
    @Test
    fun aGivenTimeConstantThatIsWrongIsFoundAcrossGaps() {
        val given = SensorSpec("given", listOf(SensorStage.Lag(18.4)))
        val result = Diagnosis(log(5, SensorStage.Lag(13.6)), DiagnosisSettings(base = given)).run()
        assertEquals(Verdict.Named(listOf(Cause.TIME_CONSTANT)), result.verdict)
        val lag = assertNotNull(result.extended).parameters.first { it.name == "time_constant_s" }
        assertEquals(13.6, lag.value, 0.1)
    }

    private companion object {
        const val STEPS = 20
        const val NOISE = 0.002
        val GAPS = listOf(210, 480, 777, 1010)
    }
}
