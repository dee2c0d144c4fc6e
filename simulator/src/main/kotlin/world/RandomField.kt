package stillwater.world

import stillwater.field.CellField
import stillwater.field.Field
import stillwater.model.Grid
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.exp
import kotlin.math.pow
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.random.Random

/** Draws fields of one kind for an experiment. */
fun interface RandomField {
    /** A field over [grid] drawn from [random]. */
    fun draw(grid: Grid, random: Random): CellField
}

/** Every cell's value is uniform in [0, 1], independent of its neighbours': the report's Figure 6. */
object UniformField : RandomField {
    override fun draw(grid: Grid, random: Random): CellField =
        CellField(grid, DoubleArray(grid.size) { random.nextDouble() })
}

/**
 * A sum of 3 to 6 Gaussians, scaled so that the lowest cell is 0 and the highest 1: the report's Figure 7, which says no
 * more than "a mixture of gaussians".
 *
 * Centres are uniform over the rectangle that the cells' centres span, standard deviations uniform in 1 to 3 cells,
 * amplitudes uniform in 0.5 to 1 before scaling.
 */
object GaussianMixtureField : RandomField {
    override fun draw(grid: Grid, random: Random): CellField {
        val sums = sums(grid, bumps(grid, random))
        val lowest = sums.min()
        val span = sums.max() - lowest
        return CellField(grid, DoubleArray(sums.size) { if (span > 0) (sums[it] - lowest) / span else 0.5 })
    }

    /**
     * The same mixture without steps: at the cells' centres the value that [draw] gives with the same [random], between
     * and around them the Gaussians themselves, which may go a little beyond 0 and 1 there.
     */
    fun drawSmooth(grid: Grid, random: Random): Field {
        val bumps = bumps(grid, random)
        val sums = sums(grid, bumps)
        val lowest = sums.min()
        val span = sums.max() - lowest
        val c = cos(grid.rotation)
        val s = sin(grid.rotation)
        return Field { x, y, _ ->
            val east = x - grid.origin.x
            val north = y - grid.origin.y
            // The centre of cell (0, 0) is (0, 0) to the Gaussians.
            val column = (c * east + s * north) / grid.cellWidth - CENTRE
            val row = (c * north - s * east) / grid.cellHeight - CENTRE
            if (span > 0) (sum(column, row, bumps) - lowest) / span else CENTRE
        }
    }

    private fun bumps(grid: Grid, random: Random) = List(random.nextInt(3, 7)) {
        Bump(
            column = random.nextDouble() * (grid.columns - 1),
            row = random.nextDouble() * (grid.rows - 1),
            sigma = random.nextDouble(1.0, 3.0),
            amplitude = random.nextDouble(0.5, 1.0),
        )
    }

    private const val CENTRE = 0.5
}

/**
 * The original experiment's field: a sum of 3 Gaussians, each centred on a random cell, standard deviation 1 + U cells,
 * amplitude 5 U / (σ √(2π)), clipped to [0, 1].
 */
object OriginalGaussianField : RandomField {
    override fun draw(grid: Grid, random: Random): CellField {
        val bumps = List(3) {
            val sigma = 1 + random.nextDouble()
            Bump(
                column = random.nextInt(grid.columns).toDouble(),
                row = random.nextInt(grid.rows).toDouble(),
                sigma = sigma,
                amplitude = 5 * random.nextDouble() / (sigma * sqrt(2 * PI)),
            )
        }
        val sums = sums(grid, bumps)
        return CellField(grid, DoubleArray(sums.size) { sums[it].coerceIn(0.0, 1.0) })
    }
}

private class Bump(val column: Double, val row: Double, val sigma: Double, val amplitude: Double)

private fun sums(grid: Grid, bumps: List<Bump>) = DoubleArray(grid.size) { index ->
    val cell = grid.cell(index)
    sum(cell.column.toDouble(), cell.row.toDouble(), bumps)
}

private fun sum(column: Double, row: Double, bumps: List<Bump>) = bumps.sumOf {
    val squared = (column - it.column).pow(2) + (row - it.row).pow(2)
    it.amplitude * exp(-squared / (2 * it.sigma * it.sigma))
}
