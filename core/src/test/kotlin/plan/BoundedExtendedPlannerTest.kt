package stillwater.plan

import org.junit.jupiter.api.Test
import org.junit.jupiter.api.assertThrows
import stillwater.field.FieldMap
import stillwater.model.Plan
import stillwater.property.drawn
import stillwater.property.forEvery
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class BoundedExtendedPlannerTest {
    private val plan = Plan()

    /** Runs plans for [moves] moves from [start] on a map on which nothing is ever learned; visits are counted. */
    private fun run(planner: BoundedExtendedPlanner, map: FieldMap, start: Int, moves: Int): List<Int> {
        val visited = ArrayList<Int>()
        var at = start
        while (visited.size < moves) {
            assertEquals(
                PlanOutcome.Planned,
                planner.plan(map, map.grid.center(at), 0.5, StopCondition.NEVER, plan),
            )
            for (cell in cells(plan, map.grid)) {
                map.countVisit(cell)
                visited += cell
                at = cell
            }
        }
        return visited
    }

    private class Water(random: Random) {
        val map = randomMap(random, random.nextInt(1, 7), random.nextInt(2, 7))
        val start = random.nextInt(map.grid.size)
        val seed = random.nextInt()

        override fun toString() = "${map.grid}, start $start, seed $seed"
    }

    @Test
    fun visitsEveryCellAgainAndAgainThoughNoVisitTeachesAnything() {
        forEvery(drawn(::Water), cases = 60) { water ->
            val planner = BoundedExtendedPlanner(Random(water.seed), BoundedExtendedPlannerSettings(6, 60))
            val moves = 60 * water.map.grid.size
            run(planner, water.map, water.start, moves)
            // A sixteenth of the mean of 60, but for the cells passed on the way and the plan that was being run.
            for (cell in 0 until water.map.grid.size) assertTrue(water.map.visits(cell) >= 60 / 16 - 1, "cell $cell")
        }
    }

    @Test
    fun whereNothingHasAnyWidthItGoesToTheCellVisitedLeast() {
        val map = flatMap(5, 1)
        for (cell in 0 until 5) {
            map.setBounds(cell, 0.5, 0.5)
            map.setValue(cell, 0.5)
            repeat(if (cell == 4) 1 else 3) { map.countVisit(cell) }
        }
        val planner = BoundedExtendedPlanner(Random(1))
        planner.plan(map, map.grid.center(0), 0.5, StopCondition.NEVER, plan)
        assertEquals(listOf(1, 2, 3, 4), cells(plan, map.grid))
    }

    @Test
    fun aWideCellBeyondTheHorizonIsAGoal() {
        val map = flatMap(12, 1)
        for (cell in 0 until 11) {
            map.setBounds(cell, 0.4999, 0.5001)
            map.countVisit(cell)
        }
        val planner = BoundedExtendedPlanner(Random(1), BoundedExtendedPlannerSettings(horizon = 3, expansions = 50))
        planner.plan(map, map.grid.center(0), 0.5, StopCondition.NEVER, plan)
        assertEquals((1..11).toList(), cells(plan, map.grid))
    }

    @Test
    fun aVisitThatTeachesNothingMakesTheCellWorthLessFromThatSideOnly() {
        val map = flatMap(2, 1)
        map.setBounds(1, 0.2, 1.0)
        map.setValue(1, 0.6)
        repeat(50) { map.countVisit(1) }
        val memory = ProgressMemory(2)
        val fromBelow = memory.worth(map, 1, 0.3)
        val fromAbove = memory.worth(map, 1, 0.9)
        memory.expect(map, 1, 0.3)
        map.countVisit(1)
        memory.learn(map, 1, 0.31)
        assertTrue(memory.worth(map, 1, 0.3) <= 0.51 * fromBelow, "half is forgotten at each visit")
        assertEquals(fromAbove, memory.worth(map, 1, 0.9), 1e-12, "rounding")
    }

    @Test
    fun theShareOfTheWayIsLearnedFromCellsWhoseValueIsKnown() {
        val map = flatMap(2, 1)
        map.setBounds(1, 0.59, 0.61)
        map.setValue(1, 0.6)
        val memory = ProgressMemory(2)
        repeat(200) {
            memory.expect(map, 1, 0.1)
            memory.learn(map, 1, 0.2)
        }
        // 0.1 of 0.5; the first belief of a half weighs as four of 204.
        assertEquals(0.2, memory.share, 0.01)
    }

    @Test
    fun settingsSayWhatIsWrongWithThem() {
        assertThrows<IllegalArgumentException> { BoundedExtendedPlannerSettings(horizon = 0) }
        assertThrows<IllegalArgumentException> { BoundedExtendedPlannerSettings(expansions = 0) }
    }
}
