package stillwater.plan

import org.junit.jupiter.api.Test
import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.Plan
import stillwater.model.Position
import stillwater.property.drawn
import stillwater.property.forEvery
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertNotEquals
import kotlin.test.assertTrue

class BoundedPlannerTest {
    private val plan = Plan()
    private val oneMove = BoundedPlannerSettings(horizon = 1, expansions = 1)

    private fun BoundedPlanner.run(
        map: FieldMap,
        cell: Int,
        sensor: Double,
        stop: StopCondition = StopCondition.NEVER,
    ): PlanOutcome {
        plan.clear()
        plan.add(9.0, 9.0)
        return plan(map, map.grid.center(cell), sensor, stop, plan)
    }

    /**
     * The report's section 6 and Figure 5: the robot is in cell₁₂, its reading is drawn through the bounds of the
     * other cells, and it "will move to a neighboring cell that will give the maximum bounds contraction, in other
     * words the cell where the predicted value will be closest to the midpoints of the bounds of that cell", cell₂₂.
     *
     * Rows are numbered from the top there and from the origin here. The bounds' widths are equal (0.4), the reading
     * is 0.5: |mid − s| is 0.25 in cell₁₁ and 0.05 in cell₂₂. Cell₂₁, which the figure does not show, is known.
     */
    @Test
    fun theWorkedExampleOfSection6() {
        val map = flatMap(columns = 2, rows = 2)
        val cell11 = 0
        val cell12 = 1
        val cell21 = 2
        val cell22 = 3
        map.setBounds(cell11, 0.55, 0.95)
        map.setBounds(cell12, 0.30, 0.70)
        map.setBounds(cell21, 0.10, 0.10)
        map.setBounds(cell22, 0.35, 0.75)
        for (seed in 1..20) {
            val planner = BoundedPlanner(Random(seed), oneMove)
            assertEquals(PlanOutcome.Planned, planner.run(map, cell12, sensor = 0.5))
            assertEquals(listOf(cell22), cells(plan, map.grid), "seed $seed")
        }
        // Were the reading near the midpoint of cell₁₁ instead, that would be the one.
        val planner = BoundedPlanner(Random(1), oneMove)
        planner.run(map, cell12, sensor = 0.8)
        assertEquals(listOf(cell11), cells(plan, map.grid))
    }

    /** A cell is worth a ninth at the ninth visit: the planner's bits count to seven, beyond that it looks at the path. */
    @Test
    fun moreVisitsThanBitsCountAreCounted() {
        val map = flatMap(columns = 3, rows = 1)
        val wide = 0
        val middle = 1
        val narrow = 2
        map.setBounds(wide, 0.05, 0.95)
        map.setBounds(middle, 0.5, 0.5)
        // 0.106 wide: less than the wide cell's eighth visit gives, 0.9 / 8, and more than its ninth, 0.9 / 9.
        map.setBounds(narrow, 0.447, 0.553)
        // From the middle nine moves lead to either side, the last back to nothing; all paths are looked at.
        val planner = BoundedPlanner(Random(1), BoundedPlannerSettings(horizon = 18, expansions = 10_000))
        planner.run(map, middle, sensor = 0.5)
        assertEquals(mapOf(wide to 8, middle to 8, narrow to 1), cells(plan, map.grid).groupingBy { it }.eachCount())
    }

    @Test
    fun looksBeyondTheNextCell() {
        // Cells 0 1 2 3 in a row, the boat in 1: 0 promises .3, 2 promises .2 but leads to 3, which promises .9.
        val map = flatMap(4, 1)
        map.setBounds(0, 0.35, 0.65)
        map.setBounds(1, 0.5, 0.5)
        map.setBounds(2, 0.4, 0.6)
        map.setBounds(3, 0.05, 0.95)
        BoundedPlanner(Random(1), oneMove).run(map, 1, sensor = 0.5)
        assertEquals(listOf(0), cells(plan, map.grid))
        BoundedPlanner(Random(1), BoundedPlannerSettings(horizon = 2, expansions = 50)).run(map, 1, sensor = 0.5)
        assertEquals(listOf(2, 3), cells(plan, map.grid))
    }

    @Test
    fun singleStepIsTheFirstMoveOfTheWholePath() {
        forEvery(drawn { it.nextLong() }, cases = 100) { seed ->
            val map = randomMap(Random(seed), 4, 4)
            val whole = BoundedPlanner(Random(seed), BoundedPlannerSettings(horizon = 6))
            val single = BoundedPlanner(
                Random(seed),
                BoundedPlannerSettings(horizon = 6, execution = Execution.SINGLE_STEP),
            )
            val outcome = whole.run(map, 5, sensor = 0.4)
            val path = cells(plan, map.grid)
            assertEquals(outcome, single.run(map, 5, sensor = 0.4))
            assertEquals(path.take(1), cells(plan, map.grid))
        }
    }

