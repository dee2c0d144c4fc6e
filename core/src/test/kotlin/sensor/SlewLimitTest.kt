package stillwater.sensor

import io.kotest.property.Arb
import io.kotest.property.arbitrary.numericDouble
import org.junit.jupiter.api.Test
import stillwater.model.Conditions
import stillwater.property.forEvery
import kotlin.math.abs
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class SlewLimitTest {
    private fun SlewLimit.step(input: Double, dt: Double) = step(input, dt, Conditions.NONE)

    @Test
    fun movesAtTheRateAndThenStandsOnTheTruth() {
        val slew = SlewLimit(rate = 0.25, initial = 1.0)
        // Sums of powers of two: exact.
        assertEquals(1.25, slew.step(2.0, 1.0), 0.0)
        assertEquals(1.75, slew.step(2.0, 2.0), 0.0)
        assertEquals(2.0, slew.step(2.0, 8.0), 0.0)
        assertEquals(1.875, slew.step(-5.0, 0.5), 0.0)
    }

    @Test
    fun theOriginalSensorNeedsAHundredSamplesAcrossTheUnitRange() {
        val slew = SlewLimit(rate = 0.01, initial = 0.0)
        var samples = 0
        do {
            samples++
        } while (slew.step(1.0, 1.0) < 1.0 && samples < 1000)
        // A hundred roundings of 0.01 may leave a rest for one more sample.
        assertTrue(samples in 100..101, "$samples samples")
    }

    @Test
    fun neverMovesFasterThanTheRateNorBeyondTheTruth() {
        forEvery(
            Arb.numericDouble(-1e3, 1e3),
            Arb.numericDouble(-1e3, 1e3),
            Arb.numericDouble(1e-3, 1e3),
        ) { initial, input, dt ->
            val output = SlewLimit(0.7, initial).step(input, dt)
            // The sum is rounded at magnitude 1e3.
            assertTrue(abs(output - initial) <= 0.7 * dt + 1e-12, "moved ${output - initial} in $dt s")
            assertTrue(output in minOf(initial, input)..maxOf(initial, input), "$output beyond the truth")
            assertTrue(output == input || abs(output - initial) >= 0.7 * dt - 1e-12, "slower than it could")
        }
    }

    @Test
    fun twoPartialStepsEqualOneWholeStep() {
        forEvery(Arb.numericDouble(0.001, 100.0), Arb.numericDouble(0.0, 1.0)) { dt, share ->
            val whole = SlewLimit(0.3, 0.0).step(10.0, dt)
            val parts = SlewLimit(0.3, 0.0)
            parts.step(10.0, share * dt)
            // Three roundings at magnitude 10.
            assertEquals(whole, parts.step(10.0, dt - share * dt), 1e-14)
        }
    }

    @Test
    fun noTimeNoChange() {
        for (dt in listOf(0.0, -1.0, Double.NaN, Double.POSITIVE_INFINITY, Double.NEGATIVE_INFINITY)) {
            assertEquals(4.0, SlewLimit(5.0, initial = 4.0).step(9.0, dt), 0.0, "dt = $dt")
        }
    }

    @Test
    fun keepsItsStateWhenTheInputIsNotFinite() {
        val slew = SlewLimit(5.0, initial = 4.0)
        for (input in listOf(Double.NaN, Double.POSITIVE_INFINITY, Double.NEGATIVE_INFINITY)) {
            assertEquals(4.0, slew.step(input, 1.0), 0.0, "input = $input")
        }
        assertEquals(9.0, slew.step(9.0, 1.0), 0.0)
    }

    @Test
    fun theLargestNumbersDoNotOverflow() {
        val slew = SlewLimit(Double.MAX_VALUE, initial = -Double.MAX_VALUE)
        assertEquals(0.0, slew.step(Double.MAX_VALUE, 1.0), 0.0)
        assertEquals(Double.MAX_VALUE, slew.step(Double.MAX_VALUE, 1e9), 0.0)
    }

    @Test
    fun impossibleNumbersAreRefusedByName() {
        for (rate in listOf(0.0, -1.0, Double.NaN, Double.POSITIVE_INFINITY)) {
            val error = assertFailsWith<IllegalArgumentException> { SlewLimit(rate, 0.0) }
            assertEquals("rate ($rate sensor units/s) must be above 0 and finite", error.message)
        }
        assertFailsWith<IllegalArgumentException> { SlewLimit(1.0, Double.NaN) }
    }
}
