package stillwater.plan

import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Plan
import stillwater.model.Position
import kotlin.random.Random

/** The steps a random walk may take. */
public enum class WalkSteps {
    /** To one of the up to four cells that share an edge, each as likely. */
    EDGE,

    /** One column and one row at once, each either way; a coordinate that would leave the grid stays: the original. */
    DIAGONAL_CLAMPED,
}

/**
 * Moves to a neighbouring cell drawn at random. Plans one move at a time. Source: the report, section 7.
 *
 * @param random where the draws come from; one or two a plan. Retained.
 * @property steps which neighbours count.
 */
public class RandomWalk(private val random: Random, public val steps: WalkSteps = WalkSteps.EDGE) : Planner {
    override fun plan(
        map: FieldMap,
        from: Position,
        sensorValue: Double,
        stop: StopCondition,
        plan: Plan,
    ): PlanOutcome {
        plan.clear()
        val grid = map.grid
        val cell = grid.cellAt(from)
        if (cell == Grid.OUTSIDE) return PlanOutcome.OffMap
        if (grid.size == 1) return PlanOutcome.NothingToGain
        val next = when (steps) {
            WalkSteps.EDGE -> edgeStep(grid, cell)
            WalkSteps.DIAGONAL_CLAMPED -> diagonalStep(grid, cell)
        }
        plan.add(grid.centerX(next), grid.centerY(next))
        return PlanOutcome.Planned
    }

    private fun edgeStep(grid: Grid, cell: Int): Int {
        val column = cell % grid.columns
        val row = cell / grid.columns
        var ways = 0
        if (column > 0) ways++
        if (column < grid.columns - 1) ways++
        if (row > 0) ways++
        if (row < grid.rows - 1) ways++
        var chosen = random.nextInt(ways)
        if (column > 0 && chosen-- == 0) return cell - 1
        if (column < grid.columns - 1 && chosen-- == 0) return cell + 1
        if (row > 0 && chosen == 0) return cell - grid.columns
        return cell + grid.columns
    }

    private fun diagonalStep(grid: Grid, cell: Int): Int {
        val column = cell % grid.columns + if (random.nextBoolean()) 1 else -1
        val row = cell / grid.columns + if (random.nextBoolean()) 1 else -1
        return row.coerceIn(0, grid.rows - 1) * grid.columns + column.coerceIn(0, grid.columns - 1)
    }
}
