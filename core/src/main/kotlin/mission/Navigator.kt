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
import stillwater.plan.ClosedCells
import stillwater.plan.DetourPlanner
import stillwater.plan.Pace
import stillwater.plan.PlanOutcome
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

/**
 * Where to steer: along the plan, home, or back to where the boat holds. Plans when the last waypoint was reached or
 * was given up, which it is where the boat has come no nearer for [PATIENCE] s: on weeds, against a current, or where
 * the safety gate lets it come no nearer; [HoldUps] says what then, and [HomeTries] on the way home. Confined to one
 * thread.
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
    private val closed = ClosedCells(spec.grid.grid(), water, spec.boat.arrival)
    private val ways = ways(spec, water, closed)
    private val follower = WaypointFollower(spec.boat.follower().copy(turnThrust = mixing.turnThrust))
    private val drift = DriftPace(track, spec.boat.cruise)
    private val detour = DetourPlanner(spec.planner.build(spec, water, Random(spec.seed)), closed, ways)
    private val planner = BudgetedPlanner(
        EntryPlanner(detour, water, ways, closed),
        limit = spec.budget.metres ?: spec.budget.seconds ?: 0.0,
        cost = if (spec.budget.metres != null) TravelCost(1.0, 0.0) else TravelCost(1 / spec.boat.cruise, TURN_TIME),
        meter = { use.used },
        wayHome = ways,
        home = home,
        reserve = spec.budget.reserve,
        pace = if (spec.budget.metres != null) Pace.STILL else drift,
    )
    private val plan = Plan()
    private var next = 0
    private var aim = Aim.NOTHING
    private var knowsWay = false
    private val holdUps = HoldUps(closed, HOLDING * spec.boat.arrival)
    private val progress = ProgressWatch(spec.boat.arrival)
    private var goal: Position? = null
    private var nearGoal: Position? = null

    /** From where the next plan is made, while the ways that it needs are worked on. */
    private var planFrom: Position? = null

    /** Where the boat was when it last began to survey. */
    private var surveyFrom = home

    /** Whether the way home is still to be found. */
    private var seeksHome = false
    private var comebacks = 0
    private val homeward = ProgressWatch(spec.boat.arrival)
    private val tries = HomeTries(HOLDING * spec.boat.arrival)
    private var leftAtFirst = Double.NaN

    /** In which a slow boat, too, comes nearer by an arrival radius, s. */
    private val slowness = SLOWEST * spec.boat.arrival / spec.boat.cruise

    /** Waypoints that were given up. */
    val givenUp: Long get() = holdUps.count

    /** Where the boat did not get in. Allocates. */
    val givenUpCells: GivenUp get() = GivenUp(closed.mapCells(), closed.offMap())

    /** Changes whenever [givenUpCells] may have changed. */
    val givenUpVersion: Int get() = closed.version

    /** Times the planner was asked. */
    var plans = 0L
        private set

    /** Whether the budget allows no more than the way home; stays so. */
    var isHomeBound = false
        private set

    /** Whether there is nowhere to go any more. */
    var isOver = false
        private set

    /** Whether no way home is tried any more; stays so. */
    val isStranded: Boolean get() = tries.isStranded

    /** Rests on the way home so far, [now] in s; null where there was none. */
    fun restAt(now: Double): HomeRest? = tries.rest(now)

    /** For how long a boat that was held up on every way home rests before it tries again, s, [now] in s; else 0. */
    fun restsFor(now: Double): Double = tries.restsFor(now)

    /** Begins the count of ways home anew, as where a person wants something else of a boat that rests. */
    fun tryAnew() = tries.beginAnew()

    /** Whether the boat came home on purpose. */
    val isHome: Boolean get() = aim == Aim.HOME && knowsWay && next >= plan.size && (follower.arrived || isNearHome)

    /**
     * Whether the boat is about home and comes no nearer, as where home lies nearer to the shore than the gate lets it.
     */
    private var isNearHome = false

    /** The waypoints ahead, the one steered for first. */
    fun ahead(): List<Position> = plan.waypoints().drop(maxOf(0, next - 1))

    /**
     * Goes on [now], s, after a restart before which the boat did not get in where [before] says, and had a [rest] on
     * its way home.
     */
    fun resume(before: GivenUp, rest: HomeRest?, now: Double) {
        rest?.let { tries.resume(it, now) }
        val map = closed.map
        val cells = before.cells.filter { it in 0 until map.size }.map { closed.at(map.centerX(it), map.centerY(it)) }
        for (cell in (cells + before.offMap.map { closed.at(it.x, it.y) }).distinct()) {
            if (cell != Grid.OUTSIDE) closed.close(cell, now)
        }
    }

    /** Forgets the way: the boat does not steer. */
    fun rest() {
        turnTo(Aim.NOTHING)
    }

    /** Goes where the planner says, [now], s; [value] is what the sensor says. */
    fun survey(now: Double, map: FieldMap, value: Double) {
        if (aim == Aim.HOME) comebacks++
        turnTo(Aim.SURVEY)
        if (planFrom == null && planner.mustTurnBack(track.x, track.y)) isHomeBound = true
        val from = planFrom ?: turningPoint(now) ?: return
        if (next >= plan.size && !isPlanned(now, map, value, from)) return
        if (next < plan.size) nextLeg()
    }

    /** From where to go on to the next waypoint; null where the boat is on its way to one, or nowhere is left to go. */
    private fun turningPoint(now: Double): Position? {
        val here = Position(track.x, track.y)
        if (follower.arrived) {
            arrive(here)
            return here
        }
        val goal = waypoint(next - 1)
        val isNear = isNear(goal)
        if (progress.isGettingOn) drift.look()
        if (!isHeldUp(now, here.distanceTo(goal), isNear && goal == nearGoal, isNear)) return null
        if (!isNear) return here.takeIf { giveUp(now, here, goal) }
        nearGoal = goal
        // Asked from where the boat is, a planner that goes in order would say the same again.
        return if (spec.planner.keepsToWater) here else goal
    }

    private fun arrive(here: Position) {
        if (next == 0) return holdUps.setOut(here)
        // What held it up on its ways home no longer does.
        if (here.distanceTo(surveyFrom) > HOLDING * spec.boat.arrival) tries.beginAnew()
        holdUps.arrived(here, waypoint(next - 1))
        progress.begin()
        nearGoal = null
    }

    private fun isHeldUp(now: Double, distance: Double, isKnownToBeNear: Boolean, isNear: Boolean): Boolean {
        val patience = slowness + if (isNear) PATIENCE_NEAR else PATIENCE
        return progress.idle(now, distance) >= patience || isKnownToBeNear || comebacks >= MOST_COMEBACKS
    }

    /** So near that what keeps the boat off may be no more than how well its place is known. */
    private fun isNear(place: Position) =
        hypot(track.x - place.x, track.y - place.y) <= HOLDING * (spec.boat.arrival + track.deviation) + track.doubt

    /** Answers whether something else is to be tried. */
    private fun giveUp(now: Double, here: Position, goal: Position): Boolean {
        val instead = holdUps.giveUp(now, here, goal)
        isOver = holdUps.isHeld
        plan.clear()
        next = 0
        nearGoal = null
        comebacks = 0
        if (instead != null) plan.add(instead.x, instead.y)
        return !isOver
    }

    /** Goes home, [now], s; [isDriven] tells whether the motors may run. */
    fun goHome(now: Double, isDriven: Boolean) {
        val isAfloat = water.contains(track.x, track.y)
        if (turnTo(Aim.HOME) || (isAfloat && !knowsWay && !seeksHome)) seekHome()
        if (seeksHome) {
            if (!ways.prepareHome(track.x, track.y, POINTS_A_STEP)) return
            fillWayHome(isAfloat)
        }
        if (follower.arrived && next < plan.size) nextLeg()
        val off = hypot(track.x - home.x, track.y - home.y)
        isNearHome = progress.idle(now, off) >= slowness + PATIENCE_NEAR && isNear(home)
        val patience = if (isDriven) slowness + PATIENCE else PATIENCE_ADRIFT
        if (!isHome && homeward.idle(now, leftToGo()) >= patience) findOtherWayHome(now)
        if (isHomeBound && isHome) isOver = true
    }

    private fun leftToGo(): Double {
        var sum = 0.0
        var x = track.x
        var y = track.y
        for (i in maxOf(0, next - 1) until plan.size) {
            sum += hypot(plan.x(i) - x, plan.y(i) - y)
            x = plan.x(i)
            y = plan.y(i)
        }
        return sum
    }

    private fun findOtherWayHome(now: Double) {
        val goal = waypoint(maxOf(0, next - 1))
        val cell = closed.ahead(track.x, track.y, goal.x, goal.y)
        val isNew = cell != Grid.OUTSIDE && !closed.isKnown(cell)
        val isAlong = isNew && leftAtFirst - leftToGo() >= spec.grid.cell / 2
        val left = hypot(track.x - home.x, track.y - home.y)
        if (cell != Grid.OUTSIDE && !closed.isClosed(cell)) closed.close(cell, now)
        homeward.begin()
        if (tries.heldUp(now, left, isAlong)) seekHome()
    }

    private fun seekHome() {
        startLegs()
        knowsWay = false
        seeksHome = true
    }

    /** From off the water, as believed, the nearest of it comes first, and the way is asked for again from there. */
    private fun fillWayHome(isAfloat: Boolean) {
        seeksHome = false
        ways.fill(track.x, track.y, plan)
        knowsWay = isAfloat
        if (plan.size == 0 && isAfloat) {
            plan.add(home.x, home.y)
        } else if (plan.size == 0) {
            val deep = HOLDING * spec.boat.arrival - fence.distance(track.x, track.y)
            plan.add(track.x + deep * fence.inwardX, track.y + deep * fence.inwardY)
        }
        leftAtFirst = leftToGo()
        homeward.resume(leftAtFirst)
    }

    /**
     * Stays where the boat is, and comes back when it was carried off, by more than fixes that jump could make believe.
     */
    fun hold() {
        if (turnTo(Aim.HOLD)) {
            plan.add(track.x, track.y)
            next = plan.size
        }
        val off = hypot(track.x - plan.x(0), track.y - plan.y(0))
        if (follower.arrived && off > HOLDING * spec.boat.arrival + track.doubt) {
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
        if (wanted == Aim.SURVEY) surveyFrom = Position(track.x, track.y)
        startLegs()
        return true
    }

    private fun startLegs() {
        plan.clear()
        next = 0
        isNearHome = false
        planFrom = null
        seeksHome = false
        stay()
    }

    private fun stay() {
        // A leg of no length to where the boat is counts as reached at the next look.
        follower.leg(track.x, track.y, track.x, track.y)
        follower.steer(track, 0.0, 0.0)
    }

    /**
     * Plans from [here], or works on the ways that a plan needs where cells are closed: a part in a step, in which the
     * boat rests, because all of them would take longer than a step may. Answers whether that is done.
     */
    private fun isPlanned(now: Double, map: FieldMap, value: Double, here: Position): Boolean {
        if (planFrom == null) closed.expire(now)
        // The budgeted planner asks whether the boat is home to the last digit.
        val from = if (here.distanceTo(home) <= HOLDING * spec.boat.arrival) home else here
        if (!detour.prepare(map.grid, from, POINTS_A_STEP)) {
            if (planFrom == null) stay()
            planFrom = here
            return false
        }
        planFrom = null
        plans++
        next = 0
        val outcome = planner.plan(map, from, value, StopCondition.NEVER, plan)
        isOver = outcome != PlanOutcome.Planned
        if (planner.isHomeBound) isHomeBound = true
        return true
    }

    private fun waypoint(index: Int) = Position(plan.x(index), plan.y(index))

    private fun nextLeg() {
        val after = next + 1
        val fromX = if (next == 0) track.x else plan.x(next - 1)
        val fromY = if (next == 0) track.y else plan.y(next - 1)
        val afterX = if (after < plan.size) plan.x(after) else Double.NaN
        val afterY = if (after < plan.size) plan.y(after) else Double.NaN
        follower.leg(fromX, fromY, plan.x(next), plan.y(next), afterX, afterY)
        watch(waypoint(next))
        next++
    }

    /**
     * A link that is cut again and again, or a fence that the boat is turned back from, makes no new waypoint of an
     * old.
     */
    private fun watch(goal: Position) {
        if (aim == Aim.SURVEY && goal == this.goal) {
            progress.resume(hypot(track.x - goal.x, track.y - goal.y))
            return
        }
        progress.begin()
        if (aim != Aim.SURVEY) return
        this.goal = goal
        comebacks = 0
    }

    private companion object {
        /** Time a waypoint costs beyond its distance, s: slowing down and turning. */
        const val TURN_TIME = 5.0

        /**
         * The follower lets a waypoint count as passed within three arrival radii; deviations of the place that may
         * lack.
         */
        const val HOLDING = 3.0

        /** A waypoint to which the boat has come no nearer for so long is given up, s. */
        const val PATIENCE = 60.0

        /** The same where it [isNear], s: there it counts as reached. */
        const val PATIENCE_NEAR = 10.0

        /** The same on the way home while the motors rest, s: what carries a boat off may bring it back. */
        const val PATIENCE_ADRIFT = 600.0

        /** Of the cruise speed a boat that makes way keeps one in so many. */
        const val SLOWEST = 4.0

        /** Points to which ways are found in a step: some 2 ms (docs/performance.md); a lattice has up to 250 000. */
        const val POINTS_A_STEP = 10_000

        /** Times a boat may be turned back by the fence on its way to one waypoint. */
        const val MOST_COMEBACKS = 3
    }
}
