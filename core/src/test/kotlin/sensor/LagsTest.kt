package stillwater.sensor

import org.junit.jupiter.api.Test
import stillwater.model.Conditions
import kotlin.math.exp
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

/** The lags that are not of one constant time constant: asymmetric, two-path, by conditions. */
class LagsTest {
    private fun SensorModel.step(input: Double, dt: Double) = step(input, dt, Conditions.NONE)

    @Test
    fun anAsymmetricLagTakesTheTimeConstantOfItsDirection() {
        val up = AsymmetricLag(rising = 2.0, falling = 8.0, initial = 0.0)
        val down = AsymmetricLag(rising = 2.0, falling = 8.0, initial = 1.0)
        // One rounding each of numbers below 1.
        assertEquals(1 - exp(-0.5), up.step(1.0, 1.0), 1e-15)
        assertEquals(exp(-0.125), down.step(0.0, 1.0), 1e-15)
    }

    @Test
    fun anAsymmetricLagOfEqualConstantsIsAFirstOrderLag() {
        val one = FirstOrderLag(9.5, 0.25)
        val two = AsymmetricLag(9.5, 9.5, 0.25)
        for (i in 0 until 100) {
            val input = (i * 7 % 13) / 13.0
            assertEquals(one.step(input, 1.0 + i % 3), two.step(input, 1.0 + i % 3), 0.0)
        }
    }

    @Test
    fun twoPathsShowTheSumOfTheirShares() {
        val sensor = TwoPathLag(fast = 1.0, slow = 10.0, slowShare = 0.25, initial = 0.0)
        // Three roundings of numbers below 1.
        assertEquals(0.75 * (1 - exp(-2.0)) + 0.25 * (1 - exp(-0.2)), sensor.step(1.0, 2.0), 1e-15)
    }

    @Test
    fun aLagInFastWaterIsShort() {
        fun after(speed: Double): Double {
            val sensor = ConditionedLag(TimeConstant.ofFlow(10.0, referenceSpeed = 1.0, exponent = 0.5), 0.0)
            return sensor.step(1.0, 5.0, Conditions(mapOf(Conditions.SPEED to speed)))
        }
        // τ = 10 s at 1 m/s, 5 s at 4 m/s, 20 s at 0.25 m/s; the powers of two cost a few roundings.
        assertEquals(1 - exp(-0.5), after(1.0), 1e-14)
        assertEquals(1 - exp(-1.0), after(4.0), 1e-14)
        assertEquals(1 - exp(-0.25), after(0.25), 1e-14)
        assertEquals(after(1.0), after(Double.NaN), 0.0)
        assertEquals(after(0.01), after(0.0), 0.0)
        assertTrue(after(-3.0) > 0)
    }

    @Test
    fun aLagInWarmWaterIsShort() {
        val timeConstant = TimeConstant.ofTemperature(10.0, referenceTemperature = 20.0, relativeChange = 0.03)
        fun at(temperature: Double) = timeConstant.under(Conditions(mapOf(Conditions.TEMPERATURE to temperature)))
        // A few roundings of numbers near 10.
        assertEquals(10 * exp(-0.3), at(30.0), 1e-14)
        assertEquals(10 * exp(0.3), at(10.0), 1e-14)
        assertEquals(10.0, timeConstant.under(Conditions.NONE), 0.0)
        assertEquals(at(120.0), at(1e9), 0.0)
    }

    @Test
    fun impossibleNumbersAreRefusedByName() {
        fun refused(words: String, block: () -> Unit) =
            assertEquals(words, assertFailsWith<IllegalArgumentException> { block() }.message)
        refused("rising (0.0 s) must be above 0 and finite") { AsymmetricLag(0.0, 1.0, 0.0) }
        refused("falling (NaN s) must be above 0 and finite") { AsymmetricLag(1.0, Double.NaN, 0.0) }
        refused("slow (1.0 s) must be at least fast (2.0 s)") { TwoPathLag(2.0, 1.0, 0.5, 0.0) }
        refused("slowShare (-0.1) must be within 0..1") { TwoPathLag(1.0, 2.0, -0.1, 0.0) }
        refused("referenceSpeed (0.0 m/s) must be above 0 and finite") { TimeConstant.ofFlow(1.0, 0.0, 0.5) }
        refused("exponent (3.0) must be within -2..2") { TimeConstant.ofFlow(1.0, 1.0, 3.0) }
        refused("relativeChange (1.0 / °C) must be within -0.5..0.5") { TimeConstant.ofTemperature(1.0, 20.0, 1.0) }
    }
}
