package stillwater.plan

import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Plan
import stillwater.model.Position

/**
 * Keeps another planner to one region of the map, so that several boats share the work.
 *
 * A planner from cell to cell is given the region as a map of its own, and a boat outside of it first goes there from cell
 * to neighbouring cell by the shortest way. A planner in the plane ([inPlane]) is given all of the map, with no width
 * between the bounds of cells outside of the region: it may pass them, round an island say, but gains nothing there.
 *
 * Without a region the other planner plans on the whole map. Allocates when the region or the map's grid has changed,
 * otherwise as the other planner. Confined to one thread.
 *
 * @param planner plans within the region. Retained.
 * @param inPlane whether [planner] may leave the region on its way.
 */
public class RegionPlanner(private val planner: Planner, private val inPlane: Boolean = false) : Planner {
    private var own: FieldMap? = null
    private var builtFor: Grid? = null
    private var builtAs: GridRegion? = null

    /** Where the boat works; null for everywhere. */
    public var region: GridRegion? = null

    override fun plan(
        map: FieldMap,
        from: Position,
        sensorValue: Double,
        stop: StopCondition,
        plan: Plan,
    ): PlanOutcome {
        val region = region ?: return planner.plan(map, from, sensorValue, stop, plan)
        plan.clear()
        val cell = map.grid.cellAt(from)
        if (cell == Grid.OUTSIDE) return PlanOutcome.OffMap
        if (!inPlane && !region.contains(cell % map.grid.columns, cell / map.grid.columns)) {
            enter(map.grid, region, cell, plan)
            return PlanOutcome.Planned
        }
        val own = fill(map, region)
        return planner.plan(own, from, sensorValue, stop, plan)
    }

    /** Steps from [cell] to the nearest cell of [region], columns first. */
    private fun enter(grid: Grid, region: GridRegion, cell: Int, plan: Plan) {
        var column = cell % grid.columns
        var row = cell / grid.columns
        while (!region.contains(column, row)) {
            when {
                column < region.column -> column++
                column >= region.column + region.columns -> column--
                row < region.row -> row++
                else -> row--
            }
            plan.add(grid.centerX(row * grid.columns + column), grid.centerY(row * grid.columns + column))
        }
    }

    /** Brings the planner's own map up to date. */
    private fun fill(map: FieldMap, region: GridRegion): FieldMap {
        var own = own
        if (own == null || builtFor != map.grid || (!inPlane && builtAs != region)) {
            own = FieldMap(if (inPlane) map.grid else region.gridOf(map.grid), map.prior)
            this.own = own
            builtFor = map.grid
        }
        builtAs = region
        val columns = own.grid.columns
        for (to in 0 until own.grid.size) {
            val from = if (inPlane) {
                to
            } else {
                (region.row + to / columns) * map.grid.columns + region.column +
                    to % columns
            }
            val isIn = !inPlane || region.contains(to % columns, to / columns)
            own.setValue(to, map.value(from))
            if (isIn) {
                own.setBounds(
                    to,
                    map.lower(from),
                    map.upper(from),
                )
            } else {
                own.setBounds(to, map.value(from), map.value(from))
            }
            while (own.visits(to) < map.visits(from)) own.countVisit(to)
        }
        return own
    }
}
