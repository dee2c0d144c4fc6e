package stillwater.mission

import stillwater.control.Danger
import stillwater.model.Position
import kotlin.math.cos
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** Water that the boat does not get into and that no chart has, from [west], [south] to [east], [north], m. */
private class Reef(val west: Double, val south: Double, val east: Double, val north: Double) {
    /** Pushes the boat of [desk] out by the nearest side. */
    fun keepOut(desk: Desk) {
        val boat = desk.boat.dynamics
        if (boat.x !in west..east || boat.y !in south..north) return
        val depths = listOf(boat.x - west, east - boat.x, boat.y - south, north - boat.y)
        val side = depths.indexOf(depths.min())
        val outX = listOf(-1.0, 1.0, 0.0, 0.0)[side]
        val outY = listOf(0.0, 0.0, -1.0, 1.0)[side]
        val inwards = -boat.surge * (cos(boat.heading) * outX + sin(boat.heading) * outY)
        boat.currentX += outX * (maxOf(0.0, inwards) + 0.2)
        boat.currentY += outY * (maxOf(0.0, inwards) + 0.2)
    }
}

/** The whole stack where the water is not as the mission has it. Seeds fixed before the first run. */
class ReefTest {
    private fun spec(planner: PlannerName, seconds: Double) = MissionSpec.fromJson(
        Desk.SMALL.replace("self-calibrating", "bounded-extended"),
    ).copy(planner = planner, budget = BudgetSpec(seconds = seconds))

    private fun desk(
        spec: MissionSpec,
        seed: Int,
        recovered: RecoveredMission? = null,
        current: (Position) -> Position = { Position(0.0, 0.0) },
        reefs: () -> List<Reef>,
    ): Desk {
        val desk = Desk(spec, seed, recovered = recovered)
        desk.meanwhile = {
            val boat = desk.boat.dynamics
            val flow = current(Position(boat.x, boat.y))
            boat.currentX = flow.x
            boat.currentY = flow.y
            reefs().forEach { it.keepOut(desk) }
        }
        desk.until(3.0) { false }
        desk.mission.start()
        return desk
    }

    private fun Desk.unseen(cells: Iterable<Int>) = cells.filter { mission.map.readings(it) == 0 }

    private fun Desk.distanceHome() = Position(boat.dynamics.x, boat.dynamics.y).distanceTo(spec.home.position)

    private fun assertCompletes(desk: Desk, seconds: Double, name: String) {
        val isOver = desk.until(seconds) { it is MissionState.Stopped }
        assertTrue(isOver, "$name: ${desk.mission.run { "$state, given up $givenUpCells, $givenUpOffMap" }}")
        assertEquals(MissionState.Stopped(StopReason.COMPLETED), desk.mission.state, name)
        assertTrue(desk.distanceHome() < 7.0, "$name: ${desk.distanceHome()} m from home")
    }

    /** A random walk need not come to all cells; polygon-rrt is done the soonest and takes the longest to compute. */
    @Test
    fun oneCellThatIsNotReachedCostsNoOtherWhateverPlans() {
        for (planner in PlannerName.entries) {
            val seconds = if (planner == PlannerName.POLYGON_RRT) 900.0 else 2400.0
            val desk = desk(spec(planner, seconds), 711) { listOf(Reef(20.0, 10.0, 30.0, 20.0)) }
            assertCompletes(desk, 2 * seconds, "$planner")
            val unseen = desk.unseen((0 until 36) - 8)
            val most = if (planner == PlannerName.RANDOM_WALK) 18 else 0
            assertTrue(unseen.size <= most, "$planner: $unseen not seen, given up ${desk.mission.givenUpCells}")
        }
    }

    /** A reef from shore to shore: all on this side of it is surveyed, what lies beyond is not tried for ever. */
    @Test
    fun aReefFromShoreToShoreLeavesTheRestToBeSurveyedWhateverPlans() {
        val planners = listOf(PlannerName.LAWNMOWER, PlannerName.INFORMATION, PlannerName.POLYGON_RRT)
        for (planner in planners) {
            // Each cell that is tried in vain takes a minute or two.
            val seconds = if (planner == PlannerName.POLYGON_RRT) 3600.0 else 4800.0
            val desk = desk(spec(planner, seconds), 712) { listOf(Reef(-40.0, 30.0, 100.0, 40.0)) }
            assertCompletes(desk, 6000.0, "$planner")
            val unseen = desk.unseen(0 until 18)
            assertEquals(emptyList(), unseen, "$planner, given up ${desk.mission.givenUpCells}")
            assertTrue(desk.mission.givenUpCells.count { it >= 18 } >= 4, "$planner: ${desk.mission.givenUpCells}")
        }
    }

