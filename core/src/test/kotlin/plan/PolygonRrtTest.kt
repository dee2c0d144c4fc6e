package stillwater.plan

import org.junit.jupiter.api.Test
import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.Plan
import stillwater.model.Position
import stillwater.model.WaterArea
import stillwater.property.drawn
import stillwater.property.forEvery
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class PolygonRrtTest {
    private val plan = Plan()

    private fun PolygonRrt.plan(map: FieldMap, from: Position, stop: StopCondition = StopCondition.NEVER) =
        plan(map, from, 0.5, stop, plan)

    @Test
    fun noLegEverCrossesLandNorComesNearerThanTheMargin() = forEvery(drawn(::Lake), cases = 120) { lake ->
        val random = Random(lake.seed)
        val settings = PolygonRrtSettings(iterations = 60, margin = lake.margin, resolution = 1.5)
        val planner = PolygonRrt(Random(lake.seed), lake.area, settings)
        repeat(4) {
            val from = lake.place(random) ?: return@forEvery
            val outcome = planner.plan(lake.map, from)
            assertEquals(outcome == PlanOutcome.Planned, plan.size > 0, "$outcome")
            assertClear(lake.area, lake.margin, from, plan)
            for ((a, b) in planner.tree()) assertTrue(lake.area.isClear(a.x, a.y, b.x, b.y, lake.margin), "$a to $b")
        }
    }

    @Test
    fun saysWhenTheBoatIsOnLandOrOffTheMap() {
        val area = WaterArea(rectangle(0.0, 0.0, 20.0, 20.0), listOf(rectangle(8.0, 8.0, 12.0, 12.0)))
        val map = FieldMap(Grid(Position(0.0, 0.0), 10, 10, 2.0), Interval.UNIT)
        val planner = PolygonRrt(Random(1), area)
        assertEquals(PlanOutcome.OffWater, planner.plan(map, Position(10.0, 10.0)))
        assertEquals(PlanOutcome.OffMap, planner.plan(map, Position(-1.0, 10.0)))
        assertEquals(PlanOutcome.OffMap, planner.plan(map, Position(Double.NaN, 10.0)))
        assertEquals(0, plan.size)
    }

    @Test
    fun aBoatWithinTheMarginLeavesItOverWater() {
        val area = WaterArea(rectangle(0.0, 0.0, 20.0, 20.0))
        val map = FieldMap(Grid(Position(0.0, 0.0), 10, 10, 2.0), Interval.UNIT)
        val planner = PolygonRrt(Random(1), area, PolygonRrtSettings(margin = 3.0))
        val from = Position(1.0, 10.0)
        assertEquals(PlanOutcome.Planned, planner.plan(map, from))
        assertTrue(area.isClear(from.x, from.y, plan.x(0), plan.y(0), 0.0))
        val rest = Plan()
        for (i in 1 until plan.size) rest.add(plan.x(i), plan.y(i))
        assertClear(area, 3.0, Position(plan.x(0), plan.y(0)), rest)
    }

    @Test
    fun whatIsLeftBehindANarrowPassageIsGoneTo() {
        val area = twoBasins(width = 4.0)
        val grid = Grid(Position(0.0, 0.0), 15, 5, 4.0)
        val map = FieldMap(grid, Interval.UNIT)
        // All is known but one cell in the far corner of the other basin, 50 m away; paths are 32 m long at most.
        for (cell in 0 until grid.size) map.setBounds(cell, 0.5, 0.5)
        val goal = grid.cellAt(58.0, 2.0)
        map.setBounds(goal, 0.0, 1.0)
        val settings = PolygonRrtSettings(margin = 0.5, resolution = 1.0)
        val from = Position(3.0, 17.0)
        assertEquals(PlanOutcome.Planned, PolygonRrt(Random(5), area, settings).plan(map, from))
        assertClear(area, settings.margin, from, plan)
        assertEquals(goal, grid.cellAt(plan.x(plan.size - 1), plan.y(plan.size - 1)))
    }

    @Test
    fun nothingIsPlannedWhereAllIsKnown() {
        val map = flatMap(6, 6, 0.5, 0.5)
        assertEquals(PlanOutcome.NothingToGain, PolygonRrt(Random(1)).plan(map, Position(3.0, 3.0)))
    }

    @Test
    fun makesDoWithWhatItHasWhenStopped() {
        val map = flatMap(6, 6)
        val planner = PolygonRrt(Random(1))
        assertEquals(PlanOutcome.Stopped, planner.plan(map, Position(3.0, 3.0)) { true })
        var asked = 0
        assertEquals(PlanOutcome.Planned, planner.plan(map, Position(3.0, 3.0)) { asked++ == 40 })
        assertEquals(41, asked)
    }

    @Test
    fun moreIterationsGainMoreForTheLength() {
        // The mean over 20 seeds of the tree's best score grows with the iterations: it is a maximum over more paths.
        val map = randomMap(Random(3), 12, 12)
        val few = scores(map, iterations = 20)
        val many = scores(map, iterations = 400)
        assertTrue(many > 1.1 * few, "$many against $few")
    }

    private fun scores(map: FieldMap, iterations: Int) = (1..20).sumOf { seed ->
        val settings = PolygonRrtSettings(iterations = iterations)
        val tree = PathTree(map.grid, 1.0, area = null, settings)
        val random = Random(seed)
        tree.start(6.0, 6.0)
        repeat(iterations) { tree.grow(map, 12 * random.nextDouble(), 12 * random.nextDouble()) }
        tree.bestScore
    }

    @Test
    fun theGainOfAStraightPathIsTheStatedOne() {
        // One cell of width 1 between known ones, passed from border to border: 1 · (1 − exp(−1 / 0.5)).
        val map = flatMap(3, 1, 0.5, 0.5)
        map.setBounds(1, 0.0, 1.0)
        val tree = PathTree(map.grid, 1.0, area = null, PolygonRrtSettings(reach = 2.0))
        tree.start(0.5, 0.5)
        tree.grow(map, 2.5, 0.5)
        // A leg of two cells in eight slices, four of them in the middle cell; score over 2 m and one cell.
        assertEquals((1 - kotlin.math.exp(-2.0)) / 3, tree.bestScore, 1e-15, "rounding")
    }
}
