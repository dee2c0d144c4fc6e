package stillwater.app.screen

import android.content.Context
import android.graphics.Canvas
import android.graphics.DashPathEffect
import android.graphics.Paint
import android.graphics.Path
import android.view.MotionEvent
import android.view.View
import stillwater.app.R
import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.Position

/**
 * The live map: cells coloured by what is believed, the fainter the less certain; track, plan, fence, home and boat.
 *
 * A cell that is tapped is outlined and told of: [onCell] gets its words, which are spoken too. Drawn anew only when a
 * scene comes or a finger does. Confined to the main thread.
 */
class MapView(context: Context) : View(context) {
    /** Takes what there is to say about a tapped cell. */
    var onCell: (String) -> Unit = {}

    /** What is drawn. */
    var scene: MapScene = MapScene()
        set(value) {
            field = value
            tapped = tapped?.takeIf { cell -> value.map?.let { cell < it.grid.size } == true }
            contentDescription = described(value)
            invalidate()
        }

    private var tapped: Int? = null
    private val density = resources.displayMetrics.density
    private val fill = Paint().apply { style = Paint.Style.FILL }
    private val line =
        Paint(Paint.ANTI_ALIAS_FLAG).apply {
            style = Paint.Style.STROKE
            strokeJoin = Paint.Join.ROUND
            strokeCap = Paint.Cap.ROUND
        }
    private val words = Paint(Paint.ANTI_ALIAS_FLAG).apply { textSize = resources.getDimension(R.dimen.map_text) }
    private val legend = ColourLegend(this)
    private val path = Path()
    private val dashes = DashPathEffect(floatArrayOf(8 * density, 6 * density), 0f)

    init {
        contentDescription = described(scene)
    }

    override fun onDraw(canvas: Canvas) {
        val projection = projection() ?: return drawNothing(canvas)
        scene.map?.let { map ->
            val range = measuredRange(map)
            drawCells(canvas, projection, map, range)
            range?.let { legend.draw(canvas, it, scene.unit) }
        }
        drawLine(canvas, projection, scene.fence, R.color.fence, FENCE_DP, closed = true)
        drawLine(canvas, projection, scene.track, R.color.track, TRACK_DP)
        drawLine(canvas, projection, listOfNotNull(scene.boat) + scene.plan, R.color.plan, PLAN_DP, dashed = true)
        tapped?.let { cell -> scene.map?.let { drawOutline(canvas, projection, it.grid, cell) } }
        scene.home?.let { drawHome(canvas, projection.x(it), projection.y(it)) }
        scene.boat?.let { drawBoat(canvas, projection.x(it), projection.y(it)) }
        drawScale(canvas, projection)
    }

    override fun onTouchEvent(event: MotionEvent): Boolean {
        if (event.action == MotionEvent.ACTION_UP) {
            tap(event.x, event.y)
            performClick()
        }
        return true
    }

    override fun performClick(): Boolean {
        super.performClick()
        return true
    }

    /** What is known of the cell at a point of the view; null where there is none. */
    internal fun tap(x: Float, y: Float): String? {
        val map = scene.map ?: return null
        val cell = map.grid.cellAt((projection() ?: return null).position(x, y))
        if (cell == Grid.OUTSIDE) return null
        tapped = cell
        invalidate()
        val said =
            if (map.readings(cell) == 0) {
                resources.getString(R.string.cell_not_measured, map.lower(cell), map.upper(cell), scene.unit)
            } else {
                resources.getQuantityString(
                    R.plurals.cell_measured,
                    map.readings(cell),
                    map.value(cell),
                    scene.unit,
                    map.lower(cell),
                    map.upper(cell),
                    map.readings(cell),
                )
            }
        announceForAccessibility(said)
        onCell(said)
        return said
    }

    private fun described(scene: MapScene): String {
        val map = scene.map ?: return resources.getString(R.string.map_empty_said)
        val measured = (0 until map.grid.size).count { map.readings(it) > 0 }
        return resources.getString(R.string.map_said, measured, map.grid.size)
    }

    private fun projection(): MapProjection? {
        val extent = scene.extent()
        if (extent.isEmpty() || width == 0 || height == 0) return null
        return MapProjection(extent, width.toFloat(), height.toFloat(), MARGIN_DP * density)
    }

    private fun drawNothing(canvas: Canvas) {
        words.color = context.getColor(R.color.quiet_text)
        words.textAlign = Paint.Align.CENTER
        canvas.drawText(resources.getString(R.string.map_empty), width / 2f, height / 2f, words)
    }

    /** The least and the greatest value of a measured cell, which the colours span; null before the first. */
    private fun measuredRange(map: FieldMap): Interval? {
        var low = Double.POSITIVE_INFINITY
        var high = Double.NEGATIVE_INFINITY
        for (cell in 0 until map.grid.size) {
            if (map.readings(cell) == 0 || !map.value(cell).isFinite()) continue
            low = minOf(low, map.value(cell))
            high = maxOf(high, map.value(cell))
        }
        return if (low <= high) Interval(low, high) else null
    }

