package stillwater.plan

import org.junit.jupiter.api.Test
import stillwater.model.Grid
import stillwater.model.Position
import stillwater.property.between
import stillwater.property.drawn
import stillwater.property.forEvery
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class GridPartitionTest {
    private class Case(random: Random) {
        val grid =
            Grid(Position(random.between(-9.0, 9.0), 3.0), random.nextInt(1, 13), random.nextInt(1, 13), 2.0, 3.0, 0.7)
        val boats = random.nextInt(1, minOf(grid.size, 12) + 1)
        val weights = DoubleArray(grid.size) { if (random.nextInt(4) == 0) 0.0 else random.nextDouble() }

        override fun toString() = "${grid.columns} x ${grid.rows}, $boats boats, ${weights.toList()}"
    }

    @Test
    fun everyCellBelongsToExactlyOneBoatAndEveryBoatHasSome() = forEvery(drawn(::Case)) { case ->
        val regions = GridPartition.split(case.grid, case.boats, case.weights)
        assertEquals(case.boats, regions.size)
        for (cell in 0 until case.grid.size) {
            val column = cell % case.grid.columns
            val row = cell / case.grid.columns
            assertEquals(1, regions.count { it.contains(column, row) }, "cell $cell")
        }
        assertTrue(regions.all { it.size > 0 })
    }

    @Test
    fun aRegionsGridLiesWhereItsCellsDo() = forEvery(drawn(::Case)) { case ->
        for (region in GridPartition.split(case.grid, case.boats, case.weights)) {
            val own = region.gridOf(case.grid)
            for (cell in 0 until own.size) {
                val whole = case.grid.cellAt(own.center(cell))
                assertEquals(region.column + cell % own.columns, whole % case.grid.columns)
                assertEquals(region.row + cell / own.columns, whole / case.grid.columns)
            }
        }
    }

    @Test
    fun equalCellsAreSharedAsEvenlyAsColumnsAndRowsAllow() {
        val grid = Grid.unit(10, 10)
        val even = DoubleArray(100) { 1.0 }
        assertEquals(List(4) { 25 }, GridPartition.split(grid, 4, even).map { it.size })
        assertEquals(List(2) { 50 }, GridPartition.split(grid, 2, even).map { it.size })
        // Of 3 boats one gets 3 of 10 columns, the others halve the rest.
        assertEquals(listOf(30, 35, 35), GridPartition.split(grid, 3, even).map { it.size }.sorted())
        assertEquals(100, GridPartition.split(grid, 100, even).size)
    }

    @Test
    fun aCutDividesTheWeightUpToOneColumnOrRow() = forEvery(drawn(::Case)) { case ->
        if (case.grid.columns < 2 || case.weights.sum() == 0.0) return@forEvery
        val regions = GridPartition.split(case.grid, 2, case.weights)
        val one = (0 until case.grid.size).filter {
            regions[0].contains(it % case.grid.columns, it / case.grid.columns)
        }.sumOf { case.weights[it] }
        val heaviestColumn = (0 until case.grid.columns).maxOf { column ->
            (0 until case.grid.rows).sumOf { case.weights[it * case.grid.columns + column] }
        }
        // Cutting on either side of a column moves its weight; the best cut is at most half of one away.
        assertTrue(kotlin.math.abs(one - case.weights.sum() / 2) <= heaviestColumn / 2 + 1e-9, "$regions")
    }

    @Test
    fun refusesWhatCannotBeDivided() {
        val grid = Grid.unit(2, 2)
        assertFailsWith<IllegalArgumentException> { GridPartition.split(grid, 5, DoubleArray(4)) }
        assertFailsWith<IllegalArgumentException> { GridPartition.split(grid, 0, DoubleArray(4)) }
        assertFailsWith<IllegalArgumentException> { GridPartition.split(grid, 2, DoubleArray(3)) }
        assertFailsWith<IllegalArgumentException> { GridPartition.split(grid, 2, doubleArrayOf(1.0, -1.0, 0.0, 0.0)) }
    }
}
