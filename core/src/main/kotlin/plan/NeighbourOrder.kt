package stillwater.plan

import stillwater.model.Grid
import kotlin.random.Random

/**
 * Goes through a cell's neighbours in a random order, so that no direction is preferred. Allocates nothing.
 *
 * @param random where the order comes from. Retained.
 * @param ways 4 for the cells that share an edge, 8 for those that share a corner too.
 */
internal class NeighbourOrder(private val random: Random, ways: Int) {
    private val directions = IntArray(ways) { it }

    /** Calls [visit] with each neighbour of [cell] that [grid] has. */
    inline fun forEach(grid: Grid, cell: Int, visit: (Int) -> Unit) {
        val column = cell % grid.columns
        val row = cell / grid.columns
        shuffle()
        for (direction in directions) {
            val toColumn = column + COLUMN_STEPS[direction]
            val toRow = row + ROW_STEPS[direction]
            val inGrid = toColumn >= 0 && toColumn < grid.columns && toRow >= 0 && toRow < grid.rows
            if (inGrid) visit(toRow * grid.columns + toColumn)
        }
    }

    /** Fisher and Yates: every order is as likely. */
    private fun shuffle() {
        for (last in directions.lastIndex downTo 1) {
            val other = random.nextInt(last + 1)
            val direction = directions[last]
            directions[last] = directions[other]
            directions[other] = direction
        }
    }

    companion object {
        // West, east, south, north; then the corners.
        private val COLUMN_STEPS = intArrayOf(-1, 1, 0, 0, -1, -1, 1, 1)
        private val ROW_STEPS = intArrayOf(0, 0, -1, 1, -1, 1, -1, 1)
    }
}
