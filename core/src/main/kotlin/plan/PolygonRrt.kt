package stillwater.plan

import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Plan
import stillwater.model.Position
import stillwater.model.WaterArea
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.exp
import kotlin.math.hypot
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.random.Random

/**
 * Settings of a [PolygonRrt]. Lengths in cells are in units of the root of a cell's area.
 *
 * @property iterations points drawn for one plan, at least 1.
 * @property horizon longest path of the tree, cells, above 0.
 * @property reach longest leg of the tree, cells, above 0.
 * @property margin smallest distance of every leg from land and keep-outs, m, at least 0.
 * @property resolution distance between the points of the lattice that finds ways through narrow water, m, above 0; null
 *   for half a cell. See [WaterRoutes].
 * @throws IllegalArgumentException if a number is out of its range.
 */
public data class PolygonRrtSettings(
    val iterations: Int = 300,
    val horizon: Double = 8.0,
    val reach: Double = 2.0,
    val margin: Double = 0.0,
    val resolution: Double? = null,
) {
    init {
        require(iterations in 1..MAX_ITERATIONS) { "iterations ($iterations) must be within 1..$MAX_ITERATIONS" }
        require(horizon > 0 && horizon.isFinite()) { "horizon ($horizon cells) must be above 0 and finite" }
        require(reach > 0 && reach.isFinite()) { "reach ($reach cells) must be above 0 and finite" }
        require(margin >= 0 && margin.isFinite()) { "margin ($margin m) must be at least 0 and finite" }
        require(resolution == null || (resolution > 0 && resolution.isFinite())) {
            "resolution ($resolution m) must be above 0 and finite"
        }
    }

    public companion object {
        /** The most iterations; a tree has four nodes for each at most. */
        public const val MAX_ITERATIONS: Int = 100_000
    }
}

/**
 * Seeks, in the plane rather than from cell to cell, the path over the water that gains most for its length.
 *
 * A tree of straight legs grows from the boat towards points drawn at random, half of them uniformly within the horizon
 * and half in cells that promise more than others. A new point is joined not to its nearest node alone but to each near
 * one, and of the paths to one point those are kept that no other beats in both gain and length. A path gains in a cell
 * with bounds [L, U], visited v times, in which it runs for ℓ metres,
 *
 * (U − L) / (1 + v) · (1 − exp(−ℓ / λ)), λ half a cell,
 *
 * however often it comes by. The path with the highest gain / (length + one cell) is planned; where going straight to one
 * cell, by the shortest way through the water, has more, that way is. So cells beyond the horizon or behind a narrow
 * passage are found up to [WaterRoutes]' resolution, whatever was drawn.
 *
 * No leg crosses land or a keep-out or comes nearer to them than the margin, except the first out of a place that is
 * itself nearer. A stop ends the growth; the best path so far is planned. Without an area all of the map is water. The
 * gain knows nothing of the sensor's state; derivation, assumptions and limits are in core/docs/PolygonRrt.md.
 *
 * Source: LaValle and Kuffner 2001, doi:10.1177/02783640122067453, and Hollinger and Sukhatme 2014,
 * doi:10.1177/0278364914533443, the RIG-tree algorithm. Differs: gain per length instead of gain within a budget; half of
 * the samples go to promising cells; only paths to the same drawn point are compared for pruning. O(iterations · nodes);
 * nothing is allocated once the tree has grown, unless the map's grid changes. Confined to one thread.
 *
 * @param random where the points come from. Retained.
 * @property area the water, or null where all of the map is.
 * @property settings iterations, lengths and margin.
 */
