package stillwater.contract

import org.junit.jupiter.api.DynamicTest
import org.junit.jupiter.api.DynamicTest.dynamicTest
import org.junit.jupiter.api.TestFactory
import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.Plan
import stillwater.model.Position
import stillwater.plan.BoundedExtendedPlannerSettings
import stillwater.plan.BoundedPlannerSettings
import stillwater.plan.Execution
import stillwater.plan.InformationPlannerSettings
import stillwater.plan.LawnmowerPattern
import stillwater.plan.PathChoice
import stillwater.plan.PlanOutcome
import stillwater.plan.Planner
import stillwater.plan.PolygonRrtSettings
import stillwater.plan.StopCondition
import stillwater.plan.WalkSteps
import stillwater.run.PlannerKind
import stillwater.run.PlannerSettings
import kotlin.math.abs
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** What every planner must do whatever the map, run on every [PlannerKind] with every setting that counts for it. */
class PlannerContractTest {
    private class Subject(val kind: PlannerKind, val settings: PlannerSettings, setting: Any) {
        val name = "${kind.label}, $setting"

        /** Whether one waypoint shares an edge with the next. */
        val movesByEdges = when (kind) {
            PlannerKind.RANDOM_WALK -> settings.walk == WalkSteps.EDGE
            PlannerKind.LAWNMOWER -> settings.pattern != LawnmowerPattern.RASTER
            PlannerKind.POLYGON_RRT -> false
            PlannerKind.BOUNDED, PlannerKind.BOUNDED_EXTENDED, PlannerKind.INFORMATION -> true
            PlannerKind.SETTLING_LAWNMOWER -> false
        }

        fun build(seed: Int): Planner = kind.planner(Random(seed), settings)
    }

    private val subjects = PlannerKind.entries.flatMap { kind ->
        when (kind) {
            PlannerKind.RANDOM_WALK -> WalkSteps.entries.map { Subject(kind, PlannerSettings(walk = it), it) }
            PlannerKind.LAWNMOWER -> LawnmowerPattern.entries.map { Subject(kind, PlannerSettings(pattern = it), it) }
            PlannerKind.SETTLING_LAWNMOWER -> LawnmowerPattern.entries.map {
                Subject(kind, PlannerSettings(pattern = it), it)
            }
            PlannerKind.BOUNDED -> boundedSettings().map { Subject(kind, PlannerSettings(bounded = it), it) }
            PlannerKind.POLYGON_RRT -> listOf(1, 30).map { PolygonRrtSettings(it) }
                .map { Subject(kind, PlannerSettings(polygonRrt = it), it) }
            PlannerKind.BOUNDED_EXTENDED -> listOf(1 to 1, 3 to 30, 10 to 200)
                .map { (horizon, expansions) -> BoundedExtendedPlannerSettings(horizon, expansions) }
                .map { Subject(kind, PlannerSettings(boundedExtended = it), it) }
            PlannerKind.INFORMATION -> informationSettings().map {
                Subject(kind, PlannerSettings(information = it), it)
            }
        }
    }

    private fun informationSettings() = listOf(
        InformationPlannerSettings(),
        InformationPlannerSettings(horizon = 1, settling = 0.0),
        InformationPlannerSettings(horizon = 3, moves = 2, speed = 0.01),
    )

    private fun boundedSettings() = Execution.entries.flatMap { execution ->
        PathChoice.entries.flatMap { choice ->
            listOf(1 to 1, 3 to 30, 10 to 200).map { (horizon, expansions) ->
                BoundedPlannerSettings(
                    horizon,
                    expansions,
                    maxChange = 0.1,
                    discountVisits = horizon != 3,
                    execution,
                    choice,
                )
            }
        }
    }

    private fun forEveryPlanner(cases: Int, law: (Subject, Mission) -> Unit): List<DynamicTest> =
        subjects.map { subject -> dynamicTest(subject.name) { forEvery(cases, ::Mission) { law(subject, it) } } }

    private class Decision(val from: Position, val sensor: Double, val asks: Int) {
        fun stop(): StopCondition {
            var left = asks
            return StopCondition { left-- <= 0 }
        }
    }

