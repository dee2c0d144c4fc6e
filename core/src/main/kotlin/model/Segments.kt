package stillwater.model

/** Distances between points and straight segments in the plane. No call allocates. */
internal object Segments {
    /** Squared distance from the point ([x], [y]) to the segment from a to b. */
    fun squaredDistance(x: Double, y: Double, ax: Double, ay: Double, bx: Double, by: Double): Double {
        val dx = bx - ax
        val dy = by - ay
        val squaredLength = dx * dx + dy * dy
        val along = if (squaredLength > 0) ((x - ax) * dx + (y - ay) * dy) / squaredLength else 0.0
        val share = along.coerceIn(0.0, 1.0)
        val toX = x - (ax + share * dx)
        val toY = y - (ay + share * dy)
        return toX * toX + toY * toY
    }

    /** Squared distance between the segments from a to b and from c to d; exactly 0 where they meet. */
    fun squaredDistance(
        ax: Double,
        ay: Double,
        bx: Double,
        by: Double,
        cx: Double,
        cy: Double,
        dx: Double,
        dy: Double,
    ): Double {
        val c = side(ax, ay, bx, by, cx, cy)
        val d = side(ax, ay, bx, by, dx, dy)
        val a = side(cx, cy, dx, dy, ax, ay)
        val b = side(cx, cy, dx, dy, bx, by)
        // Both ends of either lie on different sides of the other, or on it; all on one line are left to the distances.
        if (c * d <= 0 && a * b <= 0 && (c != 0.0 || d != 0.0 || a != 0.0 || b != 0.0)) return 0.0
        return minOf(
            minOf(squaredDistance(cx, cy, ax, ay, bx, by), squaredDistance(dx, dy, ax, ay, bx, by)),
            minOf(squaredDistance(ax, ay, cx, cy, dx, dy), squaredDistance(bx, by, cx, cy, dx, dy)),
        )
    }

    /** Above 0 where p lies to the left of the line from a to b, below 0 to its right. */
    private fun side(ax: Double, ay: Double, bx: Double, by: Double, px: Double, py: Double) =
        (bx - ax) * (py - ay) - (by - ay) * (px - ax)
}
