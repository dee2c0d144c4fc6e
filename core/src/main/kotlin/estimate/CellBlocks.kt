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

    /** Columns of the grid. */
    val columns: Int = grid.columns

    /** Cells with data that one block is predicted from at most. */
    val capacity: Int = if (isWhole) grid.size else NEAREST
    private val width = if (isWhole) grid.columns else SIDE
    private val height = if (isWhole) grid.rows else SIDE
    private val across = (grid.columns + width - 1) / width
    private val along = (grid.rows + height - 1) / height

    /** Number of blocks. */
    val size: Int = across * along

    /** Cells of the largest block. */
    val mostCells: Int = width * height
    private val isStale = BooleanArray(size)

    /** How far off a block's farthest data are, cells: nothing beyond changes its prediction. */
    private val reaches = IntArray(size) { Int.MAX_VALUE }
    private val rings = IntArray(maxOf(grid.columns, grid.rows) + 1)
    private var next = 0
    private var nextBeside = 0
    private var turn = 0

    /** Number of blocks whose prediction is out of date. */
    var staleCount: Int = 0
        private set

    /** All blocks are out of date. */
    fun allStale() {
        isStale.fill(true)
        staleCount = size
    }

    /** Cell [cell] has other data: the blocks within [reach] blocks of its own that look so far are out of date. */
    fun stale(cell: Int, reach: Int) {
        val column = cell % grid.columns / width
        val row = cell / grid.columns / height
        for (r in maxOf(0, row - reach)..minOf(along - 1, row + reach)) {
            for (c in maxOf(0, column - reach)..minOf(across - 1, column + reach)) {
                val block = r * across + c
                if (isStale[block] || distance(block, cell) > reaches[block]) continue
                isStale[block] = true
                staleCount++
            }
        }
    }

    /**
     * The next block to predict again, now no longer out of date; −1 if there is none. By turns the one around [cell], one
     * beside it and one of all: where data come faster than blocks are done, none waits for ever.
     */
    fun take(cell: Int): Int {
        turn = if (staleCount == 0) 0 else (turn + 1) % TURNS
        if (staleCount == 0) return NONE
        val own = blockOf(cell)
        var found = NONE
        if (turn == OWN && isStale[own]) found = own
        if (turn != ALL && found == NONE) found = beside(own)
        if (turn != ALL && found == NONE && isStale[own]) found = own
        while (found == NONE) {
            next = (next + 1) % size
            if (isStale[next]) found = next
        }
        isStale[found] = false
        staleCount--
        return found
    }

    /** The next of those beside [own] that is out of date; −1 if there is none. */
    private fun beside(own: Int): Int {
        repeat(AROUND) {
            nextBeside = (nextBeside + 1) % AROUND
            val column = own % across + nextBeside % SPAN - 1
            val row = own / across + nextBeside / SPAN - 1
            if (column in 0 until across && row in 0 until along) {
                val block = row * across + column
                if (block != own && isStale[block]) return block
            }
        }
        return NONE
    }

    /** The block that holds [cell]. */
    fun blockOf(cell: Int): Int = cell / grid.columns / height * across + cell % grid.columns / width

    /** Where in its block [cell] is, row by row: 0 to [mostCells] − 1. */
    fun placeOf(cell: Int): Int = cell / grid.columns % height * width + cell % grid.columns % width

    /** Does [action] with each cell of [block] and its place in it. */
    inline fun forEachCell(block: Int, action: (cell: Int, place: Int) -> Unit) {
        for (row in firstRow(block) until endRow(block)) {
            for (column in firstColumn(block) until endColumn(block)) {
                val cell = row * columns + column
                action(cell, placeOf(cell))
            }
        }
    }

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
     * @return how far off the farthest of them are, cells; no limit where it is all there are.
     */
    fun gather(
        block: Int,
        cells: IntArray,
        count: Int,
        values: DoubleArray,
        variances: DoubleArray,
        regression: CellRegression,
    ): Int {
        regression.clear()
        if (count <= capacity) {
            for (k in 0 until count) regression.add(cells[k], values[cells[k]], variances[cells[k]])
            return Int.MAX_VALUE
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
        return last
    }

    /** [block] is predicted from data at most [reach] cells off. */
    fun looks(block: Int, reach: Int) {
        reaches[block] = reach
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
        private const val NONE = -1

        /** Turns of [take]: the own block, one beside it, any. */
        private const val TURNS = 3
        private const val OWN = 1
        private const val ALL = 0
        private const val SPAN = 3
        private const val AROUND = SPAN * SPAN

        /** Cells of the largest grid that is one block. */
        const val WHOLE = 144
        private const val SIDE = 8

        /** Cells with data that a block of a larger one is predicted from at most. */
        const val NEAREST = 96
    }
}
