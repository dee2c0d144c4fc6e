package stillwater.sensor

import io.kotest.property.Arb
import io.kotest.property.arbitrary.numericDouble
import org.junit.jupiter.api.Test
import stillwater.model.Conditions
import stillwater.property.forEvery
import kotlin.math.abs
import kotlin.math.exp
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class RateLimitedLagTest {
    private fun SensorModel.step(input: Double, dt: Double) = step(input, dt, Conditions.NONE)

    @Test
    fun movesEvenlyWhileFarAndThenClosesAsALag() {
        val sensor = RateLimitedLag(timeConstant = 4.0, rate = 0.25, initial = 0.0)
        // Within rτ = 1 of the truth after four seconds; sums of powers of two are exact.
        assertEquals(0.5, sensor.step(2.0, 2.0), 0.0)
        assertEquals(1.0, sensor.step(2.0, 2.0), 0.0)
        // Two roundings of numbers near 2.
        assertEquals(2 - exp(-0.5), sensor.step(2.0, 2.0), 1e-15)
        assertEquals(2 - exp(-0.5) - 0.25, sensor.step(-9.0, 1.0), 1e-15)
    }

    @Test
    fun withoutALimitThatActsItIsALag() {
        val one = FirstOrderLag(9.5, 0.25)
        val two = RateLimitedLag(9.5, 1e6, 0.25)
        for (i in 0 until 100) {
            val input = (i * 7 % 13) / 13.0
            assertEquals(one.step(input, 1.0 + i % 3), two.step(input, 1.0 + i % 3), 0.0)
        }
    }

    @Test
    fun twoPartialStepsEqualOneWholeStepAndNoneIsFasterThanTheRate() {
        forEvery(
            Arb.numericDouble(-1e3, 1e3),
            Arb.numericDouble(1e-3, 1e3),
            Arb.numericDouble(0.0, 1.0),
        ) { input, dt, share ->
            val whole = RateLimitedLag(3.0, 0.7, 5.0).step(input, dt)
            val parts = RateLimitedLag(3.0, 0.7, 5.0)
            parts.step(input, share * dt)
            // A dozen roundings at magnitude 1e3.
            assertEquals(whole, parts.step(input, dt - share * dt), 1e-11)
            assertTrue(abs(whole - 5) <= 0.7 * dt + 1e-11, "moved ${whole - 5} in $dt s")
            assertTrue(whole in minOf(5.0, input)..maxOf(5.0, input), "$whole beyond the truth")
        }
    }

    @Test
    fun hugeNumbersDoNotOverflow() {
        val sensor = RateLimitedLag(1.0, 1e307, -1.7e308)
        assertEquals(-1.7e308 + 2e307, sensor.step(1.7e308, 2.0), 1e293)
    }

    @Test
    fun impossibleNumbersAreRefusedByName() {
        fun refused(words: String, block: () -> Unit) =
            assertEquals(words, assertFailsWith<IllegalArgumentException> { block() }.message)
        refused("timeConstant (0.0 s) must be above 0 and finite") { RateLimitedLag(0.0, 1.0, 0.0) }
        refused("rate (NaN sensor units/s) must be above 0 and finite") { RateLimitedLag(1.0, Double.NaN, 0.0) }
        refused("initial (Infinity) must be finite") { RateLimitedLag(1.0, 1.0, Double.POSITIVE_INFINITY) }
    }
}
