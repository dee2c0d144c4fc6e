package stillwater.plan

import stillwater.model.Grid
import kotlin.math.abs

/**
 * A rectangle of a grid's cells.
 *
 * @property column first column. @property row first row.
 * @property columns number of columns, at least 1. @property rows number of rows, at least 1.
 */
public data class GridRegion(val column: Int, val row: Int, val columns: Int, val rows: Int) {
    /** Number of cells. */
    public val size: Int get() = columns * rows

    /** Whether the cell in [column] and [row] belongs to the region. */
    public fun contains(column: Int, row: Int): Boolean =
        column in this.column until this.column + columns && row in this.row until this.row + rows

    /** The region as a grid of its own, laid over the same water as [grid]. */
    public fun gridOf(grid: Grid): Grid {
        val corner = grid.corners(row * grid.columns + column).first()
        return grid.copy(origin = corner, columns = columns, rows = rows)
    }
}

/**
 * Divides a grid among boats: one rectangle each, all cells in one of them, of weights as alike as whole columns and rows
 * allow.
 *
 * Recursive bisection: the boats are divided into two halves (of 3 one and two), and the rectangle by the straight cut,
 * by columns or by rows, that divides the weight most nearly in the same proportion; of equal cuts the shorter is made.
 * Source: Berger and Bokhari 1987, doi:10.1109/TC.1987.1676942; see core/docs/SeveralBoats.md.
 */
public object GridPartition {
    /**
     * Regions of [boats] boats.
     *
     * @param weights how much there is to do in each cell, at least 0 and finite; length of [grid]'s size. Not modified.
     * @throws IllegalArgumentException if there are more boats than cells, or less than one, or a weight is out of range.
     */
    public fun split(grid: Grid, boats: Int, weights: DoubleArray): List<GridRegion> {
        require(boats in 1..grid.size) { "boats ($boats) must be within 1..${grid.size}, the number of cells" }
        require(weights.size == grid.size) { "weights (${weights.size}) must have one number per cell (${grid.size})" }
        require(weights.all { it >= 0 && it.isFinite() }) { "weights must be at least 0 and finite" }
        val regions = ArrayList<GridRegion>(boats)
        divide(GridRegion(0, 0, grid.columns, grid.rows), boats, regions) { column, row ->
            weights[row * grid.columns + column]
        }
        return regions
    }

    private fun divide(whole: GridRegion, boats: Int, into: MutableList<GridRegion>, weight: (Int, Int) -> Double) {
        if (boats == 1) {
            into += whole
            return
        }
        val (one, other) = cuts(whole).minWith(
            compareBy(
                { (a, b) -> imbalance(sum(a, weight), sum(b, weight), first(boats, a, b), boats) },
                { (a, b) -> border(a, b) },
            ),
        )
        val first = first(boats, one, other)
        divide(one, first, into, weight)
        divide(other, boats - first, into, weight)
    }

    /** Half of the boats for [one], as far as both parts have a cell for each of theirs. */
    private fun first(boats: Int, one: GridRegion, other: GridRegion) =
        (boats / 2).coerceIn(maxOf(1, boats - other.size), minOf(boats - 1, one.size))

    private fun cuts(whole: GridRegion): List<Pair<GridRegion, GridRegion>> {
        val byColumn = (1 until whole.columns).map { n ->
            whole.copy(columns = n) to whole.copy(column = whole.column + n, columns = whole.columns - n)
        }
        val byRow = (1 until whole.rows).map { n ->
            whole.copy(rows = n) to whole.copy(row = whole.row + n, rows = whole.rows - n)
        }
        return byColumn + byRow
    }

    /** How far the first part's share of the weight is from its boats' share; 0 where there is no weight. */
    private fun imbalance(one: Double, other: Double, first: Int, boats: Int): Double {
        val all = one + other
        return if (all > 0) abs(one / all - first.toDouble() / boats) else 0.0
    }

    private fun border(a: GridRegion, b: GridRegion) = if (a.row == b.row && a.rows == b.rows) a.rows else a.columns

    private fun sum(region: GridRegion, weight: (Int, Int) -> Double): Double {
        var sum = 0.0
        for (row in region.row until region.row + region.rows) {
            for (column in region.column until region.column + region.columns) sum += weight(column, row)
        }
        return sum
    }
}
