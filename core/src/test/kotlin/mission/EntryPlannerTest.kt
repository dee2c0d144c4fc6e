package stillwater.mission

import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.Plan
import stillwater.model.Position
import stillwater.model.WaterArea
import stillwater.plan.ClosedCells
import stillwater.plan.DetourWays
import stillwater.plan.Lawnmower
import stillwater.plan.LawnmowerPattern
import stillwater.plan.PlanOutcome
import stillwater.plan.Planner
import stillwater.plan.StopCondition
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class EntryPlannerTest {
    /** Two arms of 20 m, 20 m of land between them, joined in the south; the map is in the eastern one. */
    private val water = WaterArea(
        listOf(0 to 0, 60 to 0, 60 to 60, 40 to 60, 40 to 20, 20 to 20, 20 to 60, 0 to 60)
            .map { (x, y) -> Position(x.toDouble(), y.toDouble()) },
    )
    private val map = FieldMap(Grid(Position(42.0, 42.0), 2, 2, 8.0), Interval.UNIT)
    private val home = Position(10.0, 55.0)
    private val closed = ClosedCells(map.grid)
    private val wayHome = DetourWays(water, 0.75, 4.0, isOpen = false, closed, home)
    private val entry: Planner =
        EntryPlanner(Lawnmower(LawnmowerPattern.HAMILTONIAN_CYCLE), water, wayHome, closed)

    private fun way(from: Position): List<Position> {
        val plan = Plan()
        assertEquals(PlanOutcome.Planned, entry.plan(map, from, 0.5, StopCondition.NEVER, plan))
        return plan.waypoints()
    }

    @Test
    fun theMapIsComeToRoundTheLand() {
        val legs = listOf(home) + way(home)
        assertTrue(legs.size > 2, "$legs")
        for ((from, to) in legs.zipWithNext()) {
            assertTrue(water.isClear(from.x, from.y, to.x, to.y, 0.0), "$from to $to")
        }
        assertTrue(map.grid.cellAt(legs.last()) != Grid.OUTSIDE)
        val plan = Plan()
        wayHome.fill(50.0, 50.0, plan)
        assertEquals(home, plan.waypoints().last(), "the way home is still known")
    }

    @Test
    fun aCellInSightIsGoneForStraight() {
        val from = Position(50.0, 10.0)
        val way = way(from)
        assertEquals(1, way.size)
        assertTrue(water.isClear(from.x, from.y, way[0].x, way[0].y, 0.0))
    }
}
