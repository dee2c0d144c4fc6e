package stillwater.plan

import org.junit.jupiter.api.Test
import stillwater.field.FieldMap
import stillwater.model.Plan
import stillwater.property.drawn
import stillwater.property.forEvery
import java.util.PriorityQueue
import kotlin.math.abs
import kotlin.math.max
import kotlin.math.min
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/**
 * The bounded planner against naive ones that share no code with it: paths as lists, all of them, and Algorithm 2 with
 * java.util.PriorityQueue.
 */
class BoundedPlannerOracleTest {
    /** What Algorithm 2 says the path of [cells] from [start] is worth, and the sensor at its end. */
    private fun worth(map: FieldMap, start: Int, sensor: Double, cells: List<Int>, case: Case): Double {
        var value = 0.0
        var expected = sensor
        for ((i, cell) in cells.withIndex()) {
            val middle = (map.lower(cell) + map.upper(cell)) / 2
            var gain = max(0.0, map.upper(cell) - map.lower(cell) - abs(middle - expected))
            if (case.discount) gain /= 1.0 + (listOf(start) + cells.take(i)).count { it == cell }
            value += gain
            expected += max(-case.maxChange, min(case.maxChange, middle - expected))
        }
        return value
    }

    private fun allPaths(case: Case): List<List<Int>> {
        var longest = listOf(emptyList<Int>())
        val paths = ArrayList<List<Int>>()
        repeat(case.horizon) {
            longest = longest.flatMap { path ->
                reachable(case, path.lastOrNull() ?: case.start).map { path + it }
            }
            paths += longest
        }
        return paths
    }

    private fun reachable(case: Case, cell: Int): List<Int> = when (case.reach) {
        Neighbours.EDGE -> neighbours(case.map.grid, cell)
        Neighbours.EDGE_OR_CORNER -> (0 until case.map.grid.size).filter { other ->
            val from = case.map.grid.cell(cell)
            val to = case.map.grid.cell(other)
            max(abs(from.column - to.column), abs(from.row - to.row)) == 1
        }
    }

    @Test
    fun withEnoughExpansionsNoPathIsBetter() {
        forEvery(drawn { Case(it, everySort = true) }, cases = 200) { case ->
            val best = allPaths(case).maxOfOrNull {
                worth(case.map, case.start, case.sensor, it, case)
            } ?: 0.0
            val plan = Plan()
            val outcome = case.planner(PathChoice.BEST, expansions = 5000).plan(case, plan)
            val path = cells(plan, case.map.grid)
            // The same sum of at most four terms below 1, in the same order: a few last places.
            assertEquals(best, worth(case.map, case.start, case.sensor, path, case), 1e-14)
            assertEquals(if (best > 0) PlanOutcome.Planned else PlanOutcome.NothingToGain, outcome)
        }
    }

    @Test
    fun withFewExpansionsItPollsWhatAPriorityQueueWould() {
        for (choice in PathChoice.entries) {
            var compared = 0
            forEvery(drawn { Case(it, everySort = false) }, cases = 300) { case ->
                val naive = Naive(case, choice)
                naive.run()
                // With two paths of equal worth the order in which the children are drawn decides: not compared.
                if (naive.ties) return@forEvery
                compared++
                val plan = Plan()
                val outcome = case.planner(choice, case.expansions).plan(case, plan)
                assertEquals(naive.chosen, cells(plan, case.map.grid), "$choice")
                val expected = if (naive.chosen.isEmpty()) PlanOutcome.NothingToGain else PlanOutcome.Planned
                assertEquals(expected, outcome)
            }
            assertTrue(compared > 200, "$choice: only $compared cases without ties")
        }
    }

    @Test
    fun placesVisitedOverAndOverAreCounted() {
        var compared = 0
        var often = 0
        forEvery(drawn { Case(it, everySort = false, horizons = 8..14, sides = 1..3) }, cases = 300) { case ->
            val naive = Naive(case, PathChoice.BEST)
            naive.run()
            if (naive.ties) return@forEvery
            compared++
            if (naive.chosen.groupingBy { it }.eachCount().any { it.value >= 4 }) often++
            val plan = Plan()
            case.planner(PathChoice.BEST, case.expansions).plan(case, plan)
            assertEquals(naive.chosen, cells(plan, case.map.grid))
        }
        assertTrue(compared > 200 && often > 20, "$often of $compared paths come to a place four times")
    }

