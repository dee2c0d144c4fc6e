package stillwater.mission

import stillwater.control.Fence
import stillwater.control.Mixing
import stillwater.control.TrackEstimator
import stillwater.control.WaypointFollower
import stillwater.field.FieldMap
import stillwater.model.Drive
import stillwater.model.Grid
import stillwater.model.Plan
import stillwater.model.Position
import stillwater.model.WaterArea
import stillwater.plan.BudgetedPlanner
import stillwater.plan.PlanOutcome
import stillwater.plan.Planner
import stillwater.plan.StopCondition
import stillwater.plan.TravelCost
import kotlin.math.hypot
import kotlin.random.Random

/** How much of its budget the mission has used: metres over ground or seconds under way. */
internal class BudgetUse(private val budget: BudgetSpec) {
    /** Used so far, in the budget's unit. */
    var used = 0.0
        private set

    /** Goes on from [used]. */
    fun resume(used: Double) {
        this.used = used
    }

    /** Counts [seconds] s under way at [speed] m/s over ground. */
    fun advance(seconds: Double, speed: Double) {
        used += if (budget.metres != null) seconds * speed else seconds
    }
}

/** Leads a boat that is off the map, or off the water, to the nearest cell of it; else another planner plans. */
internal class EntryPlanner(private val planner: Planner, private val water: WaterArea) : Planner {
    override fun plan(
        map: FieldMap,
        from: Position,
        sensorValue: Double,
        stop: StopCondition,
        plan: Plan,
    ): PlanOutcome {
        val outcome = planner.plan(map, from, sensorValue, stop, plan)
        if (outcome != PlanOutcome.OffMap && outcome != PlanOutcome.OffWater) return outcome
        val nearest = nearest(map.grid, from)
        if (nearest == Grid.OUTSIDE) return outcome
        plan.clear()
        plan.add(map.grid.centerX(nearest), map.grid.centerY(nearest))
        return PlanOutcome.Planned
    }

    private fun nearest(grid: Grid, from: Position): Int {
        var best = Grid.OUTSIDE
        var least = Double.POSITIVE_INFINITY
        for (cell in 0 until grid.size) {
            val x = grid.centerX(cell)
            val y = grid.centerY(cell)
            val distance = hypot(x - from.x, y - from.y)
            if (distance < least && water.contains(x, y)) {
                least = distance
                best = cell
            }
        }
        return best
    }
}

/**
 * Where to steer: along the plan, home, or back to where the boat holds. Plans when the last waypoint was reached.
 * Confined to one thread.
 */
