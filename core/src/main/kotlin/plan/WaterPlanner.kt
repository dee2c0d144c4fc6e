package stillwater.plan

import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Plan
import stillwater.model.Position

/**
 * Lets a planner that goes from cell to cell work on water of any shape: land is gone round, and every leg keeps the
 * routes' margin.
 *
 * The planner plans on a map in which cells whose centre is on land or within the margin have nothing to be learned. Of
 * its waypoints these are left out; to each of the others leads the straight leg, or where that is not clear the
 * shortest way through the water. Where nothing of a plan is left, the planner is asked again from where the plan ended,
 * as if it had gone there, until it comes back to the water or was asked [MOST_ASKED] times.
 *
 * Allocates when the map's grid has changed, otherwise as the other planner. Confined to one thread.
 *
 * @param planner plans from cell to cell. Retained.
 * @param routes ways through the water, started here. Retained, and not to be started elsewhere.
 */
public class WaterPlanner(private val planner: Planner, private val routes: WaterRoutes) : Planner {
    private var own: FieldMap? = null
    private var water = BooleanArray(0)
    private val wanted = Plan()
    private val way = Plan()

    override fun plan(
        map: FieldMap,
        from: Position,
        sensorValue: Double,
        stop: StopCondition,
        plan: Plan,
    ): PlanOutcome {
        plan.clear()
        val own = fill(map)
        var place = from
        repeat(MOST_ASKED) {
            val outcome = planner.plan(own, place, sensorValue, stop, wanted)
            if (outcome != PlanOutcome.Planned) return outcome
            lead(map.grid, from, plan)
            if (plan.size > 0) return PlanOutcome.Planned
            place = Position(wanted.x(wanted.size - 1), wanted.y(wanted.size - 1))
        }
        return PlanOutcome.NothingToGain
    }

    /** Fills [plan] with the ways from [from] to those of the wanted waypoints that can be reached. */
    private fun lead(grid: Grid, from: Position, plan: Plan) {
        var x = from.x
        var y = from.y
        for (i in 0 until wanted.size) {
            val toX = wanted.x(i)
            val toY = wanted.y(i)
            val cell = grid.cellAt(toX, toY)
            if (cell == Grid.OUTSIDE || !water[cell]) continue
            if (routes.area.isClear(x, y, toX, toY, routes.margin)) {
                plan.add(toX, toY)
            } else {
                if (!routes.start(toX, toY)) continue
                routes.wayBack(x, y, way)
                if (way.size == 0) continue
                for (k in 0 until way.size) plan.add(way.x(k), way.y(k))
            }
            x = toX
            y = toY
        }
    }

    /** Brings the planner's own map up to date. */
    private fun fill(map: FieldMap): FieldMap {
        var own = own
        if (own == null || own.grid != map.grid) {
            own = FieldMap(map.grid, map.prior)
            this.own = own
            water = BooleanArray(map.grid.size) {
                routes.area.isClear(map.grid.centerX(it), map.grid.centerY(it), routes.margin)
            }
        }
        for (cell in 0 until own.grid.size) {
            val value = map.value(cell)
            own.setValue(cell, value)
            val isWater = water[cell]
            own.setBounds(cell, if (isWater) map.lower(cell) else value, if (isWater) map.upper(cell) else value)
            while (own.visits(cell) < map.visits(cell)) own.countVisit(cell)
        }
        return own
    }

    public companion object {
        /** How often the planner is asked for one plan: a random walk comes back from land of a few cells by then. */
        public const val MOST_ASKED: Int = 1000
    }
}
