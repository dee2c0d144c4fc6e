package stillwater.plan

import stillwater.field.FieldMap
import stillwater.model.Grid

/**
 * What the bounded planner asks of a map, for the cells a boat can reach from its own, in arrays that the search reads
 * without looking for a border: around the reachable cells lies a rim of places that hold no cell.
 *
 * Cells have numbers of their own here, [places]; neighbours lie at fixed distances from each other. The arrays are
 * used again for every plan. No call allocates once they have grown.
 *
 * @param ways neighbours of a cell: 4 that share an edge, or 8.
 */
internal class ReachableCells(private val ways: Int) {
    /** The map's grid. */
    lateinit var grid: Grid
        private set
    private var firstColumn = 0
    private var firstRow = 0

    /** Places in a row, the rim's two included. */
    private var stride = 0

    /** Number of places, the rim included. */
    var places: Int = 0
        private set

    /** Width of each place's bounds, sensor units; 0 where they crossed or have no finite width, [RIM] in the rim. */
    var widths: DoubleArray = DoubleArray(0)
        private set

    /** Midpoint of each place's bounds, sensor units. */
    var middles: DoubleArray = DoubleArray(0)
        private set

    /** The widest bounds beside each place that holds a cell, sensor units; less than 0 where there is no cell. */
    var widestBeside: DoubleArray = DoubleArray(0)
        private set

    /** The widest bounds of all places, sensor units. */
    var widest: Double = 0.0
        private set

    /** The place of the boat's own cell. */
    var start: Int = 0
        private set

    /**
     * A path's places are told apart by the last six bits of the place shifted by this, its slot. From edge to edge a
     * boat comes to a place's neighbours in every other move only, so that they may have the same.
     */
    val slotShift: Int = if (ways == NeighbourOrder.ALL) 0 else 1

    /** The visits at a slot from which on they need not all be of one place of a path. */
    var uncertainVisits: Int = 1
        private set

    /** How far the neighbours of a place are from it: west, east, south, north, then the corners. */
    val steps: IntArray = IntArray(NeighbourOrder.ALL)

    /** Reads the cells of [map] within [reach] columns and rows of the cell [from]. */
    fun read(map: FieldMap, from: Int, reach: Int) {
        val grid = map.grid
        this.grid = grid
        val column = from % grid.columns
        val row = from / grid.columns
        firstColumn = maxOf(0, column - reach)
        firstRow = maxOf(0, row - reach)
        // Not column + reach: that may overflow.
        val columns = minOf(grid.columns - column - 1, reach) + column - firstColumn + 1
        val rows = minOf(grid.rows - row - 1, reach) + row - firstRow + 1
        stride = columns + 2
        places = stride * (rows + 2)
        if (widths.size < places) {
            widths = DoubleArray(places)
            middles = DoubleArray(places)
            widestBeside = DoubleArray(places)
        }
        widths.fill(RIM, 0, places)
        for (r in 0 until rows) {
            readRow(map, (firstRow + r) * grid.columns + firstColumn, (r + 1) * stride + 1, columns)
        }
        start = (row - firstRow + 1) * stride + column - firstColumn + 1
        for (direction in steps.indices) {
            steps[direction] = NeighbourOrder.ROW_STEPS[direction] * stride + NeighbourOrder.COLUMN_STEPS[direction]
        }
        for (r in 0 until rows) widestBesideRow((r + 1) * stride + 1, columns)
        val apart = (rows - 1) * stride + columns - 1
        uncertainVisits = if (slotShift == 1 && slotsDiffer(apart, reach)) MANY_VISITS else 1
        widest = widestOf(widths)
    }

    private fun readRow(map: FieldMap, cell: Int, place: Int, columns: Int) {
        val widths = widths
        val middles = middles
        for (i in 0 until columns) {
            val lower = map.lower(cell + i)
            val upper = map.upper(cell + i)
            // Which bounds have crossed is anybody's guess, the processor's too: no jump depends on it.
            val width = maxOf(upper - lower, 0.0)
            widths[place + i] = if (width <= Double.MAX_VALUE) width else 0.0
            middles[place + i] = lower / 2 + upper / 2
        }
    }

    /** By a jump, which is foreseen: maxima would wait for each other. */
    private fun widestOf(widths: DoubleArray): Double {
        var most = 0.0
        for (place in 0 until places) if (widths[place] > most) most = widths[place]
        return most
    }

    /** Without a jump as well. */
    private fun widestBesideRow(first: Int, columns: Int) {
        val widths = widths
        val stride = stride
        for (place in first until first + columns) {
            val inRow = maxOf(widths[place - 1], widths[place + 1])
            widestBeside[place] = maxOf(inRow, maxOf(widths[place - stride], widths[place + stride]))
        }
        if (ways == NeighbourOrder.ALL) {
            for (place in first until first + columns) {
                val below = maxOf(widths[place - stride - 1], widths[place - stride + 1])
                val above = maxOf(widths[place + stride - 1], widths[place + stride + 1])
                widestBeside[place] = maxOf(widestBeside[place], maxOf(below, above))
            }
        }
    }

    /**
     * Whether no two cells with the same slot are on one path of [reach] moves from edge to edge, and as many moves from
     * each other as a path between them has, odd or even. Cells' places differ by [apart] at the most.
     */
    private fun slotsDiffer(apart: Int, reach: Int): Boolean {
        // Halves are the same modulo 64 where the places differ by a multiple of 128, or by one more or less.
        for (multiple in SLOTS * 2..apart + 1 step SLOTS * 2) {
            for (difference in multiple - 1..multiple + 1) {
                val rows = difference / stride
                val columns = difference % stride
                if (minOf(rows + columns, rows + 1 + stride - columns) <= reach) return false
            }
        }
        return true
    }

    /** Index in the map's grid of the cell at [place]. */
    fun cell(place: Int): Int =
        (firstRow + place / stride - 1) * grid.columns + firstColumn + place % stride - 1

    companion object {
        /** The width of a place that holds no cell. */
        const val RIM: Double = -1.0

        private const val SLOTS = 64

        /** Visits that the planner's tree does not count any more. */
        const val MANY_VISITS: Int = 7
    }
}