    @Test
    fun alwaysStoppedItHasNoPlan() {
        for (choice in PathChoice.entries) {
            val planner = BoundedPlanner(Random(1), BoundedPlannerSettings(choice = choice))
            assertEquals(PlanOutcome.Stopped, planner.run(flatMap(4, 4), 5, 0.5) { true })
            assertEquals(0, plan.size)
        }
    }

    @Test
    fun stoppedLaterItMakesDoWithTheBestSoFar() {
        for (asks in 1..6) {
            var asked = 0
            val planner = BoundedPlanner(Random(1), BoundedPlannerSettings(horizon = 10, expansions = 200))
            assertEquals(PlanOutcome.Planned, planner.run(flatMap(4, 4), 5, 0.5) { ++asked > asks })
            assertEquals(asks + 1, asked)
            // Each expansion makes paths longer by one move at most.
            assertTrue(plan.size in 1..asks, "${plan.size} moves after $asks expansions")
        }
    }

    @Test
    fun stoppedBeforeAnyPathHadValueIsNotNothingToGain() {
        // Only the far end of a row promises anything.
        val map = flatMap(8, 1, lower = 0.5, upper = 0.5)
        map.setBounds(7, 0.0, 1.0)
        var asked = 0
        val planner = BoundedPlanner(Random(1))
        assertEquals(PlanOutcome.Stopped, planner.run(map, 0, 0.5) { ++asked > 2 })
        assertEquals(0, plan.size)
        assertEquals(PlanOutcome.Planned, planner.run(map, 0, 0.5))
        assertEquals((1..7).toList(), cells(plan, map.grid).take(7))
    }

    @Test
    fun asksBeforeEveryExpansion() {
        var asked = 0
        val planner = BoundedPlanner(Random(1), BoundedPlannerSettings(horizon = 20, expansions = 37))
        planner.run(flatMap(5, 5), 12, 0.5) {
            asked++
            false
        }
        assertEquals(37, asked)
    }

    @Test
    fun aKnownMapHasNothingToGain() {
        for (choice in PathChoice.entries) {
            val planner = BoundedPlanner(Random(1), BoundedPlannerSettings(choice = choice))
            assertEquals(PlanOutcome.NothingToGain, planner.run(flatMap(4, 4, lower = 0.3, upper = 0.3), 5, 0.3))
            assertEquals(0, plan.size)
            val crossed = flatMap(4, 4)
            for (cell in 0 until 16) crossed.setBounds(cell, 0.6, 0.4)
            assertEquals(PlanOutcome.NothingToGain, planner.run(crossed, 5, 0.5))
            assertEquals(PlanOutcome.NothingToGain, planner.run(flatMap(1, 1), 0, 0.5))
            // A sensor far off any midpoint learns nothing: the original's clip at zero.
            assertEquals(PlanOutcome.NothingToGain, planner.run(flatMap(4, 4), 5, sensor = 100.0))
        }
    }

    @Test
    fun saysWhenTheBoatIsOffTheMap() {
        for (from in listOf(Position(-0.1, 1.0), Position(4.0, 1.0), Position(Double.NaN, 1.0))) {
            plan.add(9.0, 9.0)
            val outcome = BoundedPlanner(Random(1)).plan(flatMap(4, 4), from, 0.5, StopCondition.NEVER, plan)
            assertEquals(PlanOutcome.OffMap, outcome)
            assertEquals(0, plan.size)
        }
    }

    @Test
    fun aSensorWithoutAValueCountsAsTheMidpointOfItsCell() {
        val map = randomMap(Random(3), 4, 4)
        map.setBounds(5, 0.2, 0.9)
        BoundedPlanner(Random(1)).run(map, 5, sensor = 0.55)
        val expected = cells(plan, map.grid)
        for (sensor in listOf(Double.NaN, Double.POSITIVE_INFINITY, Double.NEGATIVE_INFINITY)) {
            assertEquals(PlanOutcome.Planned, BoundedPlanner(Random(1)).run(map, 5, sensor))
            assertEquals(expected, cells(plan, map.grid))
        }
    }

