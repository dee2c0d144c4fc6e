package stillwater.plan

import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Plan
import stillwater.model.Position
import stillwater.model.WaterArea
import kotlin.math.ceil
import kotlin.math.exp
import kotlin.math.hypot

/**
 * The tree of paths of a [PolygonRrt], in arrays that are used again for every plan. Node 0 is the boat.
 *
 * Once the arrays have grown no call but [legs] allocates.
 *
 * @param grid the map's cells.
 * @param cellSize the root of a cell's area, m.
 * @param area the water, or null where all of the grid is.
 * @param settings lengths and margin.
 */
internal class PathTree(
    private val grid: Grid,
    private val cellSize: Double,
    private val area: WaterArea?,
    private val settings: PolygonRrtSettings,
) {
    private val reach = settings.reach * cellSize
    private val horizon = settings.horizon * cellSize
    private val saturation = cellSize / 2
    private val slices = ceil(settings.reach * SLICES_PER_CELL).coerceIn(1.0, MOST_SLICES).toInt()
    private var xs = DoubleArray(FIRST_NODES)
    private var ys = DoubleArray(FIRST_NODES)
    private var parents = IntArray(FIRST_NODES)
    private var lengths = DoubleArray(FIRST_NODES)
    private var gains = DoubleArray(FIRST_NODES)

    /** The cell of each slice of a node's leg, [slices] a node. */
    private var cells = IntArray(FIRST_NODES * slices)
    private var path = IntArray(FIRST_NODES)
    private var rootMargin = 0.0
    private var best = ROOT

    /** Number of nodes. */
    var size: Int = 0
        private set

    /** Gain of the best path over its length and one cell; 0 where there is none. */
    var bestScore: Double = 0.0
        private set

    /** Starts over with the boat at ([x], [y]). */
    fun start(x: Double, y: Double) {
        xs[ROOT] = x
        ys[ROOT] = y
        parents[ROOT] = -1
        lengths[ROOT] = 0.0
        gains[ROOT] = 0.0
        size = 1
        best = ROOT
        bestScore = 0.0
        rootMargin = if (area == null || area.isClear(x, y, settings.margin)) settings.margin else 0.0
    }

    /** Grows towards the point ([towardsX], [towardsY]): the new point is joined to every near node that gains by it. */
    fun grow(map: FieldMap, towardsX: Double, towardsY: Double) {
        val nearest = nearest(towardsX, towardsY)
        val distance = hypot(towardsX - xs[nearest], towardsY - ys[nearest])
        if (!(distance > 0)) return
        val share = minOf(1.0, reach / distance)
        val x = xs[nearest] + share * (towardsX - xs[nearest])
        val y = ys[nearest] + share * (towardsY - ys[nearest])
        if (grid.cellAt(x, y) == Grid.OUTSIDE || (area != null && !area.isClear(x, y, settings.margin))) return
        val first = size
        // Nodes added here are not near to themselves.
        for (node in 0 until first) {
            if (size - first == MOST_PATHS) break
            if (hypot(x - xs[node], y - ys[node]) <= reach * (1 + ROUNDING)) join(map, node, x, y, first)
        }
    }

    private fun nearest(x: Double, y: Double): Int {
        var nearest = ROOT
        var least = Double.POSITIVE_INFINITY
        for (node in 0 until size) {
            val dx = xs[node] - x
            val dy = ys[node] - y
            val squared = dx * dx + dy * dy
            if (squared < least) {
                least = squared
                nearest = node
            }
        }
        return nearest
    }

    /** Adds the path to [node] and on to ([x], [y]), unless one of those from [first] on is as good in all. */
    private fun join(map: FieldMap, node: Int, x: Double, y: Double, first: Int) {
        val leg = hypot(x - xs[node], y - ys[node])
        val length = lengths[node] + leg
        if (!(leg > 0) || length > horizon) return
        val margin = if (node == ROOT) rootMargin else settings.margin
        if (area != null && !area.isClear(xs[node], ys[node], x, y, margin)) return
        if (size == xs.size) expand()
        val new = size
        xs[new] = x
        ys[new] = y
        parents[new] = node
        lengths[new] = length
        for (slice in 0 until slices) {
            val at = (slice + HALF) / slices
            cells[new * slices + slice] = grid.cellAt(xs[node] + at * (x - xs[node]), ys[node] + at * (y - ys[node]))
        }
        gains[new] = gains[node] + gain(map, new, leg)
        for (other in first until new) if (lengths[other] <= length && gains[other] >= gains[new]) return
        size++
        val score = gains[new] / (length + cellSize)
        if (score > bestScore) {
            bestScore = score
            best = new
        }
    }

    /** What the last leg of [node], [leg] m long, adds to what its path gained before. */
    private fun gain(map: FieldMap, node: Int, leg: Double): Double {
        var gain = 0.0
        var slice = 0
        while (slice < slices) {
            val cell = cells[node * slices + slice]
            var run = 1
            while (slice + run < slices && cells[node * slices + slice + run] == cell) run++
            slice += run
            if (cell == Grid.OUTSIDE) continue
            val worth = worth(map, cell)
            if (worth <= 0) continue
            val before = lengthBefore(node, cell)
            gain += worth * (exp(-before / saturation) - exp(-(before + leg * run / slices) / saturation))
        }
        return gain
    }

    /** Length of the path to [node]'s parent that lies in [cell], m. */
    private fun lengthBefore(node: Int, cell: Int): Double {
        var length = 0.0
        var at = parents[node]
        while (at > ROOT) {
            var inCell = 0
            for (slice in at * slices until (at + 1) * slices) if (cells[slice] == cell) inCell++
            if (inCell > 0) length += (lengths[at] - lengths[parents[at]]) * inCell / slices
            at = parents[at]
        }
        return length
    }

    /** Fills [plan] with the best path; empty where none gains anything. */
    fun writeBest(plan: Plan) {
        plan.clear()
        var legs = 0
        var at = best
        while (at != ROOT) {
            path[legs++] = at
            at = parents[at]
        }
        while (legs > 0) {
            val node = path[--legs]
            plan.add(xs[node], ys[node])
        }
    }

    /** All legs, from parent to child. */
    fun legs(): List<Pair<Position, Position>> = (1 until size).map { node ->
        Position(xs[parents[node]], ys[parents[node]]) to Position(xs[node], ys[node])
    }

    private fun expand() {
        val capacity = 2 * size
        xs = xs.copyOf(capacity)
        ys = ys.copyOf(capacity)
        parents = parents.copyOf(capacity)
        lengths = lengths.copyOf(capacity)
        gains = gains.copyOf(capacity)
        cells = cells.copyOf(capacity * slices)
        path = path.copyOf(capacity)
    }

    companion object {
        private const val ROOT = 0
        private const val FIRST_NODES = 512
        private const val SLICES_PER_CELL = 4
        private const val MOST_SLICES = 64.0
        private const val HALF = 0.5

        /** Paths kept to one drawn point. */
        private const val MOST_PATHS = 4

        /** A leg steered to its full reach may be longer by its rounding. */
        private const val ROUNDING = 1e-9

        /** What a cell promises: the width of its bounds, less with each visit; 0 where it has none. */
        fun worth(map: FieldMap, cell: Int): Double {
            val width = map.upper(cell) - map.lower(cell)
            return if (width > 0 && width.isFinite()) width / (1 + map.visits(cell)) else 0.0
        }
    }
}
