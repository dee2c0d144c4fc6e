package stillwater.plan

import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.Plan
import kotlin.math.abs
import kotlin.random.Random
import kotlin.test.assertTrue

/** Every cell with the same bounds. */
internal fun flatMap(columns: Int, rows: Int, lower: Double = 0.0, upper: Double = 1.0): FieldMap =
    FieldMap(Grid.unit(columns, rows), Interval(lower, upper))

/** Bounds within [0, 1] of every sort: wide, narrow, of no width, crossed. */
internal fun randomMap(random: Random, columns: Int, rows: Int): FieldMap {
    val map = flatMap(columns, rows)
    for (cell in 0 until map.grid.size) {
        val a = random.nextDouble()
        val b = random.nextDouble()
        when (random.nextInt(6)) {
            0 -> map.setBounds(cell, a, a)
            1 -> map.setBounds(cell, maxOf(a, b), minOf(a, b))
            2 -> Unit
            else -> map.setBounds(cell, minOf(a, b), maxOf(a, b))
        }
    }
    return map
}

/** Indices of the cells whose centres the plan's waypoints are. */
internal fun cells(plan: Plan, grid: Grid): List<Int> = List(plan.size) { i ->
    val cell = grid.cellAt(plan.x(i), plan.y(i))
    assertTrue(cell != Grid.OUTSIDE, "waypoint $i (${plan.x(i)}, ${plan.y(i)}) is off the grid")
    assertTrue(plan.x(i) == grid.centerX(cell) && plan.y(i) == grid.centerY(cell), "waypoint $i is no cell's centre")
    cell
}

/** Whether two cells share an edge. */
internal fun shareAnEdge(grid: Grid, a: Int, b: Int): Boolean =
    abs(a % grid.columns - b % grid.columns) + abs(a / grid.columns - b / grid.columns) == 1

/** The cells that share an edge with [cell]. */
internal fun neighbours(grid: Grid, cell: Int): List<Int> = (0 until grid.size).filter { shareAnEdge(grid, cell, it) }