    /** A map of any shape and content, and decisions asked of one planner one after another. */
    private class Mission(random: Random) {
        val seed = random.nextInt()
        val grid = Grid(
            Position(random.between(-1e3, 1e3), random.between(-1e3, 1e3)),
            columns = random.nextInt(1, 7),
            rows = random.nextInt(1, 7),
            cellWidth = random.between(0.5, 50.0),
            cellHeight = random.between(0.5, 50.0),
            rotation = random.between(-4.0, 4.0),
        )
        val map = FieldMap(grid, Interval.UNIT)
        val decisions = List(random.nextInt(1, 12)) {
            val cell = random.nextInt(grid.size)
            val from = if (random.nextInt(6) == 0) {
                Position(random.hostile(-2e3, 2e3), random.hostile(-2e3, 2e3))
            } else {
                grid.center(cell)
            }
            Decision(
                from,
                random.hostile(-0.5, 1.5),
                asks = if (random.nextBoolean()) Int.MAX_VALUE else random.nextInt(4),
            )
        }

        init {
            for (cell in 0 until grid.size) {
                when (random.nextInt(4)) {
                    0 -> map.setBounds(cell, random.nextDouble(), random.nextDouble())
                    1 -> map.setBounds(cell, random.hostile(0.0, 0.5), random.hostile(0.5, 1.0))
                    else -> map.setBounds(cell, random.between(0.0, 0.4), random.between(0.6, 1.0))
                }
            }
        }

        override fun toString() = "$grid, seed $seed, ${content(map)}, " +
            decisions.map { "${it.from} ${it.sensor} ${it.asks}" }
    }

    private fun Planner.decide(mission: Mission, decision: Decision, plan: Plan): PlanOutcome {
        plan.add(12.0, 34.0)
        return plan(mission.map, decision.from, decision.sensor, decision.stop(), plan)
    }

    @TestFactory
    fun plansWithinTheGridAndSaysWhatCameOfIt() = forEveryPlanner(cases = 150) { subject, mission ->
        val planner = subject.build(mission.seed)
        val plan = Plan()
        for (decision in mission.decisions) {
            val outcome = planner.decide(mission, decision, plan)
            assertEquals(outcome == PlanOutcome.Planned, plan.size > 0, "$outcome with ${plan.size} waypoints")
            val start = mission.grid.cellAt(decision.from)
            assertEquals(outcome == PlanOutcome.OffMap, start == Grid.OUTSIDE, "$outcome from ${decision.from}")
            if (outcome == PlanOutcome.Stopped) assertTrue(decision.asks < Int.MAX_VALUE, "stopped by itself")
            assertPath(subject, mission.grid, start, plan)
        }
    }

    private fun assertPath(subject: Subject, grid: Grid, start: Int, plan: Plan) {
        var from = start
        for (i in 0 until plan.size) {
            val to = grid.cellAt(plan.x(i), plan.y(i))
            assertTrue(to != Grid.OUTSIDE, "waypoint $i (${plan.x(i)}, ${plan.y(i)}) is off the grid")
            if (subject.kind.inPlane) continue
            assertEquals(grid.center(to), Position(plan.x(i), plan.y(i)), "waypoint $i is no cell's centre")
            if (subject.movesByEdges) {
                val columns = abs(from % grid.columns - to % grid.columns)
                val rows = abs(from / grid.columns - to / grid.columns)
                assertEquals(1, columns + rows, "from cell $from to $to of ${grid.columns} x ${grid.rows}")
            }
            from = to
        }
    }

    @TestFactory
    fun doesNotChangeTheMap() = forEveryPlanner(cases = 60) { subject, mission ->
        val planner = subject.build(mission.seed)
        val before = content(mission.map)
        for (decision in mission.decisions) planner.decide(mission, decision, Plan())
        assertEquals(before, content(mission.map))
        assertEquals(0L, mission.map.outside + mission.map.rejected)
    }

    @TestFactory
    fun isTheSameWithTheSameSeedWhateverThePlanHeld() = forEveryPlanner(cases = 60) { subject, mission ->
        val planner = subject.build(mission.seed)
        val other = subject.build(mission.seed)
        val used = Plan()
        for (decision in mission.decisions) {
            val fresh = Plan(capacity = 1)
            assertEquals(planner.decide(mission, decision, used), other.decide(mission, decision, fresh))
            assertEquals(used.waypoints(), fresh.waypoints())
        }
    }

    @TestFactory
    fun changesGridsInMidMission() = forEveryPlanner(cases = 60) { subject, mission ->
        val planner = subject.build(mission.seed)
        val plan = Plan()
        val small = FieldMap(Grid.unit(1 + mission.seed.mod(4), 2), Interval.UNIT)
        for (decision in mission.decisions) {
            planner.decide(mission, decision, plan)
            val outcome = planner.plan(small, small.grid.center(1), 0.5, StopCondition.NEVER, plan)
            assertEquals(outcome == PlanOutcome.Planned, plan.size > 0)
            assertPath(subject, small.grid, 1, plan)
        }
    }
}
