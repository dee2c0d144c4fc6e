package stillwater.world

import stillwater.field.CellField
import stillwater.field.Field
import stillwater.model.Grid
import stillwater.model.Interval
import kotlin.math.cos
import kotlin.math.floor
import kotlin.math.sin
import kotlin.random.Random

/**
 * The waters that a virtual boat can be put on.
 *
 * @property label name on the command line.
 * @property isEvenInCells whether the water is the same all over a cell, as the estimators take it to be.
 */
enum class WaterKind(val label: String, val isEvenInCells: Boolean) {
    /** Each cell has a value of its own: the report's Figure 6. */
    UNIFORM("uniform", isEvenInCells = true),

    /** A mixture of Gaussians, the same all over a cell: the report's Figure 7. */
    GAUSSIAN("gaussian", isEvenInCells = true),

    /** The same mixture without steps: the water changes within a cell, as a lake's does. */
    SMOOTH("smooth", isEvenInCells = false),
    ;

    /**
     * Water over [grid], drawn from [random], that lies in [range] at the cells' centres, sensor units. Around the grid
     * [UNIFORM] and [GAUSSIAN] go on as in the nearest cell, so that it is defined everywhere.
     */
    fun draw(grid: Grid, range: Interval, random: Random): Field {
        val shares = when (this) {
            UNIFORM -> goneOn(UniformField.draw(grid, random))
            GAUSSIAN -> goneOn(GaussianMixtureField.draw(grid, random))
            SMOOTH -> GaussianMixtureField.drawSmooth(grid, random)
        }
        return Field { x, y, time -> range.lower + range.width * shares.truth(x, y, time) }
    }

    private fun goneOn(field: CellField): Field {
        val grid = field.grid
        val c = cos(grid.rotation)
        val s = sin(grid.rotation)
        return Field { x, y, _ ->
            val east = x - grid.origin.x
            val north = y - grid.origin.y
            val column = floor((c * east + s * north) / grid.cellWidth).toInt().coerceIn(0, grid.columns - 1)
            val row = floor((c * north - s * east) / grid.cellHeight).toInt().coerceIn(0, grid.rows - 1)
            field.truth(row * grid.columns + column)
        }
    }
}
