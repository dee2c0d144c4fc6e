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
import stillwater.plan.StraightHome
import stillwater.plan.TravelCost
import stillwater.plan.WaterHome
import stillwater.plan.WaterRoutes
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

/** Tells for how long a boat has come no nearer to where it goes. */
internal class ProgressWatch(private val least: Double) {
    private var nearest = Double.POSITIVE_INFINITY
    private var since = 0.0

    /** Another place is gone for. */
    fun begin() {
        nearest = Double.POSITIVE_INFINITY
    }

    /** Seconds, by [now] in s, since the boat, [distance] m from there now, last came nearer by [least] m. */
    fun idle(now: Double, distance: Double): Double {
        if (distance < nearest - least) {
            nearest = distance
            since = now
        }
        return now - since
    }
}

/**
 * Leads a boat that is off the map, or off the water, to the map; else another planner plans.
 *
 * From the water to the nearest cell's centre that a clear line leads to, else round the land by [routes], which are started
 * here and then at [home] again; where they do not lead there either, nowhere. Off the water any nearest cell will do,
 * because the safety gate leads the boat to the water first.
 */
internal class EntryPlanner(
    private val planner: Planner,
    private val water: WaterArea,
    private val routes: WaterRoutes?,
    private val home: Position,
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
        val mustSee = routes != null && from in water
        val nearest = nearest(map.grid, from, mustSee)
        if (nearest != Grid.OUTSIDE) {
            plan.add(map.grid.centerX(nearest), map.grid.centerY(nearest))
        } else if (mustSee) {
            leadRound(map.grid, from, plan)
        }
        return if (plan.size > 0) PlanOutcome.Planned else outcome
    }

    private fun leadRound(grid: Grid, from: Position, plan: Plan) {
        val routes = routes ?: return
        routes.start(from.x, from.y)
        val inside = (0 until routes.points).filter { grid.cellAt(routes.x(it), routes.y(it)) != Grid.OUTSIDE }
        inside.minByOrNull(routes::distance)?.let { routes.wayTo(it, plan) }
        routes.start(home.x, home.y)
    }

    private fun nearest(grid: Grid, from: Position, mustSee: Boolean): Int {
        var best = Grid.OUTSIDE
        var least = Double.POSITIVE_INFINITY
        for (cell in 0 until grid.size) {
            val x = grid.centerX(cell)
            val y = grid.centerY(cell)
            val distance = hypot(x - from.x, y - from.y)
            if (distance < least &&
                (if (mustSee) water.isClear(from.x, from.y, x, y, 0.0) else water.contains(x, y))
            ) {
                least = distance
                best = cell
            }
        }
        return best
    }
}

/**
 * Where to steer: along the plan, home, or back to where the boat holds. Plans when the last waypoint was reached or was
 * given up, which it is where the boat has come no nearer for [PATIENCE] s: on weeds, against a current, or where the
 * safety gate lets it come no nearer. After [MOST_GIVEN_UP] on end the mission is over. Confined to one thread.
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
    private val routes = ways(spec, water)
    private val wayHome = if (routes == null) StraightHome(home) else WaterHome(routes, home)
    private val follower = WaypointFollower(spec.boat.follower().copy(turnThrust = mixing.turnThrust))
    private val planner = BudgetedPlanner(
        EntryPlanner(spec.planner.build(spec, water, Random(spec.seed)), water, routes, home),
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
    private val progress = ProgressWatch(spec.boat.arrival)
    private var givenUpOnEnd = 0

    /** In which a slow boat, too, comes nearer by an arrival radius, s. */
    private val slowness = SLOWEST * spec.boat.arrival / spec.boat.cruise

    /** Waypoints that were given up. */
    var givenUp = 0L
        private set

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
    val isHome: Boolean get() = aim == Aim.HOME && knowsWay && next >= plan.size && (follower.arrived || isNearHome)

    /** Whether the boat is about home and comes no nearer, as where home lies nearer to the shore than the gate lets it. */
    private var isNearHome = false

    /** The waypoints ahead, the one steered for first. */
    fun ahead(): List<Position> = plan.waypoints().drop(maxOf(0, next - 1))

    /** Forgets the way: the boat does not steer. */
    fun rest() {
        turnTo(Aim.NOTHING)
    }

    /** Goes where the planner says, [now], s; [value] is what the sensor says. */
    fun survey(now: Double, map: FieldMap, value: Double) {
        turnTo(Aim.SURVEY)
        if (planner.mustTurnBack(track.x, track.y)) isHomeBound = true
        var from = Position(track.x, track.y)
        if (follower.arrived) {
            givenUpOnEnd = 0
        } else {
            val goal = Position(plan.x(next - 1), plan.y(next - 1))
            val isNear = isNear(goal)
            val patience = slowness + if (isNear) PATIENCE_NEAR else PATIENCE
            if (progress.idle(now, from.distanceTo(goal)) < patience) return
            if (!isNear && !giveUp()) return
            // Asked from where the boat is, a planner that goes in order would say the same again.
            if (!spec.planner.keepsToWater) from = goal
        }
        if (next >= plan.size) replan(map, value, from)
        if (next < plan.size) nextLeg()
    }

    /** So near that what keeps the boat off may be no more than how well its place is known. */
    private fun isNear(place: Position) =
        hypot(track.x - place.x, track.y - place.y) <= HOLDING * (spec.boat.arrival + track.deviation)

    /** Answers whether something else is to be tried. */
    private fun giveUp(): Boolean {
        givenUp++
        givenUpOnEnd++
        isOver = givenUpOnEnd >= MOST_GIVEN_UP
        return !isOver
    }

    /** Goes home, [now], s. */
    fun goHome(now: Double) {
        val isAfloat = water.contains(track.x, track.y)
        if (turnTo(Aim.HOME) || (isAfloat && !knowsWay)) fillWayHome(isAfloat)
        if (follower.arrived && next < plan.size) nextLeg()
        val off = hypot(track.x - home.x, track.y - home.y)
        isNearHome = progress.idle(now, off) >= slowness + PATIENCE_NEAR && isNear(home)
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
        isNearHome = false
        progress.begin()
        // A leg of no length to where the boat is counts as reached at the next look.
        follower.leg(track.x, track.y, track.x, track.y)
        follower.steer(track, 0.0, 0.0)
    }

    private fun replan(map: FieldMap, value: Double, here: Position) {
        plans++
        next = 0
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
        progress.begin()
        next++
    }

    private companion object {
        /** Time a waypoint costs beyond its distance, s: slowing down and turning. */
        const val TURN_TIME = 5.0

        /** The follower lets a waypoint count as passed within three arrival radii; deviations of the place that may lack. */
        const val HOLDING = 3.0

        /** A waypoint to which the boat has come no nearer for so long is given up, s. */
        const val PATIENCE = 60.0

        /** The same where it [isNear], s: there it counts as reached. */
        const val PATIENCE_NEAR = 10.0

        /** Of the cruise speed a boat that makes way keeps one in so many. */
        const val SLOWEST = 4.0

        /** Waypoints given up on end after which nothing more is tried. */
        const val MOST_GIVEN_UP = 3
    }
}
