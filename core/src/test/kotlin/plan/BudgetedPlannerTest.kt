package stillwater.plan

import org.junit.jupiter.api.Test
import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Plan
import stillwater.model.Position
import stillwater.property.between
import stillwater.property.drawn
import stillwater.property.forEvery
import kotlin.math.hypot
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class BudgetedPlannerTest {
    /** A boat that runs the first waypoints of each plan, as many as chance says, and pays for them. */
    private class Trip(val map: FieldMap, val home: Position, val cost: TravelCost, private val random: Random) {
        var spent = 0.0
        var at = home
        var turns = 0
        private val plan = Plan()

        fun run(planner: Planner, check: (Position, Plan) -> Unit = { _, _ -> }) {
            while (turns++ < MOST_TURNS) {
                val outcome = planner.plan(map, at, 0.5, StopCondition.NEVER, plan)
                if (outcome == PlanOutcome.BudgetSpent) return
                check(at, plan)
                if (plan.size == 0) spent += cost.perWaypoint
                val run = if (plan.size > 1 && random.nextInt(3) == 0) random.nextInt(1, plan.size) else plan.size
                for (i in 0 until run) {
                    spent += cost.perWaypoint + cost.perMetre * hypot(plan.x(i) - at.x, plan.y(i) - at.y)
                    at = Position(plan.x(i), plan.y(i))
                }
            }
        }
    }

    private class Case(random: Random) {
        val seed = random.nextInt()
        val columns = random.nextInt(1, 9)
        val rows = random.nextInt(2, 9)
        val home = random.nextInt(columns * rows)
        val cost = when (random.nextInt(3)) {
            0 -> TravelCost(0.0, 1.0)
            1 -> TravelCost(random.between(0.1, 3.0), 0.0)
            else -> TravelCost(random.between(0.1, 3.0), random.between(0.01, 2.0))
        }
        val limit = random.between(0.0, 120.0)
        val kind = random.nextInt(4)

        fun planner(random: Random): Planner = when (kind) {
            0 -> RandomWalk(random)
            1 -> Lawnmower(LawnmowerPattern.entries.random(random))
            2 -> BoundedPlanner(random, BoundedPlannerSettings(expansions = 20))
            else -> PolygonRrt(random, settings = PolygonRrtSettings(iterations = 20))
        }

        override fun toString() = "$columns x $rows, home $home, $cost, limit $limit, planner $kind, seed $seed"
    }

    @Test
    fun neverUsesMoreThanItsBudgetAndEndsAtHome() = forEvery(drawn(::Case), cases = 300) { case ->
        val random = Random(case.seed)
        val map = randomMap(random, case.columns, case.rows)
        val trip = Trip(map, map.grid.center(case.home), case.cost, random)
        val way = if (case.kind == 3) StraightHome(trip.home) else CellsHome(map.grid, case.home)
        trip.run(BudgetedPlanner(case.planner(random), case.limit, case.cost, { trip.spent }, way, trip.home))
        // Sums of the same numbers in another order.
        assertTrue(trip.spent <= case.limit * (1 + 1e-9), "used ${trip.spent}")
        assertEquals(trip.home, trip.at)
        assertTrue(trip.turns <= MOST_TURNS, "came to an end")
    }

    @Test
    fun comesHomeThroughTheWater() = forEvery(drawn(::Lake), cases = 60) { lake ->
        val random = Random(lake.seed)
        val home = lake.place(random) ?: return@forEvery
        val routes = WaterRoutes(lake.area, lake.margin, 1.5)
        if (!routes.start(home.x, home.y)) return@forEvery
        val settings = PolygonRrtSettings(iterations = 30, margin = lake.margin, resolution = 1.5)
        val limit = random.between(10.0, 300.0)
        val trip = Trip(lake.map, home, TravelCost(1.0, 0.0), random)
        val planner = PolygonRrt(random, lake.area, settings)
        trip.run(
            BudgetedPlanner(planner, limit, trip.cost, {
                trip.spent
            }, WaterHome(routes, home), home),
        ) { from, plan ->
            assertClear(lake.area, lake.margin, from, plan)
        }
        assertTrue(trip.spent <= limit * (1 + 1e-9), "used ${trip.spent} of $limit")
        assertEquals(home, trip.at)
    }

    @Test
    fun usesTheBudgetUp() {
        val map = flatMap(10, 10)
        val trip = Trip(map, map.grid.center(0), TravelCost(0.0, 1.0), Random(1))
        val planner = Lawnmower(LawnmowerPattern.HAMILTONIAN_CYCLE)
        trip.run(BudgetedPlanner(planner, 60.0, trip.cost, { trip.spent }, CellsHome(map.grid, 0), trip.home))
        // On a grid every closed way has an even number of edge steps.
        assertEquals(60.0, trip.spent, 0.0)
    }

    @Test
    fun aReserveIsKeptBack() {
        val map = flatMap(40, 1)
        val trip = Trip(map, map.grid.center(0), TravelCost(1.0, 0.0), Random(1))
        val east = Planner { grid, from, _, _, plan ->
            plan.clear()
            plan.add(from.x + 1, from.y)
            if (grid.grid.cellAt(from) >= 0) PlanOutcome.Planned else PlanOutcome.OffMap
        }
        var farthest = 0.0
        trip.run(
            BudgetedPlanner(east, 30.0, trip.cost, { trip.spent }, StraightHome(trip.home), trip.home, reserve = 0.5),
        ) { from, _ -> farthest = maxOf(farthest, from.x - 0.5) }
        // Out by d and home by 1.5 d within 30: 12 m.
        assertEquals(12.0, farthest, 1e-9, "sums of whole numbers, but for the rounding allowed for")
    }

    @Test
    fun whereHomeIsOutOfReachFromTheStartItGoesThereAtOnce() {
        val map = flatMap(5, 5)
        val plan = Plan()
        val planner = BudgetedPlanner(
            RandomWalk(Random(1)),
            2.0,
            TravelCost(0.0, 1.0),
            { 0.0 },
            CellsHome(map.grid, 0),
            map.grid.center(0),
        )
        assertEquals(PlanOutcome.Planned, planner.plan(map, map.grid.center(24), 0.5, StopCondition.NEVER, plan))
        assertEquals(8, plan.size)
        assertEquals(map.grid.center(0), plan.waypoints().last())
    }

    @Test
    fun refusesNumbersOutOfRange() {
        assertFailsWith<IllegalArgumentException> { TravelCost(0.0, 0.0) }
        assertFailsWith<IllegalArgumentException> { TravelCost(-1.0, 0.0) }
        val home = Position(0.0, 0.0)
        assertFailsWith<IllegalArgumentException> {
            BudgetedPlanner(RandomWalk(Random(1)), Double.NaN, TravelCost(1.0, 0.0), { 0.0 }, StraightHome(home), home)
        }
        assertFailsWith<IllegalArgumentException> { CellsHome(Grid.unit(2, 2), 4) }
    }

    private companion object {
        const val MOST_TURNS = 10_000
    }
}
