package stillwater.control

import stillwater.model.Position
import kotlin.math.hypot

/**
 * A closed line that the boat must stay within, straight from corner to corner.
 *
 * @param corners in order, either way round, at least 3, local frame, m, finite. The line must not cross itself.
 * @throws IllegalArgumentException if there are fewer corners or one is not finite.
 */
public class Fence(corners: List<Position>) {
    init {
        require(corners.size >= 3) { "a fence needs at least 3 corners, not ${corners.size}" }
        require(corners.all { it.x.isFinite() && it.y.isFinite() }) { "a fence's corners must be finite" }
    }

    private val xs = DoubleArray(corners.size) { corners[it].x }
    private val ys = DoubleArray(corners.size) { corners[it].y }

    /** East part of the unit vector that leads inwards from the line, after [distance]. */
    public var inwardX: Double = 0.0
        private set

    /** North part of the same. */
    public var inwardY: Double = 0.0
        private set

    private var isOutside = false

    /**
     * Distance of ([x], [y]) to the line, m: positive inside, negative outside, NaN where a coordinate is NaN.
     *
     * O(corners), no allocation. Sets [inwardX] and [inwardY] for the nearest point of the line; both are 0 on the line.
     */
    public fun distance(x: Double, y: Double): Double {
        inwardX = 0.0
        inwardY = 0.0
        if (x.isNaN() || y.isNaN()) return Double.NaN
        var nearest = Double.POSITIVE_INFINITY
        var offsetX = 0.0
        var offsetY = 0.0
        var inside = false
        var last = xs.size - 1
        for (i in xs.indices) {
            if ((ys[i] > y) != (ys[last] > y) && x < (xs[last] - xs[i]) * (y - ys[i]) / (ys[last] - ys[i]) + xs[i]) {
                inside = !inside
            }
            val edgeX = xs[i] - xs[last]
            val edgeY = ys[i] - ys[last]
            val squared = edgeX * edgeX + edgeY * edgeY
            val along = if (squared > 0) ((x - xs[last]) * edgeX + (y - ys[last]) * edgeY) / squared else 0.0
            val share = along.coerceIn(0.0, 1.0)
            val toX = x - (xs[last] + share * edgeX)
            val toY = y - (ys[last] + share * edgeY)
            val distance = hypot(toX, toY)
            if (distance < nearest) {
                nearest = distance
                offsetX = toX
                offsetY = toY
            }
            last = i
        }
        isOutside = !inside
        val sign = if (inside) 1.0 else -1.0
        if (nearest > 0) {
            inwardX = sign * offsetX / nearest
            inwardY = sign * offsetY / nearest
        }
        return sign * nearest
    }

    /**
     * Whether a push in the direction ([pushX], [pushY]) leads away from every part of the line that is within [reach].
     *
     * From outside it has to lead towards the nearest point of the line. O(corners), no allocation. Call [distance] for
     * the same place before.
     */
    public fun leadsInwards(x: Double, y: Double, reach: Double, pushX: Double, pushY: Double): Boolean {
        if (!(pushX * inwardX + pushY * inwardY > 0)) return false
        if (isOutside) return true
        var last = xs.size - 1
        for (i in xs.indices) {
            val edgeX = xs[i] - xs[last]
            val edgeY = ys[i] - ys[last]
            val squared = edgeX * edgeX + edgeY * edgeY
            val along = if (squared > 0) ((x - xs[last]) * edgeX + (y - ys[last]) * edgeY) / squared else 0.0
            val share = along.coerceIn(0.0, 1.0)
            val toX = xs[last] + share * edgeX - x
            val toY = ys[last] + share * edgeY - y
            if (hypot(toX, toY) <= reach && pushX * toX + pushY * toY > 0) return false
            last = i
        }
        return true
    }
}
