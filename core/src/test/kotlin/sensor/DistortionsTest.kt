package stillwater.sensor

import org.junit.jupiter.api.Test
import stillwater.model.Conditions
import kotlin.math.abs
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Stages that do not lag: calibration, cross-sensitivity, drift, jumps, play, range, outliers. */
class DistortionsTest {
    private fun SensorModel.step(input: Double, dt: Double = 1.0) = step(input, dt, Conditions.NONE)

    @Test
    fun gainAndOffset() {
        assertEquals(5.5, GainOffset(2.0, 0.5).step(2.5), 0.0)
        assertEquals(Double.MAX_VALUE, GainOffset(4.0, 0.0).step(Double.MAX_VALUE), 0.0)
    }

    @Test
    fun crossSensitivityAddsWhatTheConditionSays() {
        val sensor = CrossSensitivity("salinity", reference = 30.0, coefficient = 0.25)
        assertEquals(6.0, sensor.step(5.0, 1.0, Conditions(mapOf("salinity" to 34.0))), 0.0)
        assertEquals(5.0, sensor.step(5.0, 1.0, Conditions(mapOf("temperature" to 34.0))), 0.0)
    }

    @Test
    fun driftGrowsWithTime() {
        val drift = Drift(0.25)
        assertEquals(listOf(1.25, 1.5, 2.5), listOf(drift.step(1.0), drift.step(1.0), drift.step(1.0, 4.0)))
    }

    @Test
    fun jumpsHoldFromTheirTimeOn() {
        val sensor = OffsetSteps(doubleArrayOf(2.0, 4.0), doubleArrayOf(0.5, -1.0))
        assertEquals(listOf(0.0, 0.0, 0.5, 0.5, -1.0, -1.0), List(6) { sensor.step(0.0) })
    }

    @Test
    fun playFollowsOnlyBeyondItsDeadBand() {
        val play = Play(0.5, initial = 0.0)
        val inputs = listOf(0.125, 0.25, 1.0, 0.75, 0.5, 0.25)
        assertEquals(listOf(0.0, 0.0, 0.75, 0.75, 0.75, 0.5), inputs.map { play.step(it) })
    }

    @Test
    fun playDoesNotDependOnRate() {
        val slow = Play(0.5, initial = 0.0)
        val fast = Play(0.5, initial = 0.0)
        for (i in 0 until 50) assertEquals(slow.step(i % 7 / 3.0, 100.0), fast.step(i % 7 / 3.0, 0.01), 0.0)
    }

    @Test
    fun saturationEndsWhereItSays() {
        val sensor = Saturation(0.0, 20.0)
        assertEquals(listOf(0.0, 3.0, 20.0), listOf(-1.0, 3.0, 25.0).map { sensor.step(it) })
    }

    @Test
    fun outliersComeAsOftenAndAsFarAsTheyShould() {
        val sensor = Outliers(0.1, 3.0, Random(20261120))
        val off = List(100_000) { sensor.step(7.0) - 7.0 }
        val hit = off.count { it != 0.0 }
        // 10 000 expected, standard deviation 95: five of them.
        assertTrue(abs(hit - 10_000) < 475, "$hit outliers")
        assertTrue(off.all { abs(it) <= 3.0 })
        // The mean size of an even spread over ± 3 is 1.5, its standard deviation 0.87 / √10 000: five of them.
        assertEquals(1.5, off.filter { it != 0.0 }.map { abs(it) }.average(), 0.045)
    }
}
