package stillwater.app.screen

import stillwater.model.Position

/**
 * From the local frame to the screen: north is up, both axes have one scale, and everything is in sight.
 *
 * @param extent positions that have to be in sight; at least one.
 * @param width of the view, px; [height] likewise.
 * @param margin kept free at every edge, px.
 */
internal class MapProjection(extent: List<Position>, width: Float, height: Float, margin: Float) {
    private val west = extent.minOf { it.x }
    private val south = extent.minOf { it.y }
    private val spanX = (extent.maxOf { it.x } - west).coerceAtLeast(SMALLEST_SPAN)
    private val spanY = (extent.maxOf { it.y } - south).coerceAtLeast(SMALLEST_SPAN)

    /** Pixels a metre. */
    val scale: Float =
        minOf((width - 2 * margin) / spanX, (height - 2 * margin) / spanY).coerceAtLeast(Double.MIN_VALUE).toFloat()
    private val left = (width - scale * spanX.toFloat()) / 2
    private val bottom = (height + scale * spanY.toFloat()) / 2

    fun x(position: Position): Float = left + ((position.x - west) * scale).toFloat()

    fun y(position: Position): Float = bottom - ((position.y - south) * scale).toFloat()

    /** What lies under a point of the screen. */
    fun position(x: Float, y: Float): Position =
        Position(west + (x - left) / scale, south + (bottom - y) / scale)

    private companion object {
        /** A boat that has not moved yet is shown in 10 m of water, m. */
        const val SMALLEST_SPAN = 10.0
    }
}
