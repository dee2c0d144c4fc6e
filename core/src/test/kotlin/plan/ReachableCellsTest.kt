package stillwater.plan

import org.junit.jupiter.api.Test
import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Interval
import kotlin.math.abs
import kotlin.random.Random
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

    /** What the cells beside [place] promise a sensor that shows [sensor], the most; −∞ where there is none. */
    private fun mostPromised(cells: ReachableCells, ways: Int, place: Int, sensor: Double): Double =
        cells.steps.take(ways).map { place + it }.filter { cells.widths[it] >= 0 }
            .maxOfOrNull { cells.widths[it] - abs(cells.middles[it] - sensor) } ?: Double.NEGATIVE_INFINITY

    @Test
    fun noCellPromisesMoreThanIsSaid() {
        val random = Random(20_261_125)
        for (trial in 0 until 400) {
            val ways = if (trial % 2 == 0) 4 else NeighbourOrder.ALL
            val grid = Grid.unit(1 + random.nextInt(9), 1 + random.nextInt(9))
            val scale = listOf(1.0, 1e-9, 1e9, 1e300)[trial % 4]
            val map = FieldMap(grid, Interval(-scale, scale))
            for (cell in 0 until grid.size) {
                val lower = (random.nextDouble() * 2 - 1) * scale
                map.setBounds(cell, lower, lower + (random.nextDouble() - 0.2) * scale / 2)
            }
            if (trial % 5 == 0) map.setBounds(random.nextInt(grid.size), Double.NEGATIVE_INFINITY, scale)
            if (trial % 7 == 0) {
                map.setBounds(random.nextInt(grid.size), Double.NEGATIVE_INFINITY, Double.POSITIVE_INFINITY)
            }
            val cells = ReachableCells(ways)
            cells.read(map, random.nextInt(grid.size), 1 + random.nextInt(6))
            for ((place, _) in placesOf(cells, grid)) {
                val middle = cells.middles[place]
                for (sensor in listOf(middle, middle * (1 + 1e-15), random.nextDouble() * scale, -3 * scale)) {
                    val most = mostPromised(cells, ways, place, sensor)
                    val gap = abs(sensor - middle)
                    assertFalse(most > cells.promisedBeside[place] + gap, "trial $trial, place $place, $sensor")
                    val isDull = cells.promisedBeside[place] <= 0 && gap <= cells.slack
                    assertFalse(isDull && most > 0, "trial $trial, place $place, $sensor")
                }
            }
        }
    }

    @Test
    fun whatIsSaidIsWhatCellsPromise() {
        val random = Random(20_261_126)
        val grid = Grid.unit(10, 10)
        val map = FieldMap(grid, Interval.UNIT)
        for (cell in 0 until grid.size) random.nextDouble().let { map.setBounds(cell, it / 2, it) }
        for (ways in listOf(4, NeighbourOrder.ALL)) {
            val cells = ReachableCells(ways)
            cells.read(map, 33, 5)
            for ((place, _) in placesOf(cells, grid)) {
                val most = mostPromised(cells, ways, place, cells.middles[place])
                // Twice the slack of 1e-12 of at most 2, and its rounding.
                assertEquals(most, cells.promisedBeside[place], 5e-12)
            }
        }
    }

    private companion object {
        const val SLOTS = 64
    }
}
