package stillwater.plan

import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Plan
import stillwater.model.Position

/** The order in which a lawnmower visits the cells; each repeats for ever. */
public enum class LawnmowerPattern {
    /**
     * A closed tour of edge steps that visits every cell once: along the first row, back and forth through the rest,
     * home along the first column. Needs an even number of rows or of columns, and two of each at least.
     */
    HAMILTONIAN_CYCLE,

    /** Back and forth through the rows to the last cell, then the same way back. */
    BACK_AND_FORTH,

    /** Back and forth through the rows, then back and forth through the columns. */
    ROWS_THEN_COLUMNS,

    /** Every row in the same direction, jumping back to the start of the next, then to the first: the original. */
    RASTER,
}

/**
 * Visits the cells in a fixed order, whatever is measured. Plans one move at a time.
 *
 * Starts at the pattern's first visit to the cell the boat is in, and picks up there again if the boat was moved.
 * Source: the report, section 7, which does not say which pattern.
 *
 * @property pattern the order.
 */
public class Lawnmower(public val pattern: LawnmowerPattern) : Planner {
    private var grid: Grid? = null
    private var tour = IntArray(0)
    private var place = 0

    override fun plan(
        map: FieldMap,
        from: Position,
        sensorValue: Double,
        stop: StopCondition,
        plan: Plan,
    ): PlanOutcome {
        plan.clear()
        if (map.grid != grid) {
            tour = tour(map.grid, pattern)
            grid = map.grid
            place = 0
        }
        val cell = map.grid.cellAt(from)
        if (cell == Grid.OUTSIDE) return PlanOutcome.OffMap
        if (tour.size == 1) return PlanOutcome.NothingToGain
        if (tour[place] != cell) place = tour.indexOf(cell)
        place = (place + 1) % tour.size
        plan.add(map.grid.centerX(tour[place]), map.grid.centerY(tour[place]))
        return PlanOutcome.Planned
    }

    public companion object {
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
                LawnmowerPattern.RASTER -> IntArray(grid.size) { it }
            }
        }

        private fun hamiltonianCycle(grid: Grid): IntArray =
            if (grid.rows % 2 == 0) {
                cycle(grid.columns, grid.rows) { column, row -> row * grid.columns + column }
            } else {
                cycle(grid.rows, grid.columns) { row, column -> row * grid.columns + column }
            }

        /** The cycle over [width] x [height] places, [height] even; the first column is kept for the way home. */
        private fun cycle(width: Int, height: Int, index: (Int, Int) -> Int): IntArray {
            val cells = ArrayList<Int>(width * height)
            for (row in 0 until height) {
                val inner = if (row % 2 == 0) 1 until width else (1 until width).reversed()
                if (row == 0) cells += index(0, 0)
                for (column in inner) cells += index(column, row)
            }
            for (row in height - 1 downTo 1) cells += index(0, row)
            return cells.toIntArray()
        }

        private fun serpentine(lines: Int, length: Int, index: (Int, Int) -> Int): List<Int> =
            (0 until lines).flatMap { line ->
                (0 until length).map { step -> index(line, if (line % 2 == 0) step else length - 1 - step) }
            }

        /** There and back; the turning cells are not visited twice in a row. */
        private fun backAndForth(grid: Grid): IntArray {
            val there = serpentine(grid.rows, grid.columns) { row, column -> row * grid.columns + column }
            return (there + there.asReversed().drop(1).dropLast(1)).toIntArray()
        }

        /**
         * The rows from the first to the last, then the columns from where the rows ended back to the first cell's
         * side. The cell in which one part ends and the next begins is not visited twice in a row.
         */
        private fun rowsThenColumns(grid: Grid): IntArray {
            val rows = serpentine(grid.rows, grid.columns) { row, column -> row * grid.columns + column }
            val end = grid.cell(rows.last())
            val columns = serpentine(grid.columns, grid.rows) { line, step ->
                val column = if (end.column == 0) line else grid.columns - 1 - line
                (grid.rows - 1 - step) * grid.columns + column
            }
            val tour = rows + columns.drop(1)
            return (if (tour.size > 1 && tour.last() == tour.first()) tour.dropLast(1) else tour).toIntArray()
        }
    }
}
