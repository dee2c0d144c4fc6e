package stillwater.plan

import stillwater.field.FieldMap
import stillwater.model.Grid
import kotlin.math.abs

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

    /** Midpoint of each place's bounds, sensor units; 0 in the rim. */
    var middles: DoubleArray = DoubleArray(0)
        private set

    /**
     * The most that a cell beside each place promises, sensor units: its width less the distance of its middle from what
     * the sensor shows, for a sensor that is within [slack] of the place's own middle. One that is farther away is
     * promised no more than this and that distance. NaN or infinite where something is not finite.
     */
    var promisedBeside: DoubleArray = DoubleArray(0)
        private set

    /** Far above all rounding in a promise, sensor units; NaN where a middle is not finite. */
    var slack: Double = 0.0
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
            promisedBeside = DoubleArray(places)
        }
        widths.fill(RIM, 0, places)
        middles.fill(0.0, 0, places)
        for (r in 0 until rows) {
            readRow(map, (firstRow + r) * grid.columns + firstColumn, (r + 1) * stride + 1, columns)
        }
        start = (row - firstRow + 1) * stride + column - firstColumn + 1
        for (direction in steps.indices) {
            steps[direction] = NeighbourOrder.ROW_STEPS[direction] * stride + NeighbourOrder.COLUMN_STEPS[direction]
        }
        val apart = (rows - 1) * stride + columns - 1
        uncertainVisits = if (slotShift == 1 && slotsDiffer(apart, reach)) MANY_VISITS else 1
        widest = most(widths)
        slack = SLACK * (largest(middles) + widest)
        promisedBeside.fill(Double.NEGATIVE_INFINITY, 0, places)
        lookBeside(1, stride)
        if (ways == NeighbourOrder.ALL) lookBeside(stride - 1, stride + 1)
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
    private fun most(widths: DoubleArray): Double {
        var most = 0.0
        for (place in 0 until places) if (widths[place] > most) most = widths[place]
        return most
    }

    /** How far from 0 a middle is at the most; NaN where one is not finite. */
    private fun largest(middles: DoubleArray): Double {
        var most = 0.0
        for (place in 0 until places) {
            val size = abs(middles[place])
            if (!(size <= most)) most = if (size <= Double.MAX_VALUE) size else return Double.NaN
        }
        return most
    }

    /**
     * Looks what the places that are [one] and [other] places before and after each place promise. Goes through the rim
     * too, where nobody asks: one loop, without a jump, does several places at once.
     */
    private fun lookBeside(one: Int, other: Int) {
        val widths = widths
        val middles = middles
        val promised = promisedBeside
        val twice = 2 * slack
        for (place in stride + 1 until places - stride - 1) {
            val middle = middles[place]
            val first = widths[place - one] - abs(middles[place - one] - middle)
            val second = widths[place + one] - abs(middles[place + one] - middle)
            val third = widths[place - other] - abs(middles[place - other] - middle)
            val fourth = widths[place + other] - abs(middles[place + other] - middle)
            promised[place] = maxOf(promised[place], maxOf(maxOf(first, second), maxOf(third, fourth)) + twice)
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

        /** Of the widest bounds and the middle farthest from 0; sums of three such numbers round by less than 1e-15. */
        private const val SLACK = 1e-12

        /** Visits that the planner's tree does not count any more. */
        const val MANY_VISITS: Int = 7
    }
}
