package stillwater.plan

import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Plan
import stillwater.model.Position

/** The order in which a lawnmower visits the cells; each repeats for ever. */
public enum class LawnmowerPattern {
    /**
     * A closed tour of edge steps that visits every cell once: up the first column, then home back and forth through
     * the rows of the others. Needs an even number of rows or of columns, and two of each at least.
     */
    HAMILTONIAN_CYCLE,

    /** Back and forth through the rows to the last cell, then the same way back. */
    BACK_AND_FORTH,

    /**
     * Back and forth through the rows, then back and forth through the columns, each pass starting in the corner where
     * the one before ended.
     */
    ROWS_THEN_COLUMNS,

    /**
     * Back and forth through the rows and the same way back, then so through the columns: in one period every cell is
     * entered from each of its neighbours, so that no bound of a slow sensor is only ever approached from one side.
     */
    FOUR_DIRECTIONS,

    /** Every row in the same direction, jumping back to the start of the next, then to the first: the original. */
    RASTER,
}

/**
 * Visits the cells in a fixed order, whatever is measured. Plans one move at a time.
 *
 * Starts at the pattern's first visit to the cell the boat is in, and picks up there again if the boat was moved. Asked
 * again before the boat has left its cell, it repeats the move. Where a grid has no Hamiltonian cycle ([fits]) it mows
 * back and forth. Source: the report, section 7, which does not say which pattern.
 *
 * @property pattern the order.
 */
public class Lawnmower(public val pattern: LawnmowerPattern) : Planner {
    private var grid: Grid? = null
    private var tour = IntArray(0)

    /** Place in the tour of the last waypoint planned, or [NOWHERE]. */
    private var place = NOWHERE

    override fun plan(
        map: FieldMap,
        from: Position,
        sensorValue: Double,
        stop: StopCondition,
        plan: Plan,
    ): PlanOutcome {
        plan.clear()
        if (map.grid != grid) {
            tour = tour(map.grid, if (fits(map.grid, pattern)) pattern else LawnmowerPattern.BACK_AND_FORTH)
            grid = map.grid
            place = NOWHERE
        }
        val cell = map.grid.cellAt(from)
        if (cell == Grid.OUTSIDE) return PlanOutcome.OffMap
        if (tour.size == 1) return PlanOutcome.NothingToGain
        place = next(cell)
        plan.add(map.grid.centerX(tour[place]), map.grid.centerY(tour[place]))
        return PlanOutcome.Planned
    }

    /** Place in the tour of the waypoint that comes after [cell]. */
    private fun next(cell: Int): Int {
        val arrived = place != NOWHERE && tour[place] == cell
        val notYetLeft = place != NOWHERE && tour[(place + tour.size - 1) % tour.size] == cell
        return when {
            arrived -> (place + 1) % tour.size
            notYetLeft -> place
            else -> (tour.indexOf(cell) + 1) % tour.size
        }
    }

    public companion object {
        private const val NOWHERE = -1

        /** Whether [pattern] exists on [grid]: only [LawnmowerPattern.HAMILTONIAN_CYCLE] asks for a certain shape. */
        public fun fits(grid: Grid, pattern: LawnmowerPattern): Boolean =
            pattern != LawnmowerPattern.HAMILTONIAN_CYCLE ||
                (grid.columns >= 2 && grid.rows >= 2 && grid.size % 2 == 0)

        /**
         * The cells in the order [pattern] visits them, one period; the first follows the last.
         *
         * @throws IllegalArgumentException if the pattern does not exist on [grid], see [fits].
         */
        public fun tour(grid: Grid, pattern: LawnmowerPattern): IntArray {
            require(fits(grid, pattern)) {
                "a Hamiltonian cycle needs an even number of rows or columns, at least 2 of each; " +
                    "the grid has ${grid.columns} x ${grid.rows}"
            }
            return when (pattern) {
                LawnmowerPattern.HAMILTONIAN_CYCLE -> hamiltonianCycle(grid)
                LawnmowerPattern.BACK_AND_FORTH -> backAndForth(grid)
                LawnmowerPattern.ROWS_THEN_COLUMNS -> rowsThenColumns(grid)
                LawnmowerPattern.FOUR_DIRECTIONS -> fourDirections(grid)
                LawnmowerPattern.RASTER -> IntArray(grid.size) { it }
            }
        }

        private fun hamiltonianCycle(grid: Grid): IntArray =
            if (grid.rows % 2 == 0) {
                cycle(grid.columns, grid.rows) { column, row -> row * grid.columns + column }
            } else {
                cycle(grid.rows, grid.columns) { row, column -> row * grid.columns + column }
            }

        /** The cycle over [width] x [height] places, [height] even: up the first column, then home row by row. */
        private fun cycle(width: Int, height: Int, index: (Int, Int) -> Int): IntArray {
            val firstColumn = (0 until height).map { row -> index(0, row) }
            val home = (height - 1 downTo 0).flatMap { row ->
                val columns = if (row % 2 == 1) 1 until width else (1 until width).reversed()
                columns.map { column -> index(column, row) }
            }
            return (firstColumn + home).toIntArray()
        }

        private fun serpentine(lines: Int, length: Int, index: (Int, Int) -> Int): List<Int> =
            (0 until lines).flatMap { line ->
                (0 until length).map { step -> index(line, if (line % 2 == 0) step else length - 1 - step) }
            }

        /** There and back; the turning cells are not visited twice in a row. */
        private fun backAndForth(grid: Grid): IntArray =
            thereAndBack(serpentine(grid.rows, grid.columns) { row, column -> row * grid.columns + column })

        private fun thereAndBack(there: List<Int>): IntArray =
            (there + there.asReversed().drop(1).dropLast(1)).toIntArray()

        /** Each pass ends in the first cell, where the other begins. */
        private fun fourDirections(grid: Grid): IntArray {
            val byColumns = serpentine(grid.columns, grid.rows) { column, row -> row * grid.columns + column }
            return if (grid.rows == 1 ||
                grid.columns == 1
            ) {
                backAndForth(grid)
            } else {
                backAndForth(grid) + thereAndBack(byColumns)
            }
        }

        /**
         * A pass by rows, one by columns, and so on, each starting in the corner where the one before ended and not
         * visiting it twice, until the next pass would be the first again: two passes when both sides are odd, four
         * otherwise.
         */
        private fun rowsThenColumns(grid: Grid): IntArray {
            val tour = ArrayList<Int>()
            var right = false
            var top = false
            do {
                for (byRows in listOf(true, false)) {
                    val pass = pass(grid, byRows, right, top)
                    tour += if (tour.isEmpty()) pass else pass.drop(1)
                    val end = grid.cell(tour.last())
                    right = grid.columns > 1 && end.column == grid.columns - 1
                    top = grid.rows > 1 && end.row == grid.rows - 1
                }
            } while (right || top)
            return (if (tour.size > 1 && tour.last() == tour.first()) tour.dropLast(1) else tour).toIntArray()
        }

        /** All cells back and forth by rows or by columns, from the corner that is right or left, top or bottom. */
        private fun pass(grid: Grid, byRows: Boolean, right: Boolean, top: Boolean): List<Int> {
            fun index(column: Int, row: Int): Int {
                val mirroredColumn = if (right) grid.columns - 1 - column else column
                val mirroredRow = if (top) grid.rows - 1 - row else row
                return mirroredRow * grid.columns + mirroredColumn
            }
            return if (byRows) {
                serpentine(grid.rows, grid.columns) { row, column -> index(column, row) }
            } else {
                serpentine(grid.columns, grid.rows) { column, row -> index(column, row) }
            }
        }
    }
}