    private fun drawCells(canvas: Canvas, projection: MapProjection, map: FieldMap, range: Interval?) {
        for (cell in 0 until map.grid.size) {
            if (map.readings(cell) == 0 && map.lower(cell) <= map.prior.lower && map.upper(cell) >= map.prior.upper) {
                // Nothing is known of it: its outline alone.
                outline(projection, map.grid, cell)
                stroke(R.color.line, HAIR_DP)
                canvas.drawPath(path, line)
                continue
            }
            // One measured value alone sits in the middle.
            val share = range?.takeIf { it.width > 0 }?.let { (map.value(cell) - it.lower) / it.width } ?: MIDDLE
            val certainty = 1 - (map.upper(cell) - map.lower(cell)) / map.prior.width
            fill.color = FieldColours.faded(FieldColours.of(share), certainty)
            outline(projection, map.grid, cell)
            canvas.drawPath(path, fill)
        }
    }

    private fun outline(projection: MapProjection, grid: Grid, cell: Int) {
        path.rewind()
        grid.corners(cell).forEachIndexed { index, corner ->
            val (x, y) = projection.x(corner) to projection.y(corner)
            if (index == 0) path.moveTo(x, y) else path.lineTo(x, y)
        }
        path.close()
    }

    private fun drawOutline(canvas: Canvas, projection: MapProjection, grid: Grid, cell: Int) {
        outline(projection, grid, cell)
        stroke(R.color.text, TAPPED_DP)
        canvas.drawPath(path, line)
    }

    private fun drawLine(
        canvas: Canvas,
        projection: MapProjection,
        positions: List<Position>,
        colour: Int,
        widthDp: Float,
        closed: Boolean = false,
        dashed: Boolean = false,
    ) {
        if (positions.size < 2) return
        path.rewind()
        positions.forEachIndexed { index, position ->
            val (x, y) = projection.x(position) to projection.y(position)
            if (index == 0) path.moveTo(x, y) else path.lineTo(x, y)
        }
        if (closed) path.close()
        if (colour == R.color.track) {
            // On dark cells as on light ones.
            stroke(R.color.ground, widthDp + HALO_DP)
            canvas.drawPath(path, line)
        }
        stroke(colour, widthDp)
        line.pathEffect = if (dashed) dashes else null
        canvas.drawPath(path, line)
        line.pathEffect = null
    }

    private fun stroke(colour: Int, widthDp: Float) {
        line.color = context.getColor(colour)
        line.strokeWidth = widthDp * density
    }

    private fun drawHome(canvas: Canvas, x: Float, y: Float) {
        val r = MARK_DP * density
        path.rewind()
        path.moveTo(x - r, y)
        path.lineTo(x, y - r)
        path.lineTo(x + r, y)
        path.moveTo(x - MARK_WALL * r, y)
        path.lineTo(x - MARK_WALL * r, y + r)
        path.lineTo(x + MARK_WALL * r, y + r)
        path.lineTo(x + MARK_WALL * r, y)
        stroke(R.color.ground, HOME_DP + HALO_DP)
        canvas.drawPath(path, line)
        stroke(R.color.text, HOME_DP)
        canvas.drawPath(path, line)
    }

    private fun drawBoat(canvas: Canvas, x: Float, y: Float) {
        val r = MARK_DP * density
        canvas.save()
        canvas.rotate(scene.headingDeg ?: 0f, x, y)
        path.rewind()
        path.moveTo(x, y - BOW * r)
        path.lineTo(x + r, y + r)
        path.lineTo(x, y + r / 2)
        path.lineTo(x - r, y + r)
        path.close()
        fill.color = context.getColor(R.color.boat)
        canvas.drawPath(path, fill)
        stroke(R.color.ground, 1f)
        canvas.drawPath(path, line)
        canvas.restore()
    }

    /** A length that is easy to say, drawn to scale: 1, 2 or 5 times a power of ten. */
    private fun drawScale(canvas: Canvas, projection: MapProjection) {
        val widest = width * SCALE_SHARE / projection.scale
        val metres = roundLengths.last { it <= widest.coerceAtLeast(roundLengths.first()) }
        val (left, y) = MARGIN_DP * density to height - MARGIN_DP * density / 2
        stroke(R.color.text, TRACK_DP)
        canvas.drawLine(left, y, left + metres * projection.scale, y, line)
        words.color = context.getColor(R.color.text)
        words.textAlign = Paint.Align.LEFT
        val text =
            if (metres < 1) {
                resources.getString(R.string.centimetres, (metres * CENTIMETRES).toInt())
            } else {
                resources.getString(R.string.metres, metres.toInt())
            }
        canvas.drawText(text, left, y - 4 * density, words)
    }

    private companion object {
        const val MARGIN_DP = 28f
        const val HAIR_DP = 0.5f
        const val TRACK_DP = 2f
        const val PLAN_DP = 3f
        const val FENCE_DP = 2.5f
        const val TAPPED_DP = 3f
        const val HOME_DP = 2f
        const val HALO_DP = 2f
        const val MARK_DP = 10f
        const val MARK_WALL = 0.65f
        const val BOW = 1.5f
        const val MIDDLE = 0.5
        const val SCALE_SHARE = 0.3f
        const val CENTIMETRES = 100
        val roundLengths =
            listOf(0.1f, 0.2f, 0.5f, 1f, 2f, 5f, 10f, 20f, 50f, 100f, 200f, 500f, 1000f, 2000f, 5000f, 10_000f)
    }
}