public class PolygonRrt(
    private val random: Random,
    public val area: WaterArea? = null,
    public val settings: PolygonRrtSettings = PolygonRrtSettings(),
) : Planner {
    private var tree: PathTree? = null
    private var routes: WaterRoutes? = null
    private var grid: Grid? = null

    /** The root of a cell's area, m. */
    private var size = 1.0
    private var sampleX = 0.0
    private var sampleY = 0.0

    override fun plan(
        map: FieldMap,
        from: Position,
        sensorValue: Double,
        stop: StopCondition,
        plan: Plan,
    ): PlanOutcome {
        plan.clear()
        if (map.grid != grid) lay(map.grid)
        val start = map.grid.cellAt(from)
        if (start == Grid.OUTSIDE) return PlanOutcome.OffMap
        if (area != null && from !in area) return PlanOutcome.OffWater
        val tree = checkNotNull(tree)
        tree.start(from.x, from.y)
        var stopped = false
        var drawn = 0
        while (drawn < settings.iterations) {
            stopped = stop.stop()
            if (stopped) break
            draw(map, from)
            tree.grow(map, sampleX, sampleY)
            drawn++
        }
        val isStraight = !stopped && isStraightBetter(map, from, tree.bestScore, plan)
        if (!isStraight) tree.writeBest(plan)
        return when {
            plan.size > 0 -> PlanOutcome.Planned
            stopped -> PlanOutcome.Stopped
            // A tree that has no leg at all, on water that the lattice does not reach either.
            area != null && tree.size == 1 && routes?.start(from.x, from.y) == false -> PlanOutcome.OffWater
            else -> PlanOutcome.NothingToGain
        }
    }

    /** The legs of the last plan's tree, for display. Allocates. */
    public fun tree(): List<Pair<Position, Position>> = tree?.legs().orEmpty()

    private fun lay(grid: Grid) {
        this.grid = grid
        size = sqrt(grid.cellWidth * grid.cellHeight)
        tree = PathTree(grid, size, area, settings)
        if (routes == null && area != null) {
            routes = WaterRoutes(area, settings.margin, settings.resolution ?: (size / 2))
        }
    }

    private fun draw(map: FieldMap, from: Position) {
        val grid = map.grid
        if (random.nextBoolean()) {
            val radius = settings.horizon * size * sqrt(random.nextDouble())
            val angle = 2 * PI * random.nextDouble()
            sampleX = from.x + radius * cos(angle)
            sampleY = from.y + radius * sin(angle)
        } else {
            val one = random.nextInt(grid.size)
            val other = random.nextInt(grid.size)
            val cell = if (PathTree.worth(map, one) >= PathTree.worth(map, other)) one else other
            val u = random.nextDouble() - HALF
            val v = random.nextDouble() - HALF
            val c = cos(grid.rotation)
            val s = sin(grid.rotation)
            sampleX = grid.centerX(cell) + c * u * grid.cellWidth - s * v * grid.cellHeight
            sampleY = grid.centerY(cell) + s * u * grid.cellWidth + c * v * grid.cellHeight
        }
    }

    /** Whether the shortest way to some cell has a score above [score]; if so, it is written into [plan]. */
    private fun isStraightBetter(map: FieldMap, from: Position, score: Double, plan: Plan): Boolean {
        val grid = map.grid
        val routes = routes
        var best = -1
        var highest = score
        if (routes == null) {
            for (cell in 0 until grid.size) {
                val length = hypot(grid.centerX(cell) - from.x, grid.centerY(cell) - from.y)
                val found = PathTree.worth(map, cell) * STAY / (length + size)
                if (found > highest && length > 0) {
                    highest = found
                    best = cell
                }
            }
            if (best >= 0) plan.add(grid.centerX(best), grid.centerY(best))
            return best >= 0
        }
        if (!routes.start(from.x, from.y)) return false
        for (point in 0 until routes.points) {
            val length = routes.distance(point)
            if (length == Double.POSITIVE_INFINITY || length == 0.0) continue
            val cell = grid.cellAt(routes.x(point), routes.y(point))
            if (cell == Grid.OUTSIDE) continue
            val found = PathTree.worth(map, cell) * STAY / (length + size)
            if (found > highest) {
                highest = found
                best = point
            }
        }
        if (best >= 0) routes.wayTo(best, plan)
        return best >= 0
    }

    private companion object {
        const val HALF = 0.5

        /** What is gained of a cell by running through all of it. */
        val STAY = 1 - exp(-2.0)
    }
}
