package stillwater.mission

import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Plan
import stillwater.model.Position
import stillwater.model.WaterArea
import stillwater.plan.ClosedCells
import stillwater.plan.DetourWays
import stillwater.plan.PlanOutcome
import stillwater.plan.Planner
import stillwater.plan.StopCondition
import kotlin.math.hypot

/**
 * Leads a boat that is off the map, or off the water, to the map; else another planner plans.
 *
 * From the water to the nearest cell's centre that a clear line leads to, else round the land and round [closed] cells
 * by [ways]; where they do not lead there either, nowhere. Off the water any nearest cell will do, because the safety
 * gate leads the boat to the water first.
 */
internal class EntryPlanner(
    private val planner: Planner,
    private val water: WaterArea,
    private val ways: DetourWays,
    private val closed: ClosedCells,
) : Planner {
    override fun plan(
        map: FieldMap,
        from: Position,
        sensorValue: Double,
        stop: StopCondition,
        plan: Plan,
    ): PlanOutcome {
        val outcome = planner.plan(map, from, sensorValue, stop, plan)
        if (outcome != PlanOutcome.OffMap && outcome != PlanOutcome.OffWater) return outcome
        plan.clear()
        val mustSee = (!ways.isOpen || closed.count > 0) && from in water
        val nearest = nearest(map.grid, from, mustSee)
        if (nearest != Grid.OUTSIDE) {
            plan.add(map.grid.centerX(nearest), map.grid.centerY(nearest))
        } else if (mustSee) {
            leadRound(map.grid, from, plan)
        }
        return if (plan.size > 0) PlanOutcome.Planned else outcome
    }

    private fun leadRound(grid: Grid, from: Position, plan: Plan) {
        val routes = ways.from(from) ?: return
        val inside = (0 until routes.points).filter { grid.cellAt(routes.x(it), routes.y(it)) != Grid.OUTSIDE }
        inside.minByOrNull(routes::distance)?.let { routes.wayTo(it, plan) }
    }

    private fun nearest(grid: Grid, from: Position, mustSee: Boolean): Int {
        var best = Grid.OUTSIDE
        var least = Double.POSITIVE_INFINITY
        for (cell in 0 until grid.size) {
            val x = grid.centerX(cell)
            val y = grid.centerY(cell)
            val distance = hypot(x - from.x, y - from.y)
            if (distance < least && (if (mustSee) isInSight(from, x, y) else water.contains(x, y))) {
                least = distance
                best = cell
            }
        }
        return best
    }

    private fun isInSight(from: Position, x: Double, y: Double) =
        ways.isFree(from.x, from.y, x, y) && !closed.blocks(from.x, from.y, x, y)
}
