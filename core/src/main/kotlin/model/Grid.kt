package stillwater.model

import kotlin.math.abs
import kotlin.math.cos
import kotlin.math.round
import kotlin.math.sin

/**
 * A cell's place in a [Grid].
 *
 * @property column 0 at the grid's origin, growing along its first axis.
 * @property row 0 at the grid's origin, growing along its second axis.
 */
public data class Cell(val column: Int, val row: Int)

/**
 * A rectangle of equal rectangular cells laid over the water, in any size and at any angle.
 *
 * Cells are numbered row-major: index = row · columns + column. Grid axes: the first (columns) points [rotation]
 * radians counter-clockwise from east, the second (rows) a quarter turn further. A cell holds its lower edges and not
 * its upper ones, so every position belongs to one cell at most. Immutable.
 *
 * @property origin outer corner of cell (0, 0), local frame, m.
 * @property columns number of cells along the first axis, at least 1.
 * @property rows number of cells along the second axis, at least 1.
 * @property cellWidth size of a cell along the first axis, m, above 0.
 * @property cellHeight size of a cell along the second axis, m, above 0.
 * @property rotation angle of the first axis, rad, counter-clockwise from east.
 * @throws IllegalArgumentException if a number is out of its range or there are more than [MAX_CELLS] cells.
 */
public data class Grid(
    val origin: Position,
    val columns: Int,
    val rows: Int,
    val cellWidth: Double,
    val cellHeight: Double = cellWidth,
    val rotation: Double = 0.0,
) {
    init {
        require(columns >= 1) { "columns ($columns) must be at least 1" }
        require(rows >= 1) { "rows ($rows) must be at least 1" }
        require(columns.toLong() * rows <= MAX_CELLS) {
            "columns x rows ($columns x $rows) must be at most $MAX_CELLS cells"
        }
        require(cellWidth > 0 && cellWidth.isFinite()) { "cellWidth ($cellWidth m) must be above 0 and finite" }
        require(cellHeight > 0 && cellHeight.isFinite()) { "cellHeight ($cellHeight m) must be above 0 and finite" }
        require(rotation.isFinite()) { "rotation ($rotation rad) must be finite" }
        require(origin.x.isFinite() && origin.y.isFinite()) { "origin ($origin) must be finite" }
    }

    private val cosine = cos(rotation)
    private val sine = sin(rotation)

    /** Number of cells, columns · rows. */
    public val size: Int get() = columns * rows

    /** Index of the cell that holds [position], or [OUTSIDE]. */
    public fun cellAt(position: Position): Int = cellAt(position.x, position.y)

    /**
     * Index of the cell that holds the point ([x], [y]), or [OUTSIDE] where there is none or a coordinate is NaN.
     *
     * O(1), no allocation.
     *
     * @param x metres east in the local frame.
     * @param y metres north in the local frame.
     */
    public fun cellAt(x: Double, y: Double): Int {
        val east = x - origin.x
        val north = y - origin.y
        val column = (cosine * east + sine * north) / cellWidth
        val row = (cosine * north - sine * east) / cellHeight
        // From 0 on, cutting off the decimals is the floor.
        val inside = column >= 0 && column < columns && row >= 0 && row < rows
        return if (inside) row.toInt() * columns + column.toInt() else OUTSIDE
    }

    /** How far along the first axis the point ([x], [y]), local frame, m, is from the grid's origin, m. */
    public fun alongColumns(x: Double, y: Double): Double = cosine * (x - origin.x) + sine * (y - origin.y)

    /** How far along the second axis the point ([x], [y]), local frame, m, is from the grid's origin, m. */
    public fun alongRows(x: Double, y: Double): Double = cosine * (y - origin.y) - sine * (x - origin.x)

    /**
     * How far the point ([x], [y]), local frame, m, is from the nearest line between two rows or columns, m: from the
     * border of its cell. NaN where a coordinate is. O(1), no allocation.
     */
    public fun distanceToBorder(x: Double, y: Double): Double {
        val column = alongColumns(x, y) / cellWidth
        val row = alongRows(x, y) / cellHeight
        return minOf(abs(column - round(column)) * cellWidth, abs(row - round(row)) * cellHeight)
    }

    /** Index of [cell], which must lie in the grid. */
    public fun index(cell: Cell): Int {
        require(cell.column in 0 until columns && cell.row in 0 until rows) { "$cell must lie in $columns x $rows" }
        return cell.row * columns + cell.column
    }

    /** Column and row of the cell with [index], which must be in 0 until [size]. */
    public fun cell(index: Int): Cell {
        require(index in 0 until size) { "cell index ($index) must be in 0 until $size" }
        return Cell(index % columns, index / columns)
    }

    /** Centre of the cell with [index], local frame, m. */
    public fun center(index: Int): Position = Position(centerX(index), centerY(index))

    /** Metres east of the centre of the cell with [index]. No allocation. */
    public fun centerX(index: Int): Double = pointX(index % columns + 0.5, index / columns + 0.5)

    /** Metres north of the centre of the cell with [index]. No allocation. */
    public fun centerY(index: Int): Double = pointY(index % columns + 0.5, index / columns + 0.5)

    /** The four corners of the cell with [index], counter-clockwise from the one nearest the origin, local frame, m. */
    public fun corners(index: Int): List<Position> {
        val column = (index % columns).toDouble()
        val row = (index / columns).toDouble()
        return listOf(
            point(column, row),
            point(column + 1, row),
            point(column + 1, row + 1),
            point(column, row + 1),
        )
    }

    /** The local position of the point [column] cells along the first axis and [row] along the second. */
    private fun point(column: Double, row: Double) = Position(pointX(column, row), pointY(column, row))

    private fun pointX(column: Double, row: Double) = origin.x + cosine * column * cellWidth - sine * row * cellHeight

    private fun pointY(column: Double, row: Double) = origin.y + sine * column * cellWidth + cosine * row * cellHeight

    public companion object {
        /** What [cellAt] answers for a position that no cell holds. */
        public const val OUTSIDE: Int = -1

        /** The largest number of cells a grid may have; a map of it fits into memory. */
        public const val MAX_CELLS: Int = 16_000_000

        /** A grid of unit cells with its corner at the origin: the report's simulated field. */
        public fun unit(columns: Int, rows: Int): Grid = Grid(Position(0.0, 0.0), columns, rows, 1.0)
    }
}
