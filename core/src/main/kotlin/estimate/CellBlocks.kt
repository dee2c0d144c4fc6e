package stillwater.estimate

import stillwater.model.Grid

/**
 * A grid cut into blocks of cells, each of which is predicted from the cells with data nearest to it.
 *
 * A small grid is one block with all of its data. Else a block has [SIDE] × [SIDE] cells and the [NEAREST] cells with
 * data that are nearest to it. No call allocates.
 */
internal class CellBlocks(private val grid: Grid) {
    private val isWhole = grid.size <= WHOLE

    /** Cells with data that one block is predicted from at most. */
    val capacity: Int = if (isWhole) grid.size else NEAREST
    private val width = if (isWhole) grid.columns else SIDE
    private val height = if (isWhole) grid.rows else SIDE
    private val across = (grid.columns + width - 1) / width
    private val along = (grid.rows + height - 1) / height

    /** Number of blocks. */
    val size: Int = across * along
    private val isStale = BooleanArray(size)
    private val rings = IntArray(maxOf(grid.columns, grid.rows) + 1)
    private var next = 0

    /** Number of blocks whose prediction is out of date. */
    var staleCount: Int = 0
        private set

    /** All blocks are out of date. */
    fun allStale() {
        isStale.fill(true)
        staleCount = size
    }

    /** Cell [cell] has other data: the blocks within [reach] blocks of its own are out of date. */
    fun stale(cell: Int, reach: Int) {
        val column = cell % grid.columns / width
        val row = cell / grid.columns / height
        for (r in maxOf(0, row - reach)..minOf(along - 1, row + reach)) {
            for (c in maxOf(0, column - reach)..minOf(across - 1, column + reach)) {
                if (isStale[r * across + c]) continue
                isStale[r * across + c] = true
                staleCount++
            }
        }
    }

    /**
     * The next block to predict again, now no longer out of date; −1 if there is none. First the one around [cell] and
     * those beside it, then all in turn.
     */
    fun take(cell: Int): Int {
        if (staleCount == 0) return -1
        val column = cell % grid.columns / width
        val row = cell / grid.columns / height
        var found = -1
        for (r in maxOf(0, row - 1)..minOf(along - 1, row + 1)) {
            for (c in maxOf(0, column - 1)..minOf(across - 1, column + 1)) {
                val isOwn = r == row && c == column
                if (isStale[r * across + c] && (found < 0 || isOwn)) found = r * across + c
            }
        }
        while (found < 0) {
            if (isStale[next]) found = next
            next = (next + 1) % size
        }
        isStale[found] = false
        staleCount--
        return found
    }

    /** The block that holds [cell]. */
    fun blockOf(cell: Int): Int = cell / grid.columns / height * across + cell % grid.columns / width

    /** First column of [block]. */
    fun firstColumn(block: Int): Int = block % across * width

    /** First row of [block]. */
    fun firstRow(block: Int): Int = block / across * height

    /** The column after the last of [block]. */
    fun endColumn(block: Int): Int = minOf(grid.columns, firstColumn(block) + width)

    /** The row after the last of [block]. */
    fun endRow(block: Int): Int = minOf(grid.rows, firstRow(block) + height)

    /**
     * Hands the cells with data nearest to [block] to [regression], which is cleared.
     *
     * @param cells the cells with data, the first [count] of it. Not modified.
     * @param values their scaled values, by cell.
     * @param variances their error variances, by cell.
     */
    fun gather(
        block: Int,
        cells: IntArray,
        count: Int,
        values: DoubleArray,
        variances: DoubleArray,
        regression: CellRegression,
    ) {
        regression.clear()
        if (count <= capacity) {
            for (k in 0 until count) regression.add(cells[k], values[cells[k]], variances[cells[k]])
            return
        }
        rings.fill(0)
        for (k in 0 until count) rings[distance(block, cells[k])]++
        var last = 0
        var before = 0
        while (before + rings[last] <= capacity) before += rings[last++]
        // Of the last ring there is no room for all: every so manieth.
        val inLast = rings[last]
        val room = capacity - before
        var seen = 0
        for (k in 0 until count) {
            val cell = cells[k]
            val ring = distance(block, cell)
            val isTaken = ring < last || (ring == last && seen * room / inLast != ++seen * room / inLast)
            if (isTaken) regression.add(cell, values[cell], variances[cell])
        }
    }

    /** Cells from [cell] to the block, the longer way of the two axes; 0 inside. */
    private fun distance(block: Int, cell: Int): Int {
        val column = cell % grid.columns
        val row = cell / grid.columns
        val columns = maxOf(firstColumn(block) - column, column - endColumn(block) + 1, 0)
        val rows = maxOf(firstRow(block) - row, row - endRow(block) + 1, 0)
        return maxOf(columns, rows)
    }

    companion object {
        /** Cells of the largest grid that is one block. */
        private const val WHOLE = 144
        private const val SIDE = 8

        /** Cells with data that a block of a larger one is predicted from at most. */
        const val NEAREST = 96
    }
}