internal class Navigator(
    private val spec: MissionSpec,
    private val water: WaterArea,
    private val fence: Fence,
    private val track: TrackEstimator,
    use: BudgetUse,
    mixing: Mixing,
) {
    private enum class Aim { NOTHING, SURVEY, HOME, HOLD }

    private val home = spec.home.position
    private val wayHome = wayHome(spec, water)
    private val follower = WaypointFollower(spec.boat.follower().copy(turnThrust = mixing.turnThrust))
    private val planner = BudgetedPlanner(
        EntryPlanner(spec.planner.build(spec, water, Random(spec.seed)), water),
        limit = spec.budget.metres ?: spec.budget.seconds ?: 0.0,
        cost = if (spec.budget.metres != null) TravelCost(1.0, 0.0) else TravelCost(1 / spec.boat.cruise, TURN_TIME),
        meter = { use.used },
        wayHome = wayHome,
        home = home,
        reserve = spec.budget.reserve,
    )
    private val plan = Plan()
    private var next = 0
    private var aim = Aim.NOTHING
    private var knowsWay = false

    /** Times the planner was asked. */
    var plans = 0L
        private set

    /** Whether the budget allows no more than the way home; stays so. */
    var isHomeBound = false
        private set

    /** Whether the planner has nowhere to go any more. */
    var isOver = false
        private set

    /** Whether the boat came home on purpose. */
    val isHome: Boolean get() = aim == Aim.HOME && knowsWay && follower.arrived && next >= plan.size

    /** The waypoints ahead, the one steered for first. */
    fun ahead(): List<Position> = plan.waypoints().drop(maxOf(0, next - 1))

    /** Forgets the way: the boat does not steer. */
    fun rest() {
        turnTo(Aim.NOTHING)
    }

    /** Goes where the planner says; [value] is what the sensor says now. */
    fun survey(map: FieldMap, value: Double) {
        turnTo(Aim.SURVEY)
        if (!follower.arrived) return
        if (next >= plan.size) replan(map, value)
        if (next < plan.size) nextLeg()
    }

    /** Goes home. */
    fun goHome() {
        val isAfloat = water.contains(track.x, track.y)
        if (turnTo(Aim.HOME) || (isAfloat && !knowsWay)) fillWayHome(isAfloat)
        if (follower.arrived && next < plan.size) nextLeg()
        if (isHomeBound && isHome) isOver = true
    }

    /** From off the water, as believed, the nearest of it comes first, and the way is asked for again from there. */
    private fun fillWayHome(isAfloat: Boolean) {
        startLegs()
        wayHome.fill(track.x, track.y, plan)
        knowsWay = isAfloat
        if (plan.size > 0) return
        if (isAfloat) {
            plan.add(home.x, home.y)
        } else {
            val deep = HOLDING * spec.boat.arrival - fence.distance(track.x, track.y)
            plan.add(track.x + deep * fence.inwardX, track.y + deep * fence.inwardY)
        }
    }

    /** Stays where the boat is, and comes back when it was carried off. */
    fun hold() {
        if (turnTo(Aim.HOLD)) {
            plan.add(track.x, track.y)
            next = plan.size
        }
        val off = hypot(track.x - plan.x(0), track.y - plan.y(0))
        if (follower.arrived && off > HOLDING * spec.boat.arrival) {
            follower.leg(track.x, track.y, plan.x(0), plan.y(0))
        }
    }

    /** What to do now, [heading] in rad, [yawRate] in rad/s. */
    fun steer(heading: Double, yawRate: Double): Drive =
        if (aim == Aim.NOTHING) Drive.NONE else follower.steer(track, heading, yawRate)

    /** Answers whether this aim is a new one; then no leg of the old one is left. */
    private fun turnTo(wanted: Aim): Boolean {
        if (aim == wanted) return false
        aim = wanted
        startLegs()
        return true
    }

    private fun startLegs() {
        plan.clear()
        next = 0
        // A leg of no length to where the boat is counts as reached at the next look.
        follower.leg(track.x, track.y, track.x, track.y)
        follower.steer(track, 0.0, 0.0)
    }

    private fun replan(map: FieldMap, value: Double) {
        plans++
        next = 0
        val here = Position(track.x, track.y)
        // The budgeted planner asks whether the boat is home to the last digit.
        val from = if (here.distanceTo(home) <= HOLDING * spec.boat.arrival) home else here
        val outcome = planner.plan(map, from, value, StopCondition.NEVER, plan)
        isOver = outcome != PlanOutcome.Planned
        if (planner.isHomeBound) isHomeBound = true
    }

    private fun nextLeg() {
        val after = next + 1
        val fromX = if (next == 0) track.x else plan.x(next - 1)
        val fromY = if (next == 0) track.y else plan.y(next - 1)
        val afterX = if (after < plan.size) plan.x(after) else Double.NaN
        val afterY = if (after < plan.size) plan.y(after) else Double.NaN
        follower.leg(fromX, fromY, plan.x(next), plan.y(next), afterX, afterY)
        next++
    }

    private companion object {
        /** Time a waypoint costs beyond its distance, s: slowing down and turning. */
        const val TURN_TIME = 5.0

        /** The follower lets a waypoint count as passed within three arrival radii. */
        const val HOLDING = 3.0
    }
}
