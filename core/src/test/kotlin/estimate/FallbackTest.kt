package stillwater.estimate

import org.junit.jupiter.api.Test
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import kotlin.math.sqrt
import kotlin.test.assertEquals

class FallbackTest {
    private val fallback = Fallback(Grid.unit(3, 1), Interval(4.0, 12.0))

    private fun take(cell: Int, seconds: Int, value: Double, isUsed: Boolean = true) =
        fallback.take(cell, isUsed, seconds.toDouble(), value, Conditions.NONE)

    /** Two, one and three readings: sample variances of 0.5 and 4, together (0.5 + 0 + 8) / 3. */
    @Test
    fun spreadIsNoLessThanThatOfAllCellsTogether() {
        listOf(8.0, 9.0).forEachIndexed { i, value -> take(0, i, value) }
        take(1, 2, 8.0)
        listOf(6.0, 8.0, 10.0).forEachIndexed { i, value -> take(2, 3 + i, value) }
        assertEquals(sqrt(8.5 / 3), fallback.spread(0), 1e-12)
        assertEquals(sqrt(8.5 / 3), fallback.spread(1), 1e-12)
        assertEquals(2.0, fallback.spread(2), 1e-12)
    }

    @Test
    fun anErrorCodeDoesNotSpreadItsCell() {
        listOf(8.0, 8.2, 8.4).forEachIndexed { i, value -> take(0, i, value) }
        take(0, 3, -9999.0, isUsed = false)
        assertEquals(0.2, fallback.spread(0), 1e-12)
    }
}
