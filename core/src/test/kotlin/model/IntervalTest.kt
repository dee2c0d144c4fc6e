package stillwater.model

import io.kotest.property.Arb
import io.kotest.property.arbitrary.numericDouble
import org.junit.jupiter.api.Test
import stillwater.property.forEvery
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class IntervalTest {
    @Test
    fun midpointAndWidth() {
        val interval = Interval(-1.0, 4.0)
        assertEquals(1.5, interval.midpoint, 0.0)
        assertEquals(5.0, interval.width, 0.0)
        assertEquals(0.5, Interval.UNIT.midpoint, 0.0)
        assertEquals(1.0, Interval.UNIT.width, 0.0)
    }

    @Test
    fun theMidpointLiesBetweenTheEndsHoweverLargeTheyAre() {
        val all = Arb.numericDouble(-Double.MAX_VALUE, Double.MAX_VALUE)
        forEvery(all, all, cases = 1000) { a, b ->
            val interval = Interval(minOf(a, b), maxOf(a, b))
            assertTrue(interval.midpoint in interval, "$interval has midpoint ${interval.midpoint}")
        }
        assertEquals(0.0, Interval(-Double.MAX_VALUE, Double.MAX_VALUE).midpoint, 0.0)
        assertEquals(Double.MAX_VALUE, Interval(Double.MAX_VALUE, Double.MAX_VALUE).midpoint, 0.0)
    }

    @Test
    fun holdsItsEndsAndWhatIsBetween() {
        val interval = Interval(2.0, 3.0)
        for (value in listOf(2.0, 2.5, 3.0)) assertTrue(value in interval, "$value")
        for (value in listOf(1.999, 3.001, Double.NaN, Double.POSITIVE_INFINITY)) {
            assertFalse(value in interval, "$value")
        }
    }

    @Test
    fun onePointIsAnInterval() {
        val point = Interval(7.0, 7.0)
        assertEquals(0.0, point.width, 0.0)
        assertEquals(7.0, point.midpoint, 0.0)
        assertTrue(7.0 in point)
    }

    @Test
    fun endsMustBeFiniteAndTheRightWayRound() {
        val turned = assertFailsWith<IllegalArgumentException> { Interval(1.0, 0.5) }
        assertEquals("interval's lower end (1.0) must not be above its upper end (0.5)", turned.message)
        for ((lower, upper) in listOf(
            Double.NaN to 1.0,
            0.0 to Double.NaN,
            Double.NEGATIVE_INFINITY to 0.0,
            0.0 to Double.POSITIVE_INFINITY,
        )) {
            val error = assertFailsWith<IllegalArgumentException> { Interval(lower, upper) }
            assertEquals("interval ends ($lower, $upper) must be finite", error.message)
        }
    }
}
