package stillwater.model

import kotlin.math.sqrt

/**
 * The water a boat may be on: a polygon, the shore, less its islands and other keep-outs.
 *
 * A point is on the water when it lies inside the shore and in no keep-out; either side of a keep-out's outline and the
 * shore itself are land. Rings may run either way round and may repeat their first corner at the end. A keep-out may
 * reach over the shore or into another keep-out, as a bathing zone does, but has to take some of the water. Immutable;
 * no query allocates; each is O([edges]).
 *
 * @param shore corners of the outer outline in order, local frame, m. Copied.
 * @param keepOuts corners of each outline that is kept out of. Copied.
 * @throws IllegalArgumentException if an outline has fewer than 3 different corners, a corner that is not finite, no
 *   area, or crosses or touches itself; if a keep-out has nothing to do with the water, or leaves none; or if there are
 *   more than [MAX_EDGES] edges.
 */
public class WaterArea(shore: List<Position>, keepOuts: List<List<Position>> = emptyList()) {
    private val startX: DoubleArray
    private val startY: DoubleArray
    private val endX: DoubleArray
    private val endY: DoubleArray

    /** First edge of each ring, and the number of edges: length rings + 1. */
    private val firstEdge: IntArray

    /** The corners of the shore and of each keep-out, none repeated; for display. */
    public val outlines: List<List<Position>>

    /** Number of edges of all outlines. */
    public val edges: Int get() = startX.size

    /** Least x of the shore, m. */
    public val west: Double

    /** Greatest x of the shore, m. */
    public val east: Double

    /** Least y of the shore, m. */
    public val south: Double

    /** Greatest y of the shore, m. */
    public val north: Double

    init {
        outlines = (listOf(shore) + keepOuts).mapIndexed { ring, corners -> Outline.cleaned(name(ring), corners) }
        firstEdge = outlines.runningFold(0) { sum, corners -> sum + corners.size }.toIntArray()
        require(firstEdge.last() <= MAX_EDGES) {
            "the outlines have ${firstEdge.last()} edges together; they may have $MAX_EDGES: simplify them"
        }
        val starts = outlines.flatten()
        val ends = outlines.flatMap { it.drop(1) + it.first() }
        startX = DoubleArray(starts.size) { starts[it].x }
        startY = DoubleArray(starts.size) { starts[it].y }
        endX = DoubleArray(ends.size) { ends[it].x }
        endY = DoubleArray(ends.size) { ends[it].y }
        west = outlines[0].minOf { it.x }
        east = outlines[0].maxOf { it.x }
        south = outlines[0].minOf { it.y }
        north = outlines[0].maxOf { it.y }
        for (ring in outlines.indices) requireSimple(ring)
        for (ring in 1 until outlines.size) requireSomeWater(ring)
    }

    /** Whether the point ([x], [y]), local frame, m, is on the water; false where a coordinate is NaN. */
    public fun contains(x: Double, y: Double): Boolean {
        if (!isInside(0, x, y)) return false
        for (ring in 1 until firstEdge.size - 1) if (isInside(ring, x, y)) return false
        return true
    }

    /** Whether [position] is on the water. */
    public operator fun contains(position: Position): Boolean = contains(position.x, position.y)

    /** Distance from the point ([x], [y]) to the nearest outline, on whichever side, m. */
    public fun distanceToOutline(x: Double, y: Double): Double {
        var least = Double.POSITIVE_INFINITY
        for (edge in startX.indices) {
            least = minOf(least, Segments.squaredDistance(x, y, startX[edge], startY[edge], endX[edge], endY[edge]))
        }
        return sqrt(least)
    }

    /** Whether the point ([x], [y]) is on the water and farther than [margin], m, from all outlines. */
    public fun isClear(x: Double, y: Double, margin: Double): Boolean = isClear(x, y, x, y, margin)

    /**
     * Whether all of the straight leg from ([fromX], [fromY]) to ([toX], [toY]) is on the water and farther than [margin],
     * m, at least 0, from all outlines. False where a coordinate is not finite.
     */
    public fun isClear(fromX: Double, fromY: Double, toX: Double, toY: Double, margin: Double): Boolean {
        val left = minOf(fromX, toX) - margin
        val right = maxOf(fromX, toX) + margin
        val bottom = minOf(fromY, toY) - margin
        val top = maxOf(fromY, toY) + margin
        // Also refuses what is not finite: no comparison with NaN holds.
        if (!(left >= west && right <= east && bottom >= south && top <= north)) return false
        for (edge in startX.indices) {
            val ax = startX[edge]
            val ay = startY[edge]
            val bx = endX[edge]
            val by = endY[edge]
            val apart = maxOf(ax, bx) < left || minOf(ax, bx) > right || maxOf(ay, by) < bottom || minOf(ay, by) > top
            if (!apart &&
                squaredDistance(fromX, fromY, toX, toY, edge) <= margin * margin
            ) {
                return false
            }
        }
        return contains(fromX, fromY)
    }

    /** Crossings of a ray to the east, counted for one ring. */
    private fun isInside(ring: Int, x: Double, y: Double): Boolean {
        var inside = false
        for (edge in firstEdge[ring] until firstEdge[ring + 1]) {
            val ay = startY[edge]
            val by = endY[edge]
            if (ay > y != by > y && x < startX[edge] + (y - ay) / (by - ay) * (endX[edge] - startX[edge])) {
                inside = !inside
            }
        }
        return inside
    }

