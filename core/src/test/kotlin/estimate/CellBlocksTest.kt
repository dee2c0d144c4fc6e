package stillwater.estimate

import stillwater.model.Grid
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class CellBlocksTest {
    private val grid = Grid.unit(40, 40)

    @Test
    fun noBlockWaitsForEverWhereDataComeFasterThanBlocksAreDone() {
        val blocks = CellBlocks(grid)
        val cell = 20 * 40 + 20
        blocks.allStale()
        // Each time one is taken, the nine around the boat are out of date again.
        val taken = List(3 * blocks.size) { blocks.take(cell).also { blocks.stale(cell, 1) } }
        assertEquals((0 until blocks.size).toSet(), taken.toSet())
        val own = blocks.blockOf(cell)
        assertTrue(taken.count { it == own } >= blocks.size, "the boat's own block: ${taken.count { it == own }}")
    }

    @Test
    fun eachBlockIsTakenOnceAndTheBoatsOwnFirst() {
        val blocks = CellBlocks(grid)
        val cell = 20 * 40 + 20
        assertEquals(-1, blocks.take(cell))
        blocks.allStale()
        val taken = List(blocks.size) { blocks.take(cell) }
        assertEquals(blocks.blockOf(cell), taken[0])
        assertEquals((0 until blocks.size).toList(), taken.sorted())
        assertEquals(0 to -1, blocks.staleCount to blocks.take(cell))
    }

    @Test
    fun whatLiesBeyondABlocksDataDoesNotMatterToIt() {
        val blocks = CellBlocks(grid)
        blocks.looks(0, 5)
        // The first block ends at column 7: column 12 is 5 cells off, column 13 is 6.
        blocks.stale(13, 1)
        val others = List(blocks.staleCount) { blocks.take(13) }
        assertTrue(0 !in others && 1 in others, "$others")
        blocks.stale(12, 1)
        assertTrue(0 in List(blocks.staleCount) { blocks.take(13) })
    }

    @Test
    fun aCellHasItsPlaceInItsBlock() {
        val odd = CellBlocks(Grid.unit(13, 21))
        val seen = HashSet<Int>()
        for (block in 0 until odd.size) {
            val places = HashSet<Int>()
            odd.forEachCell(block) { cell, place ->
                assertEquals(block, odd.blockOf(cell))
                assertEquals(place, odd.placeOf(cell))
                assertTrue(place in 0 until odd.mostCells && places.add(place) && seen.add(cell))
            }
        }
        assertEquals(13 * 21, seen.size)
    }
}
