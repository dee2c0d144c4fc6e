package stillwater.plan

import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Plan
import stillwater.model.Position
import kotlin.math.hypot

/**
 * Lets any planner go round cells that the boat did not get into.
 *
 * As long as none is closed the planner plans alone. Else it sees a map in which closed cells, and those that they cut
 * off, have nothing to be learned; its waypoints in them are left out, and where the straight leg to another would lead
 * through a closed cell, the shortest way through the water takes its place. Where nothing of a plan is left the
 * planner is asked again from where that ended, as if the boat had gone there, [MOST_ASKED] times; then the nearest of
 * the cells that were visited least is gone to. Where nothing is left to be gained, cells that were closed only once
 * are tried once more.
 *
 * Confined to one thread.
 *
 * @param planner plans. Retained.
 * @param closed what to leave out. Retained.
 * @param ways through the water. Retained.
 */
internal class DetourPlanner(
    private val planner: Planner,
    private val closed: ClosedCells,
    private val ways: DetourWays,
) : Planner {
    private var own: FieldMap? = null
    private var reached = BooleanArray(0)
    private var reachedFrom = Grid.OUTSIDE
    private var reachedVersion = -1
    private val wanted = Plan()
    private val way = Plan()

    override fun plan(
        map: FieldMap,
        from: Position,
        sensorValue: Double,
        stop: StopCondition,
        plan: Plan,
    ): PlanOutcome {
        while (true) {
            if (closed.count == 0 || map.grid.cellAt(from) == Grid.OUTSIDE) {
                return planner.plan(map, from, sensorValue, stop, plan)
            }
            val outcome = round(map, from, sensorValue, stop, plan)
            if (outcome != PlanOutcome.NothingToGain || !closed.openOnceMore()) return outcome
        }
    }

    /**
     * Works on what a plan from [from] needs of the ways, on those to [most] points. Answers whether no such work is
     * left for [plan] to do.
     */
    fun prepare(grid: Grid, from: Position, most: Int): Boolean =
        closed.count == 0 || isAround(grid.cellAt(from)) || ways.prepare(from, most)

    private fun isAround(cell: Int) = cell == reachedFrom && cell != Grid.OUTSIDE && closed.version == reachedVersion

    private fun round(map: FieldMap, from: Position, value: Double, stop: StopCondition, plan: Plan): PlanOutcome {
        plan.clear()
        lookAround(map.grid, from)
        val own = fill(map)
        var place = from
        repeat(MOST_ASKED) {
            val outcome = planner.plan(own, place, value, stop, wanted)
            if (outcome != PlanOutcome.Planned) return outcome
            lead(map.grid, from, plan)
            if (plan.size > 0) return PlanOutcome.Planned
            place = Position(wanted.x(wanted.size - 1), wanted.y(wanted.size - 1))
        }
        val cell = leastVisited(map, from)
        if (cell != Grid.OUTSIDE) leadRound(from, map.grid.centerX(cell), map.grid.centerY(cell), plan)
        return if (plan.size > 0) PlanOutcome.Planned else PlanOutcome.NothingToGain
    }

    /** Finds the cells that ways lead to from [from]. */
    private fun lookAround(grid: Grid, from: Position) {
        val cell = grid.cellAt(from)
        if (isAround(cell)) return
        reachedFrom = cell
        reachedVersion = closed.version
        own = null
        if (reached.size != grid.size) reached = BooleanArray(grid.size)
        // A cell in which the ways have no point may be come to by any.
        reached.fill(true)
        val routes = ways.from(from) ?: return
        for (point in 0 until routes.points) if (routes.isClear(point)) mark(grid, routes, point, false)
        for (point in 0 until routes.points) if (routes.distance(point).isFinite()) mark(grid, routes, point, true)
        reached[cell] = true
    }

    private fun mark(grid: Grid, routes: WaterRoutes, point: Int, isReached: Boolean) {
        val cell = grid.cellAt(routes.x(point), routes.y(point))
        if (cell != Grid.OUTSIDE) reached[cell] = isReached
    }

    private fun isLeftOut(grid: Grid, cell: Int) = cell != Grid.OUTSIDE &&
        (!reached[cell] || closed.isClosed(closed.at(grid.centerX(cell), grid.centerY(cell))))

    /** Fills [plan] with those of the wanted waypoints that can be gone to, up to the end of the first way round. */
    private fun lead(grid: Grid, from: Position, plan: Plan) {
        var x = from.x
        var y = from.y
        var isNext = true
        for (i in 0 until wanted.size) {
            val toX = wanted.x(i)
            val toY = wanted.y(i)
            if (isLeftOut(grid, grid.cellAt(toX, toY))) {
                isNext = false
                continue
            }
            val isFree = !closed.blocks(x, y, toX, toY) && (isNext || ways.isFree(x, y, toX, toY))
            if (!isFree) {
                // What comes after a way round is planned when the boat is there.
                if (plan.size == 0) leadRound(from, toX, toY, plan)
                if (plan.size == 0) continue
                return
            }
            plan.add(toX, toY)
            x = toX
            y = toY
            isNext = true
        }
    }

    /** Fills [plan] with the way round from [from] to ([x], [y]), m; leaves it empty where there is none. */
    private fun leadRound(from: Position, x: Double, y: Double, plan: Plan) {
        val routes = ways.from(from) ?: return
        var best = NONE
        var least = Double.POSITIVE_INFINITY
        for (point in 0 until routes.points) {
            val atX = routes.x(point)
            val atY = routes.y(point)
            val off = hypot(atX - x, atY - y)
            if (off < least && routes.distance(point).isFinite() && ways.isFree(atX, atY, x, y)) {
                least = off
                best = point
            }
        }
        if (best == NONE) return
        routes.wayTo(best, way)
        for (i in 0 until way.size) plan.add(way.x(i), way.y(i))
        if (!closed.blocks(routes.x(best), routes.y(best), x, y)) plan.add(x, y)
    }

    /** Of the cells to go to that were visited least the nearest to [from]. */
    private fun leastVisited(map: FieldMap, from: Position): Int {
        val grid = map.grid
        val start = grid.cellAt(from)
        var best = Grid.OUTSIDE
        var nearest = 0.0
        for (cell in 0 until grid.size) {
            if (cell == start || isLeftOut(grid, cell)) continue
            val off = hypot(grid.centerX(cell) - from.x, grid.centerY(cell) - from.y)
            val fewer = best == Grid.OUTSIDE || map.visits(cell) < map.visits(best)
            if (fewer || (map.visits(cell) == map.visits(best) && off < nearest)) {
                best = cell
                nearest = off
            }
        }
        return best
    }

    /** Brings the planner's own map up to date. */
    private fun fill(map: FieldMap): FieldMap {
        val own = own ?: FieldMap(map.grid, map.prior).also { own = it }
        own.correlation = map.correlation
        // As often as others, so that no planner takes them for forgotten.
        val usual = (0 until map.grid.size).sumOf { map.visits(it).toLong() } / map.grid.size + 1
        for (cell in 0 until map.grid.size) {
            val isOut = isLeftOut(map.grid, cell)
            val value = map.value(cell)
            own.setValue(cell, value)
            own.setBounds(cell, if (isOut) value else map.lower(cell), if (isOut) value else map.upper(cell))
            val visits = if (isOut) maxOf(map.visits(cell), usual.toInt()) else map.visits(cell)
            while (own.visits(cell) < visits) own.countVisit(cell)
        }
        return own
    }

    private companion object {
        /** A planner that goes in order comes past a row of cells by then. */
        const val MOST_ASKED = 100
        const val NONE = -1
    }
}