    private fun requireSimple(ring: Int) {
        val first = firstEdge[ring]
        val last = firstEdge[ring + 1] - 1
        for (one in first..last) {
            for (other in one + 1..last) {
                val neighbours = other == one + 1 || (one == first && other == last)
                require(if (neighbours) !foldsBack(one, other) else !meet(one, other)) {
                    "${name(ring)} crosses or touches itself: edge ${one - first + 1} ${edgeText(one)} meets edge " +
                        "${other - first + 1} ${edgeText(other)}"
                }
            }
        }
    }

    private fun meet(one: Int, other: Int): Boolean {
        val apart = maxOf(startX[one], endX[one]) < minOf(startX[other], endX[other]) ||
            minOf(startX[one], endX[one]) > maxOf(startX[other], endX[other]) ||
            maxOf(startY[one], endY[one]) < minOf(startY[other], endY[other]) ||
            minOf(startY[one], endY[one]) > maxOf(startY[other], endY[other])
        return !apart && squaredDistance(startX[one], startY[one], endX[one], endY[one], other) == 0.0
    }

    /** Squared distance between the segment from a to b and [edge], m²; exactly 0 where they meet. */
    private fun squaredDistance(ax: Double, ay: Double, bx: Double, by: Double, edge: Int): Double {
        val cx = startX[edge]
        val cy = startY[edge]
        val dx = endX[edge]
        val dy = endY[edge]
        val c = Segments.side(ax, ay, bx, by, cx, cy)
        val d = Segments.side(ax, ay, bx, by, dx, dy)
        val a = Segments.side(cx, cy, dx, dy, ax, ay)
        val b = Segments.side(cx, cy, dx, dy, bx, by)
        // Both ends of either lie on different sides of the other, or on it; all on one line are left to the distances.
        val isOneLine = c == 0.0 && d == 0.0 && a == 0.0 && b == 0.0
        if (!isOneLine && c * d <= 0 && a * b <= 0) return 0.0
        return minOf(
            minOf(
                Segments.squaredDistance(cx, cy, ax, ay, bx, by),
                Segments.squaredDistance(dx, dy, ax, ay, bx, by),
            ),
            minOf(
                Segments.squaredDistance(ax, ay, cx, cy, dx, dy),
                Segments.squaredDistance(bx, by, cx, cy, dx, dy),
            ),
        )
    }

    /** Whether of two edges that share a corner one lies upon the other. */
    private fun foldsBack(one: Int, other: Int): Boolean {
        val wrapped = endX[other] == startX[one] && endY[other] == startY[one]
        val before = if (wrapped) other else one
        val after = if (wrapped) one else other
        val ux = endX[before] - startX[before]
        val uy = endY[before] - startY[before]
        val vx = endX[after] - startX[after]
        val vy = endY[after] - startY[after]
        return ux * vy - uy * vx == 0.0 && ux * vx + uy * vy < 0
    }

    private fun requireSomeWater(ring: Int) {
        val corners = outlines[ring]
        val crosses = (firstEdge[ring] until firstEdge[ring + 1]).any { edge ->
            (0 until firstEdge[1]).any { shore -> meet(edge, shore) }
        }
        require(crosses || corners.any { isInside(0, it.x, it.y) } || outlines[0].any { isInside(ring, it.x, it.y) }) {
            "${name(ring)}, which starts at ${text(corners.first())}, lies outside the shore"
        }
        require(crosses || !outlines[0].any { isInside(ring, it.x, it.y) }) {
            "${name(ring)}, which starts at ${text(corners.first())}, leaves no water inside the shore"
        }
    }

    private fun name(ring: Int) = if (ring == 0) "the shore" else "keep-out $ring"

    private fun edgeText(edge: Int) =
        "${text(Position(startX[edge], startY[edge]))} to ${text(Position(endX[edge], endY[edge]))}"

    private fun text(position: Position) = "(${position.x} m, ${position.y} m)"

    public companion object {
        /** The most edges an area may have: its check compares each with each other. */
        public const val MAX_EDGES: Int = 20_000
    }
}

/** Checks of one outline by itself. */
private object Outline {
    /** [corners] without repeated ones. */
    fun cleaned(name: String, corners: List<Position>): List<Position> {
        require(corners.all { it.x.isFinite() && it.y.isFinite() }) { "$name has a corner that is not finite" }
        val different = corners.filterIndexed { index, corner -> index == 0 || corner != corners[index - 1] }
        val open = if (different.size > 1 && different.last() == different.first()) different.dropLast(1) else different
        require(open.distinct().size >= CORNERS) { "$name has ${open.distinct().size} different corners; it needs 3" }
        require(!isStraight(open)) { "$name encloses no area: its corners lie on one line" }
        return open
    }

    /** Not by the area: that of a rectangle whose corners come in the wrong order is 0, too, and it crosses itself. */
    private fun isStraight(corners: List<Position>): Boolean {
        val a = corners[0]
        val b = corners.first { it != a }
        return corners.all { (b.x - a.x) * (it.y - a.y) == (it.x - a.x) * (b.y - a.y) }
    }

    private const val CORNERS = 3
}
