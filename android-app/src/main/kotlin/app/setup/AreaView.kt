package stillwater.app.setup

import android.content.Context
import android.graphics.Canvas
import android.graphics.Paint
import stillwater.app.R
import stillwater.app.screen.LineStyle
import stillwater.app.screen.MapProjection
import stillwater.app.screen.WaterView
import stillwater.mission.GridSpec
import stillwater.mission.MissionDraft
import stillwater.mission.PlaceSpec
import stillwater.model.Position
import kotlin.math.floor
import kotlin.math.hypot

/**
 * The water as it is being drawn: a metric grid, the shore, keep-outs, home and where the phone is. There is no map
 * behind it, for there may be no network.
 *
 * @param onPlace called with a touched place of the water.
 * @param onCorner called with a touched corner.
 */
internal class AreaView(
    context: Context,
    private val onPlace: (Position) -> Unit,
    private val onCorner: (Corner) -> Unit,
) : WaterView(context) {
    private var draft = MissionDraft()
    private var pen = AreaPen()
    private var grid: GridSpec? = null
    private var here: Position? = null
    private var accuracy = 0f

    /** Shows [draft], of which [grid] is laid over the water, and the phone at [here], known to [accuracy] m. */
    fun show(draft: MissionDraft, pen: AreaPen, grid: GridSpec?, here: Position?, accuracy: Float) {
        this.draft = draft
        this.pen = pen
        this.grid = grid
        this.here = here
        this.accuracy = accuracy
        val said = resources.getString(R.string.area_said, draft.shore.size, draft.keepOuts.size)
        if (contentDescription != said) contentDescription = said
        invalidate()
    }

    override fun extent(): List<Position> {
        val drawn = (draft.shore + draft.keepOuts.flatten() + listOfNotNull(draft.home)).map { it.position }
        val near = here?.takeIf { at -> drawn.all { it.distanceTo(at) < FAR } }
        val all = drawn + listOfNotNull(near)
        if (all.size > 1 || all.isEmpty()) return all
        // Around the first place, room for what comes next.
        return listOf(all.single().moved(-FIRST_SPAN, -FIRST_SPAN), all.single().moved(FIRST_SPAN, FIRST_SPAN))
    }

    /** A corner's number stands beyond it. */
    override fun head() = words.textSize

    override fun boat(): Position? = here

    override fun touched(position: Position, reach: Double) {
        val corner = pen.cornerNear(draft, position, reach)
        if (corner != null) onCorner(corner) else onPlace(position)
    }

    override fun onDraw(canvas: Canvas) {
        val projection = projection() ?: return drawNothing(canvas, R.string.area_empty)
        drawMetres(canvas, projection)
        grid?.let { drawCells(canvas, projection, it) }
        drawLine(canvas, projection, shore(), LineStyle(R.color.fence, OUTLINE_DP, isClosed = true))
        val keepOut = LineStyle(R.color.fence, OUTLINE_DP, isClosed = true, isDashed = true)
        for (ring in draft.keepOuts) drawLine(canvas, projection, ring.map { it.position }, keepOut)
        drawCorners(canvas, projection, draft.shore, ring = -1)
        draft.keepOuts.forEachIndexed { ring, places -> drawCorners(canvas, projection, places, ring) }
        drawNumbers(canvas, projection, draft.shore)
        draft.home?.position?.let { drawHome(canvas, projection.x(it), projection.y(it)) }
        here?.let { drawHere(canvas, projection, it) }
        drawScale(canvas, projection)
    }

    /** The outline of the water; of a rectangle all four corners. */
    private fun shore(): List<Position> {
        val places = draft.shore.map { it.position }
        if (!draft.isRectangle || places.size < 2) return places
        val (one, other) = places
        return listOf(one, Position(other.x, one.y), other, Position(one.x, other.y))
    }

    /** Lines a round length apart, which is written at the scale. */
    private fun drawMetres(canvas: Canvas, projection: MapProjection) {
        val step = roundLength(width * GRID_SHARE / projection.scale).toDouble()
        val (west, north) = projection.position(0f, 0f).let { it.x to it.y }
        val (east, south) = projection.position(width.toFloat(), height.toFloat()).let { it.x to it.y }
        stroke(R.color.line, HAIR_DP)
        var x = floor(west / step) * step
        while (x <= east) {
            val at = projection.x(Position(x, 0.0))
            canvas.drawLine(at, 0f, at, height.toFloat(), line)
            x += step
        }
        var y = floor(south / step) * step
        while (y <= north) {
            val at = projection.y(Position(0.0, y))
            canvas.drawLine(0f, at, width.toFloat(), at, line)
            y += step
        }
    }

    private fun drawCells(canvas: Canvas, projection: MapProjection, grid: GridSpec) {
        // Closer than a finger's breadth of lines is grey and says nothing.
        if (grid.cell * projection.scale < LEAST_CELL_DP * density) return
        stroke(R.color.plan, HAIR_DP)
        val west = projection.x(grid.southWest.position)
        val south = projection.y(grid.southWest.position)
        val side = (grid.cell * projection.scale).toFloat()
        val (east, north) = west + grid.columns * side to south - grid.rows * side
        for (column in 0..grid.columns) canvas.drawLine(west + column * side, south, west + column * side, north, line)
        for (row in 0..grid.rows) canvas.drawLine(west, south - row * side, east, south - row * side, line)
    }

    private fun drawCorners(canvas: Canvas, projection: MapProjection, places: List<PlaceSpec>, ring: Int) {
        places.forEachIndexed { index, place ->
            val (x, y) = projection.x(place.position) to projection.y(place.position)
            val isSelected = pen.selected == Corner(ring, index)
            fill.color = context.getColor(if (isSelected) R.color.plan else R.color.fence)
            val size =
                when {
                    isSelected -> SELECTED_DP
                    ring < 0 -> CORNER_DP
                    else -> SMALL_CORNER_DP
                }
            canvas.drawCircle(x, y, size * density, fill)
        }
    }

    /** Of the shore's corners, on land: the water beside them has home, boat and cells. A keep-out's would hide it. */
    private fun drawNumbers(canvas: Canvas, projection: MapProjection, places: List<PlaceSpec>) {
        if (places.isEmpty()) return
        val middleX = projection.x(Position(places.sumOf { it.x } / places.size, 0.0))
        val middleY = projection.y(Position(0.0, places.sumOf { it.y } / places.size))
        words.textAlign = Paint.Align.CENTER
        places.forEachIndexed { index, place ->
            val (x, y) = projection.x(place.position) to projection.y(place.position)
            val far = hypot(x - middleX, y - middleY)
            // A single corner has its number above it.
            val (right, down) = if (far < 1f) 0f to -1f else (x - middleX) / far to (y - middleY) / far
            val away = LABEL_DP * density
            val at = (x + right * away).coerceIn(words.textSize / 2, maxOf(words.textSize, width - words.textSize / 2))
            drawWords(canvas, "${index + 1}", at, y + down * away + words.textSize / 3)
        }
    }

    private fun drawHere(canvas: Canvas, projection: MapProjection, at: Position) {
        val (x, y) = projection.x(at) to projection.y(at)
        stroke(R.color.boat, OUTLINE_DP)
        canvas.drawCircle(x, y, accuracy * projection.scale, line)
        drawBoat(canvas, x, y, headingDeg = null)
    }

    private companion object {
        const val OUTLINE_DP = 2.5f
        const val HAIR_DP = 0.75f
        const val CORNER_DP = 8f
        const val SMALL_CORNER_DP = 5f
        const val SELECTED_DP = 13f
        const val LABEL_DP = 20f
        const val LEAST_CELL_DP = 5f
        const val GRID_SHARE = 0.2f

        /** What is farther away than this from what is drawn is another water, m. */
        const val FAR = 5_000.0

        /** To each side of the first place, m. */
        const val FIRST_SPAN = 50.0
    }
}
