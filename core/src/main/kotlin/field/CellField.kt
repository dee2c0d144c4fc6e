package stillwater.field

import stillwater.model.BoatTime
import stillwater.model.Grid

/**
 * A field that is constant within each cell of a grid and in time, as the fields of the report's section 7 are.
 *
 * @property grid the cells.
 * @param truths true value per cell, sensor units, length [Grid.size], indexed as [grid]. Copied.
 * @throws IllegalArgumentException if the length differs or a value is not finite.
 */
public class CellField(public val grid: Grid, truths: DoubleArray) : Field {
    private val truths = truths.copyOf()

    init {
        require(truths.size == grid.size) {
            "truths (${truths.size} values) must have one value per cell (${grid.size})"
        }
        require(truths.all { it.isFinite() }) { "truths must be finite" }
    }

    /** The truth in the cell with index [cell], sensor units. */
    public fun truth(cell: Int): Double = truths[cell]

    override fun truth(x: Double, y: Double, time: BoatTime): Double = truth(x, y)

    /** The truth at the point ([x], [y]), m in the local frame, at any time, sensor units; NaN outside the grid. */
    public fun truth(x: Double, y: Double): Double {
        val cell = grid.cellAt(x, y)
        return if (cell == Grid.OUTSIDE) Double.NaN else truths[cell]
    }
}
