package stillwater.plan

import stillwater.field.FieldMap
import stillwater.model.Plan
import stillwater.model.Position
import kotlin.math.hypot

/**
 * What travel costs, in the budget's unit: metres, seconds or moves.
 *
 * @property perMetre cost of a metre, at least 0.
 * @property perWaypoint cost of going to a waypoint, however far, and of staying where the boat is for a turn; at least
 *   0.
 * @throws IllegalArgumentException if a number is negative or not finite, or both are 0.
 */
public data class TravelCost(val perMetre: Double, val perWaypoint: Double) {
    init {
        require(perMetre >= 0 && perMetre.isFinite()) { "perMetre ($perMetre) must be at least 0 and finite" }
        require(perWaypoint >= 0 && perWaypoint.isFinite()) {
            "perWaypoint ($perWaypoint) must be at least 0 and finite"
        }
        require(perMetre > 0 || perWaypoint > 0) { "perMetre and perWaypoint must not both be 0" }
    }
}

/** Tells how much longer the water makes a leg. */
public fun interface Pace {
    /** Cost of a leg [east] m and [north] m long over its cost in still water, at least 1, finite. */
    public fun of(east: Double, north: Double): Double

    public companion object {
        /** Still water. */
        public val STILL: Pace = Pace { _, _ -> 1.0 }
    }
}

/** Tells how much of its budget the boat has used, by an odometer or a clock. */
public fun interface BudgetMeter {
    /** Used so far, in the budget's unit. Never goes back. */
    public fun used(): Double
}

/** Knows the way home. */
public fun interface WayHome {
    /**
     * Fills [plan] with the waypoints from ([x], [y]), local frame, m, home; home is the last. Empty where no way is
     * known or the boat is home.
     */
    public fun fill(x: Double, y: Double, plan: Plan)
}

/**
 * Lets another planner plan as long as the boat can still be home within its budget, then brings it home.
 *
 * A waypoint is kept only if what was used, the way to it and the way home from it are within the budget together; what
 * comes after the first that is not is dropped. Where none is kept the way home is planned, and
 * [PlanOutcome.BudgetSpent] is said once the boat is there. So, if home was within the budget when the boat set out and
 * travel costs what [cost] says, the boat never uses more than [limit] (but for rounding) and ends at home. Wind and
 * current cost more as far as the pace says; for what it does not know, and for detours, [reserve] is kept back, and a
 * boat that is held up on its way to a waypoint has [mustTurnBack] to ask. Where no way home is known the boat goes
 * nowhere.
 *
 * No allocation once the buffers have grown, if the other planner and the way home have none. Confined to one thread.
 *
 * @param planner plans while the budget lasts. Retained.
 * @property limit the whole budget, in its unit, at least 0.
 * @property cost what travel costs, in the same unit.
 * @param meter how much has been used. Retained.
 * @param wayHome the way home from any place, through the water. Retained.
 * @param home where the boat has to be in the end.
 * @property reserve share of the way home's cost that is kept back besides, dimensionless, at least 0.
 * @param pace what the water makes of a leg's cost by the metre; asked anew each time. Retained.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public class BudgetedPlanner(
    private val planner: Planner,
    public val limit: Double,
    public val cost: TravelCost,
    private val meter: BudgetMeter,
    private val wayHome: WayHome,
    private val home: Position,
    public val reserve: Double = 0.0,
    private val pace: Pace = Pace.STILL,
) : Planner {
    private val back = Plan()
    private var lookAt = 0.0

    /** Whether the last plan was the way home because the budget allowed nothing else. */
    public var isHomeBound: Boolean = false
        private set

    init {
        require(limit >= 0 && limit.isFinite()) { "limit ($limit) must be at least 0 and finite" }
        require(reserve >= 0 && reserve.isFinite()) { "reserve ($reserve) must be at least 0 and finite" }
    }

    override fun plan(
        map: FieldMap,
        from: Position,
        sensorValue: Double,
        stop: StopCondition,
        plan: Plan,
    ): PlanOutcome {
        isHomeBound = false
        val outcome = planner.plan(map, from, sensorValue, stop, plan)
        val left = limit - meter.used()
        if (plan.size == 0) {
            val canWait = cost.perWaypoint > 0 && cost.perWaypoint + costHome(from.x, from.y) <= left + ROUNDING * limit
            return if (canWait) outcome else goHome(from, plan)
        }
        plan.truncate(affordable(from, plan, left))
        return if (plan.size > 0) PlanOutcome.Planned else goHome(from, plan)
    }

    /**
     * Whether a boat on its way to a waypoint, at ([x], [y]) m, has to turn back: what is left is less than the way
     * home costs from there, or nothing is left where no way home is known. Cheap as long as much is left: the way home
     * is looked for again when an eighth of what was to spare is used up, which a boat needs that goes away from home
     * at seven times the speed that [cost] reckons with; a drift that sets in meanwhile is reckoned with then.
     */
    public fun mustTurnBack(x: Double, y: Double): Boolean {
        val used = meter.used()
        if (used < lookAt) return false
        val spare = limit - used - costHome(x, y)
        if (spare == Double.NEGATIVE_INFINITY) return used >= limit
        lookAt = used + maxOf(spare / LOOKS, if (cost.perMetre > 0) cost.perMetre else cost.perWaypoint)
        return spare < 0
    }

    /** How many waypoints of [plan] can be passed with [left] to be spent. */
    private fun affordable(from: Position, plan: Plan, left: Double): Int {
        var spent = 0.0
        var x = from.x
        var y = from.y
        for (waypoint in 0 until plan.size) {
            spent += leg(x, y, plan.x(waypoint), plan.y(waypoint))
            x = plan.x(waypoint)
            y = plan.y(waypoint)
            // Written so that what is not a number is not affordable.
            if (!(spent + costHome(x, y) <= left + ROUNDING * limit)) return waypoint
        }
        return plan.size
    }

    private fun goHome(from: Position, plan: Plan): PlanOutcome {
        isHomeBound = true
        plan.clear()
        if (from == home) return PlanOutcome.BudgetSpent
        wayHome.fill(from.x, from.y, plan)
        return if (plan.size > 0) PlanOutcome.Planned else PlanOutcome.BudgetSpent
    }

    /** Cost of the way home from ([x], [y]) with the reserve; infinite where none is known. */
    private fun costHome(x: Double, y: Double): Double {
        if (x == home.x && y == home.y) return 0.0
        wayHome.fill(x, y, back)
        if (back.size == 0) return Double.POSITIVE_INFINITY
        var sum = 0.0
        var atX = x
        var atY = y
        for (waypoint in 0 until back.size) {
            sum += leg(atX, atY, back.x(waypoint), back.y(waypoint))
            atX = back.x(waypoint)
            atY = back.y(waypoint)
        }
        return sum * (1 + reserve)
    }

    private fun leg(fromX: Double, fromY: Double, toX: Double, toY: Double) =
        cost.perMetre * hypot(toX - fromX, toY - fromY) * pace.of(toX - fromX, toY - fromY) + cost.perWaypoint

    private companion object {
        /** Share of the limit by which sums along the way may round otherwise than the meter. */
        const val ROUNDING = 1e-12

        /** Share of what is to spare after which the way home is looked for again. */
        const val LOOKS = 8.0
    }
}
