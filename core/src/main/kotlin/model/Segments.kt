package stillwater.model

/** Points and straight segments in the plane. No call allocates. */
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

    /** Above 0 where p lies to the left of the line from a to b, below 0 to its right. */
    fun side(ax: Double, ay: Double, bx: Double, by: Double, px: Double, py: Double): Double =
        (bx - ax) * (py - ay) - (by - ay) * (px - ax)
}
