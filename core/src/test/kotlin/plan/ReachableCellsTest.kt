package stillwater.plan

import org.junit.jupiter.api.Test
import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Interval
import kotlin.math.abs
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class ReachableCellsTest {
    /** Places that hold a cell, each with its cell. */
    private fun placesOf(cells: ReachableCells, grid: Grid): List<Pair<Int, Int>> =
        (0 until cells.places).filter { cells.widths[it] >= 0 }.map { it to cells.cell(it) }
            .also { places -> assertTrue(places.all { it.second in 0 until grid.size }) }

    /** Whether two cells that one path of [reach] moves may come to in as many moves, odd or even, share a slot. */
    private fun sharesSlots(cells: ReachableCells, grid: Grid, reach: Int): Boolean {
        val places = placesOf(cells, grid).map { (place, cell) -> place to grid.cell(cell) }
        return places.any { (place, cell) ->
            places.any { (other, otherCell) ->
                val moves = abs(cell.column - otherCell.column) + abs(cell.row - otherCell.row)
                val isSameSlot = ((place ushr 1) - (other ushr 1)) % SLOTS == 0
                place != other && isSameSlot && moves <= reach && moves % 2 == 0
            }
        }
    }

    @Test
    fun slotsThatAreSaidToTellPlacesApartDo() {
        var certain = 0
        var shared = 0
        for (columns in 1..40 step 3) {
            for (rows in listOf(1, 2, 10, 31)) {
                for (reach in listOf(1, 5, 10, 20, 60)) {
                    val grid = Grid.unit(columns, rows)
                    val cells = ReachableCells(4)
                    cells.read(FieldMap(grid, Interval.UNIT), grid.size / 2, reach)
                    val shares = sharesSlots(cells, grid, reach)
                    val isCertain = cells.uncertainVisits == ReachableCells.MANY_VISITS
                    assertFalse(shares && isCertain, "$columns x $rows cells, $reach moves")
                    if (isCertain) certain++
                    if (shares) shared++
                }
            }
        }
        assertTrue(certain > 100 && shared > 20, "$certain windows told apart, $shared with shared slots")
    }

    @Test
    fun theReportsWindowTellsPlacesApart() {
        val cells = ReachableCells(4)
        cells.read(FieldMap(Grid.unit(10, 10), Interval.UNIT), 55, 10)
        assertEquals(ReachableCells.MANY_VISITS, cells.uncertainVisits)
    }

    @Test
    fun cornersAreCountedWithCare() {
        val cells = ReachableCells(NeighbourOrder.ALL)
        cells.read(FieldMap(Grid.unit(10, 10), Interval.UNIT), 55, 10)
        assertEquals(1, cells.uncertainVisits)
    }

    private companion object {
        const val SLOTS = 64
    }
}
