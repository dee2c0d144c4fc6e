package stillwater.plan

import org.junit.jupiter.api.Test
import stillwater.model.Plan
import stillwater.model.Position
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertNotEquals
import kotlin.test.assertTrue

class RandomWalkTest {
    private val plan = Plan()

    private fun Planner.next(columns: Int, rows: Int, cell: Int): Int {
        val map = flatMap(columns, rows)
        assertEquals(PlanOutcome.Planned, plan(map, map.grid.center(cell), 0.5, StopCondition.NEVER, plan))
        return cells(plan, map.grid).single()
    }

    private fun targets(steps: WalkSteps, columns: Int, rows: Int, cell: Int): Map<Int, Int> {
        val walk = RandomWalk(Random(SEED), steps)
        return List(DRAWS) { walk.next(columns, rows, cell) }.groupingBy { it }.eachCount()
    }

    /** χ² = Σ (seen − expected)² / expected, against its 99.9 % point; the seed is fixed, so the answer is too. */
    private fun assertDrawnLike(shares: Map<Int, Double>, seen: Map<Int, Int>) {
        assertEquals(shares.keys, seen.keys)
        val chiSquare = shares.entries.sumOf { (cell, share) ->
            val expected = share * DRAWS
            (seen.getValue(cell) - expected) * (seen.getValue(cell) - expected) / expected
        }
        val limit = listOf(0.0, 10.83, 13.82, 16.27)[shares.size - 1]
        assertTrue(chiSquare <= limit, "chi-square $chiSquare above $limit, seed $SEED: $seen")
    }

    @Test
    fun everyNeighbourIsAsLikely() {
        // 3 x 3: the middle, the four edges, the four corners.
        val map = flatMap(3, 3)
        for (cell in 0 until 9) {
            val neighbours = neighbours(map.grid, cell)
            assertDrawnLike(neighbours.associateWith { 1.0 / neighbours.size }, targets(WalkSteps.EDGE, 3, 3, cell))
        }
    }

    @Test
    fun walksAlongASingleRowOrColumn() {
        for ((columns, rows) in listOf(4 to 1, 1 to 4)) {
            for ((cell, shares) in listOf(
                0 to mapOf(1 to 1.0),
                1 to mapOf(0 to 0.5, 2 to 0.5),
                2 to mapOf(1 to 0.5, 3 to 0.5),
                3 to mapOf(2 to 1.0),
            )) {
                assertDrawnLike(shares, targets(WalkSteps.EDGE, columns, rows, cell))
            }
        }
    }

    @Test
    fun theOriginalStepsDiagonallyAndIsClampedAtTheBorder() {
        // Cells of 3 x 3 are numbered from the corner: 0 1 2 / 3 4 5 / 6 7 8.
        for ((cell, shares) in listOf(
            4 to mapOf(0 to 0.25, 2 to 0.25, 6 to 0.25, 8 to 0.25),
            0 to mapOf(0 to 0.25, 1 to 0.25, 3 to 0.25, 4 to 0.25),
            1 to mapOf(0 to 0.25, 2 to 0.25, 3 to 0.25, 5 to 0.25),
            8 to mapOf(8 to 0.25, 7 to 0.25, 5 to 0.25, 4 to 0.25),
        )) {
            assertDrawnLike(shares, targets(WalkSteps.DIAGONAL_CLAMPED, 3, 3, cell))
        }
        // In a single row the step across is always clamped.
        assertDrawnLike(mapOf(0 to 0.5, 2 to 0.5), targets(WalkSteps.DIAGONAL_CLAMPED, 3, 1, 1))
        assertDrawnLike(mapOf(0 to 0.5, 1 to 0.5), targets(WalkSteps.DIAGONAL_CLAMPED, 3, 1, 0))
    }

    @Test
    fun aSingleCellHasNowhereToGo() {
        val map = flatMap(1, 1)
        for (steps in WalkSteps.entries) {
            plan.add(9.0, 9.0)
            val outcome = RandomWalk(Random(1), steps).plan(map, Position(0.5, 0.5), 0.5, StopCondition.NEVER, plan)
            assertEquals(PlanOutcome.NothingToGain, outcome)
            assertEquals(0, plan.size)
        }
    }

    @Test
    fun saysWhenTheBoatIsOffTheMap() {
        val map = flatMap(3, 3)
        for (from in listOf(Position(-0.1, 1.0), Position(3.0, 1.0), Position(Double.NaN, 1.0))) {
            plan.add(9.0, 9.0)
            assertEquals(PlanOutcome.OffMap, RandomWalk(Random(1)).plan(map, from, 0.5, StopCondition.NEVER, plan))
            assertEquals(0, plan.size)
        }
    }

    @Test
    fun theSameSeedWalksTheSameWay() {
        fun walk(seed: Int): List<Int> {
            val walk = RandomWalk(Random(seed))
            return generateSequence(12) { walk.next(5, 5, it) }.take(50).toList()
        }
        assertEquals(walk(3), walk(3))
        assertNotEquals(walk(3), walk(4))
    }

    private companion object {
        const val SEED = 42
        const val DRAWS = 20_000
    }
}
