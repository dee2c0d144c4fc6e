package stillwater.plan

import stillwater.model.Grid
import stillwater.model.Plan
import stillwater.model.Position
import kotlin.math.abs

/** Straight home, where nothing is in the way. */
public class StraightHome(private val home: Position) : WayHome {
    override fun fill(x: Double, y: Double, plan: Plan) {
        plan.clear()
        if (x != home.x || y != home.y) plan.add(home.x, home.y)
    }
}

/**
 * Home from cell to neighbouring cell of [grid], along the longer side of the way first.
 *
 * @param home index of the cell whose centre is home.
 * @throws IllegalArgumentException if [home] is not a cell of [grid].
 */
public class CellsHome(private val grid: Grid, private val home: Int) : WayHome {
    init {
        require(home in 0 until grid.size) { "home (cell $home) must be within 0 until ${grid.size}" }
    }

    override fun fill(x: Double, y: Double, plan: Plan) {
        plan.clear()
        val cell = grid.cellAt(x, y)
        if (cell == Grid.OUTSIDE) return
        var column = cell % grid.columns
        var row = cell / grid.columns
        val toColumn = home % grid.columns
        val toRow = home / grid.columns
        while (column != toColumn || row != toRow) {
            if (abs(toColumn - column) >= abs(toRow - row)) {
                column += if (toColumn > column) 1 else -1
            } else {
                row += if (toRow > row) 1 else -1
            }
            val next = row * grid.columns + column
            plan.add(grid.centerX(next), grid.centerY(next))
        }
        if (plan.size == 0 && (x != grid.centerX(home) || y != grid.centerY(home))) {
            plan.add(grid.centerX(home), grid.centerY(home))
        }
    }
}

/**
 * Home through the water, no nearer to land than the routes' margin.
 *
 * @param routes the ways; [WaterRoutes.start] is called here, once. Retained, and not to be started elsewhere.
 * @param home where to.
 * @throws IllegalArgumentException if no way leads away from [home].
 */
public class WaterHome(private val routes: WaterRoutes, home: Position) : WayHome {
    init {
        require(routes.start(home.x, home.y)) {
            "home (${home.x} m, ${home.y} m) must lie on the water, with some of it within reach"
        }
    }

    override fun fill(x: Double, y: Double, plan: Plan): Unit = routes.wayBack(x, y, plan)
}
