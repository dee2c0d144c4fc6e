package stillwater.plan

import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.Plan
import stillwater.model.Position
import stillwater.model.WaterArea
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertNotEquals
import kotlin.test.assertTrue

class DetourPlannerTest {
    private val grid = Grid(Position(0.0, 0.0), 6, 5, 4.0)

    /** No water about the map: what is cut off on it is cut off. */
    private val water = WaterArea(
        listOf(Position(0.0, 0.0), Position(24.0, 0.0), Position(24.0, 20.0), Position(0.0, 20.0)),
    )
    private val home = grid.center(0)

    private fun closed(cells: Collection<Int>) =
        ClosedCells(grid, water, 0.5).apply { cells.forEach { close(number(it), 0.0) } }

    private fun ClosedCells.number(cell: Int) = at(grid.centerX(cell), grid.centerY(cell))

    private fun ways(closed: ClosedCells) = DetourWays(water, 0.0, 2.0, isOpen = true, closed, home)

    /** The cells come to by a boat that goes where [planner] says, [times] times, and whose legs avoid [closed]. */
    private fun comeTo(planner: Planner, closed: ClosedCells, times: Int): Set<Int> {
        val map = FieldMap(grid, Interval.UNIT)
        val plan = Plan()
        var at = home
        val seen = mutableSetOf(0)
        repeat(times) {
            if (planner.plan(map, at, 0.5, StopCondition.NEVER, plan) != PlanOutcome.Planned) return seen
            for (to in plan.waypoints()) {
                assertFalse(closed.blocks(at.x, at.y, to.x, to.y), "$at to $to")
                at = to
                val cell = grid.cellAt(at)
                assertFalse(closed.isClosed(closed.number(cell)), "in $cell")
                map.countVisit(cell)
                // Told by visits: the settling lawnmower stays until bounds close.
                map.setBounds(cell, 0.4, 0.401)
                seen += cell
            }
        }
        return seen
    }

    @Test
    fun everyOrderOfALawnmowerComesToAllThatCanBeReached() {
        val reefs = mapOf(
            setOf(8) to (0 until 30).toSet() - 8,
            // From side to side but for one cell, and wholly.
            (12..16).toSet() to (0 until 30).toSet() - (12..16).toSet(),
            setOf(12, 13, 14, 15, 16, 17) to (0 until 12).toSet(),
            setOf(22, 28) to (0 until 30).toSet() - setOf(22, 28),
        )
        for ((reef, reachable) in reefs) {
            for (pattern in LawnmowerPattern.entries) {
                for (planner in listOf(Lawnmower(pattern), SettlingLawnmower(pattern))) {
                    val closed = closed(reef)
                    val seen = comeTo(DetourPlanner(planner, closed, ways(closed)), closed, 300)
                    assertEquals(reachable, seen, "$pattern round $reef")
                }
            }
        }
    }

    @Test
    fun aRandomWalkStaysOutOfWhatIsClosedAndGoesOn() {
        val closed = closed(setOf(1, 7, 13))
        val seen = comeTo(DetourPlanner(RandomWalk(Random(721)), closed, ways(closed)), closed, 600)
        assertTrue(seen.size > 15, "$seen")
    }

    @Test
    fun whatWasClosedOnceIsTriedOnceMoreWhenNothingElseIsLeft() {
        val closed = closed(setOf(29))
        val asked = ArrayList<Boolean>()
        val planner = Planner { map, _, _, _, plan ->
            plan.clear()
            val isOpen = map.upper(29) > map.lower(29)
            asked += isOpen
            if (isOpen) plan.add(grid.centerX(29), grid.centerY(29))
            if (isOpen) PlanOutcome.Planned else PlanOutcome.NothingToGain
        }
        val detour = DetourPlanner(planner, closed, ways(closed))
        val map = FieldMap(grid, Interval.UNIT)
        val plan = Plan()
        assertEquals(PlanOutcome.Planned, detour.plan(map, home, 0.5, StopCondition.NEVER, plan))
        assertEquals(listOf(false, true), asked)
        closed.close(closed.number(29), 100.0)
        assertEquals(PlanOutcome.NothingToGain, detour.plan(map, home, 0.5, StopCondition.NEVER, plan))
        assertEquals(listOf(29), closed.mapCells(), "it is still said which were given up")
    }

    @Test
    fun aClosedCellOpensAfterAWhileAndAllOthersWaitWhereItIsNotGotInto() {
        val closed = closed(setOf(3, 4))
        closed.expire(599.0)
        assertEquals(2, closed.count)
        closed.expire(600.0)
        assertEquals(0, closed.count)
        closed.close(closed.number(3), 700.0)
        assertEquals(2, closed.count, "the other waits, too")
        closed.expire(1899.0)
        assertEquals(2, closed.count)
        closed.reached(closed.number(3))
        assertEquals(0, closed.count)
        assertEquals(listOf(4), closed.mapCells())
    }

    @Test
    fun whatIsPreparedInPartsIsThereForThePlan() {
        val closed = closed(emptySet())
        val ways = ways(closed)
        val detour = DetourPlanner(Lawnmower(LawnmowerPattern.HAMILTONIAN_CYCLE), closed, ways)
        assertTrue(detour.prepare(grid, home, 1), "nothing is closed")
        closed.close(closed.number(8), 0.0)
        var parts = 1
        while (!detour.prepare(grid, home, 10)) parts++
        // Twice 12 by 10 points.
        assertTrue(parts in 23..25, "$parts parts")
        val plan = Plan()
        detour.plan(FieldMap(grid, Interval.UNIT), home, 0.5, StopCondition.NEVER, plan)
        assertTrue(plan.size > 0)
        assertTrue(detour.prepare(grid, Position(home.x + 0.1, home.y), 1), "the same cell")
        assertFalse(detour.prepare(grid, grid.center(1), 1))
        assertTrue(ways.prepareHome(14.0, 8.0, 1), "nothing has changed")
        closed.close(closed.number(9), 0.0)
        assertTrue(ways.prepareHome(2.0, 18.0, 1), "straight")
        parts = 1
        while (!ways.prepareHome(14.0, 8.0, 10)) parts++
        assertTrue(parts in 12..13, "$parts parts")
    }

    @Test
    fun theWayHomeLeadsRoundWhatWasEverClosedAndThroughItWhereThereIsNoOther() {
        val closed = closed(setOf(6, 7, 8, 9, 10))
        val ways = ways(closed)
        closed.expire(1e6)
        val plan = Plan()
        ways.fill(2.0, 14.0, plan)
        assertNotEquals(listOf(home), plan.waypoints())
        assertEquals(home, plan.waypoints().last())
        closed.close(closed.number(11), 0.0)
        ways.fill(2.0, 14.0, plan)
        assertEquals(listOf(home), plan.waypoints())
    }
}
