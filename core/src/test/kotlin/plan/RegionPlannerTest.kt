package stillwater.plan

import org.junit.jupiter.api.Test
import stillwater.model.Plan
import stillwater.model.Position
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class RegionPlannerTest {
    private val map = randomMap(Random(1), 8, 8)
    private val region = GridRegion(column = 4, row = 2, columns = 3, rows = 5)
    private val plan = Plan()

    private fun RegionPlanner.plan(from: Position) = plan(map, from, 0.5, StopCondition.NEVER, plan)

    @Test
    fun aBoatOutsideGoesToTheNearestCellByEdgeStepsAndStaysIn() {
        val planner = RegionPlanner(RandomWalk(Random(2)))
        planner.region = region
        var cell = 0
        assertEquals(PlanOutcome.Planned, planner.plan(map.grid.center(cell)))
        for (next in cells(plan, map.grid)) {
            assertTrue(shareAnEdge(map.grid, cell, next))
            cell = next
        }
        assertEquals(2 * 8 + 4, cell, "the nearest corner")
        repeat(200) {
            planner.plan(map.grid.center(cell))
            cell = cells(plan, map.grid).last()
            assertTrue(region.contains(cell % 8, cell / 8), "cell $cell")
        }
    }

    @Test
    fun thePlannerSeesWhatIsBelievedInTheRegion() {
        map.countVisit(2 * 8 + 4)
        var seen = 0
        val planner = RegionPlanner(
            { own, _, _, _, _ ->
                assertEquals(15, own.grid.size)
                for (cell in 0 until own.grid.size) {
                    val whole = map.grid.cellAt(own.grid.center(cell))
                    assertEquals(map.lower(whole), own.lower(cell), 0.0)
                    assertEquals(map.upper(whole), own.upper(cell), 0.0)
                    assertEquals(map.value(whole), own.value(cell), 0.0)
                    assertEquals(map.visits(whole), own.visits(cell))
                    seen++
                }
                PlanOutcome.NothingToGain
            },
        )
        planner.region = region
        planner.plan(map.grid.center(2 * 8 + 4))
        assertEquals(15, seen)
    }

    @Test
    fun aPlannerInThePlaneGainsNothingElsewhere() {
        val planner = RegionPlanner(
            { own, _, _, _, _ ->
                for (cell in 0 until own.grid.size) {
                    val isIn = region.contains(cell % 8, cell / 8)
                    assertEquals(
                        if (isIn) map.upper(cell) - map.lower(cell) else 0.0,
                        own.upper(cell) - own.lower(cell),
                        0.0,
                    )
                }
                PlanOutcome.NothingToGain
            },
            inPlane = true,
        )
        planner.region = region
        assertEquals(PlanOutcome.NothingToGain, planner.plan(map.grid.center(0)))
    }

    @Test
    fun withoutARegionNothingChanges() {
        val walk = RandomWalk(Random(3))
        val planner = RegionPlanner(RandomWalk(Random(3)))
        val other = Plan()
        var cell = 0
        repeat(50) {
            walk.plan(map, map.grid.center(cell), 0.5, StopCondition.NEVER, other)
            planner.plan(map.grid.center(cell))
            assertEquals(other.waypoints(), plan.waypoints())
            cell = cells(plan, map.grid).last()
        }
    }

    @Test
    fun saysWhenTheBoatIsOffTheMap() {
        val planner = RegionPlanner(RandomWalk(Random(1)))
        planner.region = region
        assertEquals(PlanOutcome.OffMap, planner.plan(Position(-1.0, 0.0)))
        assertEquals(0, plan.size)
    }
}