    @Test
    fun pathsStayOnTheGridAndMoveByEdgeSteps() {
        forEvery(drawn(::Case), cases = 300) { case ->
            val outcome = BoundedPlanner(Random(case.seed), case.settings).run(case.map, case.start, case.sensor)
            val path = cells(plan, case.map.grid)
            assertEquals(outcome == PlanOutcome.Planned, path.isNotEmpty())
            for ((from, to) in (listOf(case.start) + path).zipWithNext()) {
                assertTrue(shareAnEdge(case.map.grid, from, to), "$from to $to")
            }
            assertTrue(path.size <= case.settings.horizon)
            assertTrue(case.settings.execution == Execution.WHOLE_PATH || path.size <= 1)
        }
    }

    @Test
    fun theSameSeedPlansTheSame() {
        // On a flat map every direction is as good, so that the seed decides.
        fun decisions(seed: Int): List<List<Int>> {
            val planner = BoundedPlanner(Random(seed), BoundedPlannerSettings(horizon = 4, expansions = 20))
            return List(10) {
                planner.run(flatMap(5, 5), 12, 0.5)
                cells(plan, flatMap(5, 5).grid)
            }
        }
        assertEquals(decisions(1), decisions(1))
        assertNotEquals(decisions(1), decisions(2))
        assertTrue(decisions(1).distinct().size > 1, "no choice is random")
    }

    @Test
    fun theLargestSettingsAreSettings() {
        // Arrays grow with the work done, not with the limits: stopped at once, these need next to nothing.
        for (expansions in listOf(1 shl 29, 1 shl 30, Int.MAX_VALUE)) {
            val planner = BoundedPlanner(Random(1), BoundedPlannerSettings(horizon = 8, expansions = expansions))
            assertEquals(PlanOutcome.Stopped, planner.run(flatMap(3, 3), 4, 0.5) { true })
        }
        val planner = BoundedPlanner(Random(1), BoundedPlannerSettings(horizon = Int.MAX_VALUE, expansions = 5))
        assertEquals(PlanOutcome.Planned, planner.run(flatMap(3, 3), 4, 0.5))
    }

    @Test
    fun impossibleSettingsAreRefusedByName() {
        for ((message, make) in listOf<Pair<String, () -> Unit>>(
            "horizon (0 moves) must be at least 1" to { BoundedPlannerSettings(horizon = 0) },
            "expansions (0) must be at least 1" to { BoundedPlannerSettings(expansions = 0) },
            "maxChange (0.0) must be above 0 and finite" to { BoundedPlannerSettings(maxChange = 0.0) },
            "maxChange (NaN) must be above 0 and finite" to { BoundedPlannerSettings(maxChange = Double.NaN) },
        )) {
            assertEquals(message, assertFailsWith<IllegalArgumentException> { make() }.message)
        }
    }

    private class Case(random: Random) {
        val seed = random.nextInt()
        val map = randomMap(random, random.nextInt(1, 7), random.nextInt(1, 7))
        val start = random.nextInt(map.grid.size)
        val sensor = random.nextDouble()
        val settings = BoundedPlannerSettings(
            horizon = random.nextInt(1, 15),
            expansions = random.nextInt(1, 300),
            maxChange = 0.01 + random.nextDouble(),
            discountVisits = random.nextBoolean(),
            execution = Execution.entries.random(random),
            choice = PathChoice.entries.random(random),
        )

        override fun toString() = "${map.grid.columns} x ${map.grid.rows} from $start, sensor $sensor, $seed, $settings"
    }

    /** The number is of commit c6c67ea, whose planner polled every child from its queue. */
    @Test
    fun manyPlansAreTheSameAsBeforeChildrenWereCounted() {
        val random = Random(20_261_122)
        val planner = BoundedPlanner(Random(7), BoundedPlannerSettings(expansions = 400))
        val plan = Plan()
        var sum = 0
        repeat(400) { round ->
            val map = FieldMap(Grid.unit(10, 10), Interval.UNIT)
            // Nearly as wide everywhere, so that many paths fall behind by more than two cells are wide.
            for (cell in 0 until map.grid.size) {
                val middle = random.nextDouble(0.3, 0.7)
                val half = random.nextDouble(0.1, 0.15 + 0.02 * (round % 10))
                map.setBounds(cell, middle - half, middle + half)
            }
            planner.plan(map, map.grid.center(random.nextInt(map.grid.size)), 0.5, StopCondition.NEVER, plan)
            for (i in 0 until plan.size) sum = 31 * sum + map.grid.cellAt(plan.x(i), plan.y(i))
        }
        assertEquals(1_627_823_989, sum)
    }
}
