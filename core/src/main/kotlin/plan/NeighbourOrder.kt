package stillwater.plan

import stillwater.model.Grid
import kotlin.random.Random

/**
 * Goes through a cell's neighbours in a random order, so that no direction is preferred. Allocates nothing.
 *
 * @param random where the order comes from. Retained.
 * @property ways 4 for the cells that share an edge, 8 for those that share a corner too.
 */
internal class NeighbourOrder(private val random: Random, val ways: Int) {
    /** The directions in their present order, [BITS] bits each, the first in the lowest: shuffled in a register. */
    private var directions = (0 until ways).fold(0) { packed, direction -> packed or (direction shl BITS * direction) }

    /** Calls [visit] with each neighbour of [cell] that [grid] has. */
    inline fun forEach(grid: Grid, cell: Int, visit: (Int) -> Unit) {
        val column = cell % grid.columns
        val row = cell / grid.columns
        forEach { direction ->
            val toColumn = column + COLUMN_STEPS[direction]
            val toRow = row + ROW_STEPS[direction]
            val inGrid = toColumn >= 0 && toColumn < grid.columns && toRow >= 0 && toRow < grid.rows
            if (inGrid) visit(toRow * grid.columns + toColumn)
        }
    }

    /**
     * Calls [visit] with each direction of [packed], which is an order that [drawn] gave: the place of its step in
     * [COLUMN_STEPS] and [ROW_STEPS].
     */
    inline fun forEach(packed: Int = drawn(), visit: (Int) -> Unit) {
        var rest = packed
        repeat(ways) {
            visit(rest and MASK)
            rest = rest ushr BITS
        }
    }

    /** Calls [visit] with each direction in the order of their numbers; the first four are written out. */
    inline fun forEachAsNumbered(visit: (Int) -> Unit) {
        visit(0)
        visit(1)
        visit(2)
        visit(3)
        for (direction in 4 until ways) visit(direction)
    }

    /** Draws the next order. Fisher and Yates: every order is as likely. */
    fun drawn(): Int {
        var packed = directions
        for (last in ways - 1 downTo 4) packed = swapped(packed, last, random.nextInt(last + 1))
        // Bounds that the compiler knows are drawn without a division.
        packed = swapped(packed, 3, random.nextInt(4))
        packed = swapped(packed, 2, random.nextInt(3))
        packed = swapped(packed, 1, random.nextInt(2))
        directions = packed
        return packed
    }

    private fun swapped(packed: Int, one: Int, other: Int): Int {
        val difference = (packed ushr BITS * one xor (packed ushr BITS * other)) and MASK
        return packed xor (difference shl BITS * one) xor (difference shl BITS * other)
    }

    companion object {
        /** All ways there are. */
        const val ALL: Int = 8

        /** Bits of a direction in an order, and those of the first. */
        const val BITS: Int = 4
        const val MASK: Int = 15

        // West, east, south, north; then the corners.
        val COLUMN_STEPS: IntArray = intArrayOf(-1, 1, 0, 0, -1, -1, 1, 1)
        val ROW_STEPS: IntArray = intArrayOf(0, 0, -1, 1, -1, 1, -1, 1)
    }
}
