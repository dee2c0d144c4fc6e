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

    /** The place of the boat's own cell. */
    var start: Int = 0
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
            var cell = (firstRow + r) * grid.columns + firstColumn
            var place = (r + 1) * stride + 1
            repeat(columns) { readCell(map, cell++, place++) }
        }
        start = (row - firstRow + 1) * stride + column - firstColumn + 1
        for (direction in steps.indices) {
            steps[direction] = NeighbourOrder.ROW_STEPS[direction] * stride + NeighbourOrder.COLUMN_STEPS[direction]
        }
        for (r in 0 until rows) {
            val first = (r + 1) * stride + 1
            for (place in first until first + columns) widestBeside[place] = widestBeside(place)
        }
    }

    private fun widestBeside(place: Int): Double {
        var widest = RIM
        for (direction in 0 until ways) {
            val width = widths[place + steps[direction]]
            if (width > widest) widest = width
        }
        return widest
    }

    private fun readCell(map: FieldMap, cell: Int, place: Int) {
        val lower = map.lower(cell)
        val upper = map.upper(cell)
        val width = upper - lower
        widths[place] = if (width > 0 && width.isFinite()) width else 0.0
        middles[place] = lower / 2 + upper / 2
    }

    /** Index in the map's grid of the cell at [place]. */
    fun cell(place: Int): Int =
        (firstRow + place / stride - 1) * grid.columns + firstColumn + place % stride - 1

    companion object {
        /** The width of a place that holds no cell. */
        const val RIM: Double = -1.0
    }
}