    /** For ten minutes the current is faster than the boat there. */
    @Test
    fun whatACurrentKeptTheBoatFromIsSurveyedWhenItHasPassed() {
        for (planner in listOf(PlannerName.LAWNMOWER, PlannerName.BOUNDED_EXTENDED, PlannerName.POLYGON_RRT)) {
            var desk: Desk? = null
            val made = desk(
                spec(planner, if (planner == PlannerName.POLYGON_RRT) 1200.0 else 2400.0),
                713,
                current = { at ->
                    val runs = (desk?.boat?.time?.seconds ?: 0.0) < 600 && at.x > 40 && at.y > 40
                    if (runs) Position(-1.2, -1.2) else Position(0.0, 0.0)
                },
            ) { emptyList() }
            desk = made
            assertCompletes(made, 3000.0, "$planner")
            assertEquals(emptyList(), made.unseen(0 until 36), "$planner, given up ${made.mission.givenUpCells}")
        }
    }

    @Test
    fun afterARestartTheCellsThatWereGivenUpAreStillLeftOut() {
        val reef = listOf(Reef(-40.0, 30.0, 100.0, 40.0))
        val first = desk(spec(PlannerName.LAWNMOWER, 1800.0), 714) { reef }
        assertTrue(
            first.until(1500.0) { first.mission.givenUpCells.size >= 3 },
            "${first.mission.givenUpCells} of ${first.mission.givenUp}, ${first.mission.state}",
        )
        val found = first.replayed()
        assertEquals(GivenUp(first.mission.givenUpCells, first.mission.givenUpOffMap), found.givenUp)
        val second = desk(first.spec, 715, found) { reef }
        // Twice in a row, the second time before it has given up any more.
        val again = second.replayed()
        assertEquals(found.givenUp, again.givenUp)
        val third = desk(first.spec, 716, again) { reef }
        assertTrue(third.until(60.0) { it == MissionState.Surveying })
        // Ten minutes from the first step on, of which arming took some.
        repeat(530) {
            third.until(1.0) { false }
            val goals = third.mission.waypoints().map { third.mission.map.grid.cellAt(it) }
            assertTrue(goals.none { it in found.givenUp.cells }, "to $goals, given up ${found.givenUp}")
        }
    }

    /** A lock that shuts behind the boat, and is opened half an hour later. */
    @Test
    fun aBoatWhoseWayHomeIsShutTriesOthersRestsItsMotorsAndTriesAgain() {
        var isShut = false
        val wall = Reef(-40.0, 20.0, 100.0, 26.0)
        val desk = desk(spec(PlannerName.LAWNMOWER, 400.0), 717) { if (isShut) listOf(wall) else emptyList() }
        assertTrue(desk.until(300.0) { desk.boat.dynamics.y > 40 })
        isShut = true
        assertTrue(desk.until(600.0) { it == MissionState.Returning(Danger.BUDGET_SPENT) }, "${desk.mission.state}")
        // It goes along the whole wall first.
        assertTrue(desk.until(5000.0) { it == MissionState.Holding(Danger.HELD_UP) }, "${desk.mission.state}")
        assertTrue(desk.until(5.0) { desk.boat.board.actuation.isAtRest }, "motors run")
        isShut = false
        assertCompletes(desk, 1000.0, "when the lock is open")
    }

    /** The way straight home is shut, but not the one round. */
    @Test
    fun aBoatWhoseWayHomeIsBlockedFindsAnother() {
        var isShut = false
        val wall = Reef(-40.0, 20.0, 35.0, 26.0)
        val desk = desk(spec(PlannerName.LAWNMOWER, 500.0), 718) { if (isShut) listOf(wall) else emptyList() }
        assertTrue(desk.until(300.0) { desk.boat.dynamics.y > 40 })
        isShut = true
        assertCompletes(desk, 1500.0, "round the wall")
    }

    /** Eight columns of cells lie in the way, two cells deep; each takes a minute to learn of. */
    @Test
    fun aBoatFindsTheWayRoundALongWall() {
        var isShut = false
        val wall = Reef(-40.0, 20.0, 66.0, 26.0)
        val desk = desk(spec(PlannerName.LAWNMOWER, 400.0), 719) { if (isShut) listOf(wall) else emptyList() }
        assertTrue(desk.until(300.0) { desk.boat.dynamics.y > 40 }, "${desk.mission.position}")
        isShut = true
        assertFalse(desk.until(300.0) { it is MissionState.Stopped }, "${desk.mission.state}")
        assertCompletes(desk, 4000.0, "round the wall")
        assertFalse(desk.lines.any { "held_up" in it }, "without a rest")
        val (cells, offMap) = desk.mission.run { givenUpCells to givenUpOffMap }
        assertTrue(cells.size + offMap.size > 10, "$cells, $offMap")
        // West of 0 m there is no map.
        assertTrue(offMap.any { it.x < 0 }, "$offMap")
        assertEquals(GivenUp(cells, offMap), desk.replayed().givenUp)
    }
}