    @Test
    fun theOriginalsChoiceIsOftenNotTheBest() {
        var worse = 0
        forEvery(drawn { Case(it, everySort = false) }, cases = 200) { case ->
            val best = Naive(case, PathChoice.BEST).also { it.run() }.chosen
            val last = Naive(case, PathChoice.LAST_POLLED).also { it.run() }.chosen
            val bestWorth = worth(case.map, case.start, case.sensor, best, case)
            val lastWorth = worth(case.map, case.start, case.sensor, last, case)
            assertTrue(lastWorth <= bestWorth + 1e-14, "$lastWorth above the best $bestWorth")
            if (lastWorth < bestWorth - 1e-9) worse++
        }
        // The oracle itself tells the two choices apart, or the test above would compare nothing.
        assertTrue(worse > 50, "$worse of 200")
    }

    /** Algorithm 2 as printed, with the readings BoundedPlanner names. */
    private inner class Naive(private val case: Case, private val choice: PathChoice) {
        private inner class Node(val path: List<Int>) {
            val value = worth(case.map, case.start, case.sensor, path, case)
            val priority = if (path.isEmpty() || case.priority == Priority.VALUE) value else value / path.size
        }

        var ties = false
            private set

        var chosen = emptyList<Int>()
            private set

        fun run() {
            val nodes = ArrayList<Node>()
            val queue = PriorityQueue(compareByDescending<Node> { it.priority })
            queue += Node(emptyList())
            var polls = 0
            var lastPolled = emptyList<Int>()
            while (polls < case.expansions && queue.isNotEmpty()) {
                val node = queue.poll()
                if (node.value > 0) lastPolled = node.path
                polls++
                if (node.path.size == case.horizon) continue
                for (cell in reachable(case, node.path.lastOrNull() ?: case.start)) {
                    val child = Node(node.path + cell)
                    nodes += child
                    // The best path can be read off the tree; only the original's choice polls nodes at the horizon.
                    if (child.path.size < case.horizon || choice == PathChoice.LAST_POLLED) queue += child
                }
            }
            // Worths that differ by rounding only are ties too.
            ties = haveTies(nodes.map { it.value }) || haveTies(nodes.map { it.priority })
            val best = nodes.maxByOrNull { it.value }?.takeIf { it.value > 0 }
            chosen = if (choice == PathChoice.BEST) best?.path.orEmpty() else lastPolled
        }

        private fun haveTies(numbers: List<Double>) = numbers.sorted().zipWithNext().any { (a, b) -> b - a < 1e-13 }
    }

    private class Case(random: Random, everySort: Boolean, horizons: IntRange = 1..4, sides: IntRange = 1..4) {
        val horizon = horizons.random(random)
        val expansions = random.nextInt(1, 40)
        val maxChange = random.nextDouble(0.01, 0.6)
        val discount = random.nextBoolean()
        val reach = Neighbours.entries.random(random)
        val priority = Priority.entries.random(random)
        val sensor = random.nextDouble()
        val seed = random.nextInt()
        val map = randomMap(random, sides.random(random), sides.random(random))
        val start = random.nextInt(map.grid.size)

        init {
            if (!everySort) {
                // Wide bounds: every cell is worth something, so that ties are rare.
                for (cell in 0 until map.grid.size) {
                    map.setBounds(cell, random.nextDouble(0.0, 0.3), random.nextDouble(0.8, 1.0))
                }
            }
        }

        fun planner(choice: PathChoice, expansions: Int) = BoundedPlanner(
            Random(seed),
            BoundedPlannerSettings(
                horizon,
                expansions,
                maxChange,
                discount,
                Execution.WHOLE_PATH,
                choice,
                reach,
                priority,
            ),
        )

        override fun toString() = "horizon $horizon, expansions $expansions, maxChange $maxChange, " +
            "discount $discount, $reach, $priority, sensor $sensor, start $start, " +
            "${map.grid.columns} x ${map.grid.rows}: " +
            List(map.grid.size) { "${map.lower(it)}..${map.upper(it)}" }
    }

    private fun BoundedPlanner.plan(case: Case, plan: Plan) =
        plan(case.map, case.map.grid.center(case.start), case.sensor, StopCondition.NEVER, plan)
}
