package stillwater.app.screen

import stillwater.model.Position

/**
 * From the local frame to the screen: north is up, and both axes have one scale.
 *
 * @property centre what is in the middle of the view, m.
 * @property scale pixels a metre, above 0.
 * @param width of the view, px; [height] likewise.
 */
internal class MapProjection(val centre: Position, val scale: Float, width: Float, height: Float) {
    private val middleX = width / 2
    private val middleY = height / 2

    fun x(position: Position): Float = x(position.x)

    fun y(position: Position): Float = y(position.y)

    /** Where what is [east] m of the frame's origin is drawn, px. */
    fun x(east: Double): Float = middleX + ((east - centre.x) * scale).toFloat()

    /** Where what is [north] m of the frame's origin is drawn, px. */
    fun y(north: Double): Float = middleY - ((north - centre.y) * scale).toFloat()

    /** What lies under a point of the screen. */
    fun position(x: Float, y: Float): Position =
        Position(centre.x + (x - middleX) / scale, centre.y + (middleY - y) / scale)

    companion object {
        /** A boat that has not moved yet is shown in 10 m of water, m. */
        private const val SMALLEST_SPAN = 10.0

        /** All of [extent], not empty, in sight, [margin] px free at every edge, [foot] more below, [head] above. */
        fun fitting(
            extent: List<Position>,
            width: Float,
            height: Float,
            margin: Float,
            foot: Float = 0f,
            head: Float = 0f,
        ): MapProjection {
            val (west, east) = extent.minOf { it.x } to extent.maxOf { it.x }
            val (south, north) = extent.minOf { it.y } to extent.maxOf { it.y }
            val across = (width - 2 * margin) / (east - west).coerceAtLeast(SMALLEST_SPAN)
            val up = (height - foot - head - 2 * margin) / (north - south).coerceAtLeast(SMALLEST_SPAN)
            val scale = minOf(across, up).coerceAtLeast(Float.MIN_VALUE.toDouble()).toFloat()
            val middle = Position((west + east) / 2, (south + north) / 2 + (head - foot) / 2 / scale)
            return MapProjection(middle, scale, width, height)
        }
    }
}
