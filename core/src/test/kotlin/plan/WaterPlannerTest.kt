package stillwater.plan

import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.Plan
import stillwater.model.Position
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class WaterPlannerTest {
    private fun sail(lake: Lake, planner: WaterPlanner, start: Position, plans: Int): List<Position> {
        val plan = Plan()
        val places = arrayListOf(start)
        repeat(plans) {
            val outcome = planner.plan(lake.map, places.last(), 0.5, StopCondition.NEVER, plan)
            if (outcome != PlanOutcome.Planned) return places
            for (i in 0 until plan.size) places += Position(plan.x(i), plan.y(i))
            val cell = lake.grid.cellAt(places.last())
            // What was visited is known, so that planners with a map go on.
            lake.map.setBounds(cell, 0.4, 0.4)
            lake.map.countVisit(cell)
        }
        return places
    }

    @Test
    fun noLegLeavesTheWaterWhateverThePlanner() {
        val random = Random(7411)
        repeat(25) {
            val lake = Lake(random)
            val start = lake.place(random) ?: return@repeat
            for (planner in listOf(
                RandomWalk(random),
                RandomWalk(random, WalkSteps.DIAGONAL_CLAMPED),
                Lawnmower(LawnmowerPattern.FOUR_DIRECTIONS),
                BoundedPlanner(random),
                BoundedExtendedPlanner(random),
            )) {
                val routes = WaterRoutes(lake.area, lake.margin, 1.5)
                val places = sail(lake, WaterPlanner(planner, routes), start, 60)
                // Legs into the first place may come from nearer to land than the margin, and do not here.
                for ((from, to) in places.zipWithNext()) {
                    assertTrue(
                        lake.area.isClear(from.x, from.y, to.x, to.y, lake.margin),
                        "${planner::class.simpleName} from $from to $to of $lake",
                    )
                }
            }
        }
    }

    @Test
    fun aLawnmowerComesToEveryCellOfBothBasins() {
        val area = twoBasins(6.0)
        val grid = Grid(Position(0.0, 0.0), 15, 5, 4.0)
        val map = FieldMap(grid, Interval.UNIT)
        val routes = WaterRoutes(area, 0.5, 1.0)
        val planner = WaterPlanner(Lawnmower(LawnmowerPattern.BACK_AND_FORTH), routes)
        val plan = Plan()
        var place = Position(2.0, 2.0)
        val seen = HashSet<Int>()
        repeat(2 * grid.size) {
            assertEquals(PlanOutcome.Planned, planner.plan(map, place, 0.5, StopCondition.NEVER, plan))
            place = Position(plan.x(plan.size - 1), plan.y(plan.size - 1))
            seen += grid.cellAt(place)
        }
        val water = (0 until grid.size).filter { area.isClear(grid.centerX(it), grid.centerY(it), 0.5) }.toSet()
        assertEquals(water, seen)
        assertTrue(water.size < grid.size, "some cells are land")
    }

    @Test
    fun aBoatOffTheMapAndAMapOfLandGiveNoPlan() {
        val area = twoBasins(6.0)
        val routes = WaterRoutes(area, 0.5, 1.0)
        val plan = Plan()
        val far = FieldMap(Grid(Position(0.0, 0.0), 5, 5, 4.0), Interval.UNIT)
        val outcome = WaterPlanner(Lawnmower(LawnmowerPattern.RASTER), routes)
            .plan(far, Position(-9.0, 2.0), 0.5, StopCondition.NEVER, plan)
        assertEquals(PlanOutcome.OffMap, outcome)
        // Cells of the land between the basins alone.
        val land = FieldMap(Grid(Position(22.0, 0.0), 4, 1, 4.0), Interval.UNIT)
        val nothing = WaterPlanner(Lawnmower(LawnmowerPattern.RASTER), routes)
            .plan(land, Position(24.0, 2.0), 0.5, StopCondition.NEVER, plan)
        assertEquals(PlanOutcome.NothingToGain, nothing)
        assertEquals(0, plan.size)
    }
}
