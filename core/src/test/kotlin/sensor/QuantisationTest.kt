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

class QuantisationTest {
    private fun Quantisation.step(input: Double) = step(input, 1.0, Conditions.NONE)

    @Test
    fun roundsToTheNearestStepTiesToEven() {
        val quantisation = Quantisation(0.25)
        // Quarters and eighths are exact in binary.
        for ((input, expected) in listOf(
            0.0 to 0.0,
            0.12 to 0.0,
            0.13 to 0.25,
            0.125 to 0.0,
            0.375 to 0.5,
            0.625 to 0.5,
            -0.13 to -0.25,
            -0.375 to -0.5,
            7.3 to 7.25,
        )) {
            assertEquals(expected, quantisation.step(input), 0.0, "of $input")
        }
    }

    @Test
    fun isNeverMoreThanHalfAStepOffAndChangesNothingTwice() {
        forEvery(Arb.numericDouble(-1e4, 1e4), Arb.numericDouble(1e-3, 10.0)) { input, step ->
            val quantisation = Quantisation(step)
            val output = quantisation.step(input)
            // The product is rounded at magnitude 1e4: 2e-12.
            assertTrue(abs(output - input) <= step / 2 + 2e-12, "$input to $output in steps of $step")
            assertEquals(output, quantisation.step(output), 0.0)
        }
    }

    @Test
    fun whatIsNotFiniteOrHasTooManyStepsPassesUnchanged() {
        val quantisation = Quantisation(0.005)
        assertTrue(quantisation.step(Double.NaN).isNaN())
        assertEquals(Double.POSITIVE_INFINITY, quantisation.step(Double.POSITIVE_INFINITY))
        assertEquals(Double.MAX_VALUE, quantisation.step(Double.MAX_VALUE))
        assertEquals(Double.MAX_VALUE, Quantisation(0.6 * Double.MAX_VALUE).step(Double.MAX_VALUE))
    }

    @Test
    fun impossibleNumbersAreRefusedByName() {
        for (step in listOf(0.0, -0.1, Double.NaN, Double.POSITIVE_INFINITY)) {
            val error = assertFailsWith<IllegalArgumentException> { Quantisation(step) }
            assertEquals("step ($step) must be above 0 and finite", error.message)
        }
    }
}
