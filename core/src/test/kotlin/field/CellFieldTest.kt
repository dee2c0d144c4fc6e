package stillwater.field

import org.junit.jupiter.api.Test
import stillwater.model.BoatTime
import stillwater.model.Grid
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class CellFieldTest {
    private val grid = Grid.unit(2, 2)
    private val truths = doubleArrayOf(1.0, 2.0, 3.0, 4.0)

    @Test
    fun isConstantWithinACellAndInTime() {
        val field = CellField(grid, truths)
        for ((x, y, truth) in listOf(
            Triple(0.0, 0.0, 1.0),
            Triple(0.99, 0.99, 1.0),
            Triple(1.0, 0.5, 2.0),
            Triple(0.5, 1.0, 3.0),
            Triple(1.5, 1.5, 4.0),
        )) {
            for (time in listOf(0.0, 1.6e9)) assertEquals(truth, field.truth(x, y, BoatTime(time)), 0.0)
        }
        for (cell in 0 until grid.size) assertEquals(truths[cell], field.truth(cell), 0.0)
    }

    @Test
    fun isNotDefinedOutside() {
        val field = CellField(grid, truths)
        for ((x, y) in listOf(-0.1 to 0.5, 2.0 to 0.5, 0.5 to 2.0, Double.NaN to 0.5)) {
            assertTrue(field.truth(x, y, BoatTime(0.0)).isNaN(), "at $x, $y")
        }
    }

    @Test
    fun copiesItsTruths() {
        val source = truths.copyOf()
        val field = CellField(grid, source)
        source[0] = 9.0
        assertEquals(1.0, field.truth(0), 0.0)
    }

    @Test
    fun needsOneFiniteValuePerCell() {
        val error = assertFailsWith<IllegalArgumentException> { CellField(grid, doubleArrayOf(1.0)) }
        assertEquals("truths (1 values) must have one value per cell (4)", error.message)
        assertFailsWith<IllegalArgumentException> { CellField(grid, doubleArrayOf(1.0, 2.0, 3.0, Double.NaN)) }
    }
}
