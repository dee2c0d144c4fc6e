package stillwater.plan

import stillwater.field.FieldMap
import stillwater.model.Grid
import kotlin.math.sqrt

/**
 * What is left of each cell's uncertainty along a path that is tried out, and taken back.
 *
 * Uncertainty is the width of the bounds, sensor units. Reusable; no allocation but where it grows.
 */
internal class PathGains {
    private var grid: Grid? = null
    private var widths = DoubleArray(0)
    private var visits = IntArray(0)

    /** What a first visit leaves of the widths around: √(1 − ρ²), row-major, −[reach]..[reach] either way. */
    private val leaves = DoubleArray(SPAN * SPAN)
    private var reach = 0

    /** What was changed on the path: cells and their widths before. */
    private var changed = IntArray(64)
    private var before = DoubleArray(64)
    private var changes = 0

    /** The widest width. */
    var widest: Double = 0.0
        private set

    /** Starts from what [map] says. */
    fun begin(map: FieldMap) {
        if (widths.size < map.grid.size) {
            widths = DoubleArray(map.grid.size)
            visits = IntArray(map.grid.size)
        }
        grid = map.grid
        changes = 0
        widest = 0.0
        // Infinite bounds say as much as the widest numbers.
        for (cell in 0 until map.grid.size) {
            val width = map.upper(cell) - map.lower(cell)
            widths[cell] = if (width > 0) minOf(width, WIDEST) else 0.0
            visits[cell] = map.visits(cell)
            if (widths[cell] > widest) widest = widths[cell]
        }
        val correlation = map.correlation
        reach = 0
        if (correlation == null) return
        for (rows in -REACH..REACH) {
            for (columns in -REACH..REACH) {
                val rho = correlation.between(columns, rows)
                val left = if (rho * rho < LEAST || rho.isNaN()) 1.0 else sqrt(maxOf(0.0, 1 - rho * rho))
                leaves[(rows + REACH) * SPAN + columns + REACH] = left
                if (left < 1) reach = maxOf(reach, maxOf(kotlin.math.abs(rows), kotlin.math.abs(columns)))
            }
        }
    }

    /** The width of [cell] now. */
    fun width(cell: Int): Double = widths[cell]

    /** Where the path stands, for [undo]. */
    fun mark(): Int = changes

    /** Takes back all visits after [mark]. */
    fun undo(mark: Int) {
        while (changes > mark) {
            changes--
            val cell = changed[changes]
            if (cell >= 0) widths[cell] = before[changes] else visits[-1 - cell]--
        }
    }

    /** What the visit of [cell] is expected to take away from all widths. */
    fun visit(cell: Int): Double {
        val count = visits[cell]
        val own = widths[cell]
        val left = if (count == 0) 0.0 else sqrt(count / (count + 1.0))
        var gain = change(cell, left)
        keep(-1 - cell, 0.0)
        visits[cell]++
        if (count == 0 && reach > 0) gain += around(cell, own)
        return gain
    }

    /** What a first visit of [cell], whose width was [own], says of the cells around that were not measured. */
    private fun around(cell: Int, own: Double): Double {
        val columns = grid!!.columns
        val rows = grid!!.rows
        val column = cell % columns
        val row = cell / columns
        var gain = 0.0
        for (r in maxOf(0, row - reach)..minOf(rows - 1, row + reach)) {
            for (c in maxOf(0, column - reach)..minOf(columns - 1, column + reach)) {
                val other = r * columns + c
                if (visits[other] > 0 || widths[other] <= 0) continue
                val left = leaves[(r - row + REACH) * SPAN + c - column + REACH]
                if (left >= 1) continue
                // A cell of which much is known can tell little: no more than its own part of the width.
                val part = if (own < widths[other]) own / widths[other] else 1.0
                gain += change(other, 1 - (1 - left) * part)
            }
        }
        return gain
    }

    private fun change(cell: Int, left: Double): Double {
        val width = widths[cell]
        keep(cell, width)
        widths[cell] = width * left
        return width - widths[cell]
    }

    private fun keep(cell: Int, width: Double) {
        if (changes == changed.size) {
            changed = changed.copyOf(2 * changes)
            before = before.copyOf(2 * changes)
        }
        changed[changes] = cell
        before[changes++] = width
    }

    private companion object {
        const val REACH = 3
        const val SPAN = 2 * REACH + 1

        /** ρ² below which cells tell nothing of each other. */
        const val LEAST = 0.05
        const val WIDEST = 1e100
    }
}
