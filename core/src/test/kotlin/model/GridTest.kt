package stillwater.model

import io.kotest.property.Arb
import io.kotest.property.PropTestConfig
import io.kotest.property.arbitrary.int
import io.kotest.property.arbitrary.numericDouble
import io.kotest.property.checkAll
import kotlinx.coroutines.runBlocking
import org.junit.jupiter.api.Test
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.sin
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class GridTest {
    private val config = PropTestConfig(seed = 20_132, iterations = 1_000)

    @Test
    fun findsEveryCellAtItsCentreHoweverTheGridLies() = runBlocking<Unit> {
        checkAll(
            config,
            Arb.numericDouble(-PI, PI),
            Arb.numericDouble(0.01, 1_000.0),
            Arb.int(1, 40),
            Arb.int(1, 40),
        ) { rotation, side, columns, rows ->
            val grid = Grid(Position(-3e4, 2e4), columns, rows, side, 2 * side, rotation)
            for (cell in 0 until grid.size) {
                assertEquals(cell, grid.cellAt(grid.center(cell)), "seed ${config.seed}: $grid")
                assertEquals(cell, grid.index(grid.cell(cell)))
            }
        }
    }

    @Test
    fun hasCornersAroundTheCentreCounterClockwise() = runBlocking<Unit> {
        checkAll(config, Arb.numericDouble(-PI, PI), Arb.int(0, 11)) { rotation, cell ->
            val grid = Grid(Position(10.0, -20.0), 4, 3, 5.0, 2.0, rotation)
            val corners = grid.corners(cell)
            val center = grid.center(cell)
            assertEquals(center.x, corners.sumOf { it.x } / 4, 1e-9)
            assertEquals(center.y, corners.sumOf { it.y } / 4, 1e-9)
            val twiceArea = corners.indices.sumOf { i ->
                val (a, b) = corners[i] to corners[(i + 1) % 4]
                a.x * b.y - b.x * a.y
            }
            assertEquals(2 * 5.0 * 2.0, twiceArea, 1e-9)
        }
    }

    @Test
    fun givesAnEdgeToOneCellOnly() {
        val grid = Grid(Position(0.0, 0.0), 3, 2, 10.0)
        assertEquals(0, grid.cellAt(0.0, 0.0))
        assertEquals(1, grid.cellAt(10.0, 0.0))
        assertEquals(3, grid.cellAt(0.0, 10.0))
        assertEquals(Grid.OUTSIDE, grid.cellAt(30.0, 0.0))
        assertEquals(Grid.OUTSIDE, grid.cellAt(0.0, 20.0))
        assertEquals(Grid.OUTSIDE, grid.cellAt(-1e-9, 0.0))
        assertEquals(Grid.OUTSIDE, grid.cellAt(Double.NaN, 0.0))
        assertEquals(Grid.OUTSIDE, grid.cellAt(0.0, Double.POSITIVE_INFINITY))
    }

    @Test
    fun refusesWhatIsNoGrid() {
        val origin = Position(0.0, 0.0)
        assertFailsWith<IllegalArgumentException> { Grid(origin, 0, 1, 1.0) }
        assertFailsWith<IllegalArgumentException> { Grid(origin, 1, -1, 1.0) }
        assertFailsWith<IllegalArgumentException> { Grid(origin, 1, 1, 0.0) }
        assertFailsWith<IllegalArgumentException> { Grid(origin, 1, 1, 1.0, Double.NaN) }
        assertFailsWith<IllegalArgumentException> { Grid(origin, 1, 1, 1.0, rotation = Double.NaN) }
        assertFailsWith<IllegalArgumentException> { Grid(origin, 100_000, 100_000, 1.0) }
    }

    @Test
    fun aPlacesDistanceToItsCellsBorder() {
        val grid = Grid(Position(100.0, 50.0), 3, 2, cellWidth = 10.0, cellHeight = 4.0, rotation = 0.3)
        for ((along, across, expected) in listOf(
            Triple(5.0, 2.0, 2.0),
            Triple(11.0, 2.0, 1.0),
            Triple(19.5, 3.8, 0.2),
            Triple(0.0, 2.0, 0.0),
        )) {
            val x = 100 + cos(0.3) * along - sin(0.3) * across
            val y = 50 + sin(0.3) * along + cos(0.3) * across
            // Rounding of places some 100 m from the origin.
            assertEquals(expected, grid.distanceToBorder(x, y), 1e-12)
        }
        assertTrue(grid.distanceToBorder(Double.NaN, 0.0).isNaN())
    }
}
