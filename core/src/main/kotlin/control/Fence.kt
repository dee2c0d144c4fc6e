package stillwater.control

import stillwater.model.Position
import kotlin.math.hypot

/**
 * The lines that the boat must stay within and without: a shore and any number of keep-outs, straight from corner to corner.
 *
 * @param corners of the shore in order, either way round, at least 3, local frame, m, finite. The line must not cross itself.
 * @param keepOuts corners of each outline that is to be kept out of, likewise; they may overlap.
 * @throws IllegalArgumentException if a line has fewer corners or one is not finite.
 */
public class Fence(corners: List<Position>, keepOuts: List<List<Position>> = emptyList()) {
    private val lines = listOf(FenceLine(corners, 1.0)) + keepOuts.map { FenceLine(it, -1.0) }

    /** East part of the unit vector that leads to the water from the line that matters, after [distance]. */
    public var inwardX: Double = 0.0
        private set

    /** North part of the same. */
    public var inwardY: Double = 0.0
        private set

    private var isOutside = false

    /**
     * Distance of ([x], [y]) to the nearest line, m: positive on the water, else negative and of the line that is farthest
     * overstepped; NaN where a coordinate is NaN.
     *
     * O(corners), no allocation. Sets [inwardX] and [inwardY] for the nearest point of that line; both are 0 on it.
     */
    public fun distance(x: Double, y: Double): Double {
        inwardX = 0.0
        inwardY = 0.0
        if (x.isNaN() || y.isNaN()) return Double.NaN
        var least = Double.POSITIVE_INFINITY
        for (i in lines.indices) {
            val distance = lines[i].distance(x, y)
            if (distance < least) {
                least = distance
                inwardX = lines[i].inwardX
                inwardY = lines[i].inwardY
            }
        }
        isOutside = least < 0
        return least
    }

    /**
     * Whether a push in the direction ([pushX], [pushY]) leads away from every part of the lines that is within [reach].
     *
     * From beyond a line it has to lead towards the nearest point of it. O(corners), no allocation. Call [distance] for
     * the same place before.
     */
    public fun leadsInwards(x: Double, y: Double, reach: Double, pushX: Double, pushY: Double): Boolean {
        if (!(pushX * inwardX + pushY * inwardY > 0)) return false
        if (isOutside) return true
        for (i in lines.indices) if (!lines[i].leadsAway(x, y, reach, pushX, pushY)) return false
        return true
    }
}

/** One closed line; [side] is 1 where its inside is the water and -1 where its outside is. */
private class FenceLine(corners: List<Position>, private val side: Double) {
    init {
        require(corners.size >= 3) { "a fence needs at least 3 corners, not ${corners.size}" }
        require(corners.all { it.x.isFinite() && it.y.isFinite() }) { "a fence's corners must be finite" }
    }

    private val xs = DoubleArray(corners.size) { corners[it].x }
    private val ys = DoubleArray(corners.size) { corners[it].y }

    /** Unit vector from the nearest point of the line, at the last [distance], to the water; 0 on the line. */
    var inwardX = 0.0
        private set
    var inwardY = 0.0
        private set

    // From the nearest point of the edge looked at last to the place.
    private var offsetX = 0.0
    private var offsetY = 0.0

    /** Distance of ([x], [y]), m, positive on the water's side. */
    fun distance(x: Double, y: Double): Double {
        var nearest = Double.POSITIVE_INFINITY
        var toX = 0.0
        var toY = 0.0
        var inside = false
        var last = xs.size - 1
        for (i in xs.indices) {
            if ((ys[i] > y) != (ys[last] > y) && x < (xs[last] - xs[i]) * (y - ys[i]) / (ys[last] - ys[i]) + xs[i]) {
                inside = !inside
            }
            val distance = measure(x, y, last, i)
            if (distance < nearest) {
                nearest = distance
                toX = offsetX
                toY = offsetY
            }
            last = i
        }
        val sign = if (inside) side else -side
        inwardX = if (nearest > 0) sign * toX / nearest else 0.0
        inwardY = if (nearest > 0) sign * toY / nearest else 0.0
        return sign * nearest
    }

    /** Whether ([pushX], [pushY]) leads from ([x], [y]) towards no edge within [reach]. */
    fun leadsAway(x: Double, y: Double, reach: Double, pushX: Double, pushY: Double): Boolean {
        var last = xs.size - 1
        for (i in xs.indices) {
            if (measure(x, y, last, i) <= reach && pushX * offsetX + pushY * offsetY < 0) return false
            last = i
        }
        return true
    }

    /** Distance of ([x], [y]) to the edge between two corners; sets the offset. */
    private fun measure(x: Double, y: Double, from: Int, to: Int): Double {
        val edgeX = xs[to] - xs[from]
        val edgeY = ys[to] - ys[from]
        val squared = edgeX * edgeX + edgeY * edgeY
        val along = if (squared > 0) ((x - xs[from]) * edgeX + (y - ys[from]) * edgeY) / squared else 0.0
        val share = along.coerceIn(0.0, 1.0)
        offsetX = x - (xs[from] + share * edgeX)
        offsetY = y - (ys[from] + share * edgeY)
        return hypot(offsetX, offsetY)
    }
}
