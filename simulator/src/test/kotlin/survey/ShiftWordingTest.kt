package stillwater.survey

import org.junit.jupiter.api.Test
import kotlin.test.assertEquals

class ShiftWordingTest {
    private fun best(seconds: Double, low: Double, high: Double, legs: Int = 10): String {
        val shifts = doubleArrayOf(-10.0, -9.0, 0.0, 9.0, 10.0)
        return ShiftWording.best(
            LagShift(seconds, low, high, 0.5, Estimate(0.5, 0.1), legs, 10.0, shifts, DoubleArray(5)),
        )
    }

    @Test
    fun theIntervalGoesTheWayOfTheShift() {
        assertEquals("3.5 s earlier (95 %: 2 to 4.5 s)", best(3.5, 2.0, 4.5))
        assertEquals("3.5 s later (95 %: 2 to 4.5 s)", best(-3.5, -4.5, -2.0))
        assertEquals("1 s later (95 %: 0 to 2 s)", best(-1.0, -2.0, 0.0))
    }

    @Test
    fun anIntervalBothWaysSaysTheWayOfEachEnd() {
        assertEquals("3.5 s later (95 %: 4.5 s later to 2 s earlier)", best(-3.5, -4.5, 2.0))
        assertEquals("0 s (95 %: 1 s later to 2 s earlier)", best(0.0, -1.0, 2.0))
        assertEquals("0 s (95 %: 0 s to 2 s earlier)", best(0.0, 0.0, 2.0))
    }

    @Test
    fun fewLegsAndTheEndOfTheRangeHaveNone() {
        assertEquals("2 s later", best(-2.0, -2.0, -2.0, legs = 7))
        assertEquals("10 s earlier, the most that was tried", best(10.0, 8.0, 10.0))
    }
}
