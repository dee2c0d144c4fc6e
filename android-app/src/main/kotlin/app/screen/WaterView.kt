package stillwater.app.screen

import android.content.Context
import android.graphics.Canvas
import android.graphics.DashPathEffect
import android.graphics.Paint
import android.graphics.Path
import android.os.Bundle
import android.os.Parcelable
import android.view.GestureDetector
import android.view.MotionEvent
import android.view.ScaleGestureDetector
import android.view.View
import stillwater.app.R
import stillwater.model.Position

/**
 * A piece of water seen from above, which can be moved with a finger, and zoomed with two or by buttons.
 *
 * Shows all there is until someone moves it, or follows the boat. What is in sight outlives a turn of the phone.
 * Confined to the main thread.
 */
internal abstract class WaterView(context: Context) : View(context) {
    protected val density = resources.displayMetrics.density
    protected val fill = Paint(Paint.ANTI_ALIAS_FLAG).apply { style = Paint.Style.FILL }
    protected val line =
        Paint(Paint.ANTI_ALIAS_FLAG).apply {
            style = Paint.Style.STROKE
            strokeJoin = Paint.Join.ROUND
            strokeCap = Paint.Cap.ROUND
        }
    protected val words =
        Paint(Paint.ANTI_ALIAS_FLAG).apply { textSize = resources.getDimension(R.dimen.map_text) }
    protected val path = Path()
    private val dashes = DashPathEffect(floatArrayOf(8 * density, 6 * density), 0f)

    /** What was chosen to be seen: the middle and the scale; null for all there is. */
    private var held: Pair<Position, Float>? = null

    /** Called when a finger has moved what is in sight. */
    var onMoved: () -> Unit = {}

    /** Whether the boat is kept in the middle. */
    var isFollowing = false
        set(value) {
            val now = projection()
            field = value
            // What is in sight stays, or comes along.
            if (now != null && (value || held != null)) held = now.centre to now.scale
            invalidate()
        }

    /** All that there is to see. */
    protected abstract fun extent(): List<Position>

    /** Where the boat is, m; null where not known. */
    protected abstract fun boat(): Position?

    /** A finger touched [position]; [reach] is how far off it may have been meant, m. */
    internal abstract fun touched(position: Position, reach: Double)

    /** How the local frame lies on the view now; null before there is anything to see. */
    internal fun projection(): MapProjection? {
        if (width == 0 || height == 0) return null
        val held = this.held
        if (held != null) {
            val centre = boat().takeIf { isFollowing } ?: held.first
            return MapProjection(centre, held.second, width.toFloat(), height.toFloat())
        }
        val extent = extent()
        if (extent.isEmpty()) return null
        return MapProjection.fitting(extent, width.toFloat(), height.toFloat(), MARGIN_DP * density, foot(), head())
    }

    /** What is kept free of it at the upper edge beside the margin, px. */
    protected open fun head() = 0f

    /** What is kept free of the water at the lower edge, for scale and legend, px. */
    private fun foot() = words.textSize + FOOT_DP * density

    /** Shows all there is again. */
    fun showAll() {
        isFollowing = false
        held = null
        invalidate()
    }

    /** Brings [factor] times closer. */
    fun zoom(factor: Float) = zoom(factor, width / 2f, height / 2f)

    private fun zoom(factor: Float, focusX: Float, focusY: Float) {
        val now = projection() ?: return
        val under = now.position(focusX, focusY)
        val scale = (now.scale * factor).coerceIn(SMALLEST_SCALE, LARGEST_SCALE)
        // What is under the fingers stays there.
        val share = now.scale / scale
        val centre =
            Position(
                under.x + (now.centre.x - under.x) * share,
                under.y + (now.centre.y - under.y) * share,
            )
        held = centre to scale
        invalidate()
    }

    private val scaling =
        ScaleGestureDetector(
            context,
            object : ScaleGestureDetector.SimpleOnScaleGestureListener() {
                override fun onScale(detector: ScaleGestureDetector): Boolean {
                    zoom(detector.scaleFactor, detector.focusX, detector.focusY)
                    return true
                }
            },
        )

    private val moving =
        GestureDetector(
            context,
            object : GestureDetector.SimpleOnGestureListener() {
                override fun onDown(e: MotionEvent): Boolean = true

                override fun onSingleTapUp(e: MotionEvent): Boolean {
                    val now = projection() ?: return true
                    touched(now.position(e.x, e.y), (REACH_DP * density / now.scale).toDouble())
                    performClick()
                    return true
                }

                override fun onScroll(from: MotionEvent?, to: MotionEvent, dx: Float, dy: Float): Boolean {
                    val now = projection() ?: return true
                    isFollowing = false
                    held = now.centre.moved((dx / now.scale).toDouble(), (-dy / now.scale).toDouble()) to now.scale
                    onMoved()
                    invalidate()
                    return true
                }
            },
        )

    override fun onTouchEvent(event: MotionEvent): Boolean {
        // A screen that scrolls keeps its hands off what is moved here.
        if (event.actionMasked == MotionEvent.ACTION_DOWN) parent?.requestDisallowInterceptTouchEvent(true)
        scaling.onTouchEvent(event)
        if (!scaling.isInProgress) moving.onTouchEvent(event)
        return true
    }

    override fun performClick(): Boolean {
        super.performClick()
        return true
    }

    override fun onSaveInstanceState(): Parcelable =
        Bundle().apply {
            putParcelable(ABOVE, super.onSaveInstanceState())
            held?.let { (centre, scale) ->
                putDoubleArray(HELD, doubleArrayOf(centre.x, centre.y, (scale / density).toDouble()))
            }
            putBoolean(FOLLOWING, isFollowing)
        }

    override fun onRestoreInstanceState(state: Parcelable?) {
        if (state !is Bundle) return super.onRestoreInstanceState(state)
        @Suppress("DEPRECATION") // the call that replaces it is Android 13's
        super.onRestoreInstanceState(state.getParcelable(ABOVE))
        isFollowing = state.getBoolean(FOLLOWING)
        held = state.getDoubleArray(HELD)?.let { Position(it[0], it[1]) to (it[2] * density).toFloat() }
    }

    protected fun stroke(colour: Int, widthDp: Float) {
        line.color = context.getColor(colour)
        line.strokeWidth = widthDp * density
        line.pathEffect = null
    }

    /** [positions] joined by a line; a halo shows it on dark cells as on light ones. */
    protected fun drawLine(
        canvas: Canvas,
        projection: MapProjection,
        positions: List<Position>,
        style: LineStyle,
    ) {
        if (positions.size < 2) return
        trace(projection, positions, style.isClosed)
        if (style.hasHalo) {
            stroke(R.color.ground, style.widthDp + HALO_DP)
            canvas.drawPath(path, line)
        }
        stroke(style.colour, style.widthDp)
        line.pathEffect = if (style.isDashed) dashes else null
        canvas.drawPath(path, line)
        line.pathEffect = null
    }

    /** Makes [path] the way along [positions]. */
    protected fun trace(projection: MapProjection, positions: List<Position>, isClosed: Boolean) {
        path.rewind()
        positions.forEachIndexed { index, position ->
            val (x, y) = projection.x(position) to projection.y(position)
            if (index == 0) path.moveTo(x, y) else path.lineTo(x, y)
        }
        if (isClosed) path.close()
    }

    protected fun drawHome(canvas: Canvas, x: Float, y: Float) {
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

    protected fun drawBoat(canvas: Canvas, x: Float, y: Float, headingDeg: Float?) {
        val r = MARK_DP * density
        canvas.save()
        canvas.rotate(headingDeg ?: 0f, x, y)
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
    protected fun drawScale(canvas: Canvas, projection: MapProjection) {
        val metres = roundLength(width * SCALE_SHARE / projection.scale)
        val (left, y) = EDGE_DP * density to height - EDGE_DP * density
        val right = left + metres * projection.scale
        stroke(R.color.ground, SCALE_DP + HALO_DP)
        canvas.drawLine(left, y, right, y, line)
        stroke(R.color.text, SCALE_DP)
        canvas.drawLine(left, y, right, y, line)
        words.textAlign = Paint.Align.LEFT
        val text =
            if (metres < 1) {
                resources.getString(R.string.centimetres, (metres * CENTIMETRES).toInt())
            } else {
                resources.getString(R.string.metres, metres.toInt())
            }
        drawWords(canvas, text, left, y - WORDS_GAP_DP * density)
    }

    /** [text] that can be read on any cell: with an edge of the ground's colour. */
    protected fun drawWords(canvas: Canvas, text: String, x: Float, y: Float) {
        words.style = Paint.Style.STROKE
        words.strokeWidth = WORDS_EDGE_DP * density
        words.color = context.getColor(R.color.ground)
        canvas.drawText(text, x, y, words)
        words.style = Paint.Style.FILL
        words.color = context.getColor(R.color.text)
        canvas.drawText(text, x, y, words)
    }

    /** The largest round length, m, that is at most [widest]. */
    protected fun roundLength(widest: Float): Float =
        roundLengths.lastOrNull { it <= widest } ?: roundLengths.first()

    protected fun drawNothing(canvas: Canvas, text: Int) {
        words.color = context.getColor(R.color.quiet_text)
        words.textAlign = Paint.Align.CENTER
        canvas.drawText(resources.getString(text), width / 2f, height / 2f, words)
    }

    protected companion object {
        private const val MARGIN_DP = 24f
        private const val HALO_DP = 2f
        private const val FOOT_DP = 14f
        private const val MARK_DP = 10f
        private const val MARK_WALL = 0.65f
        private const val HOME_DP = 2f
        private const val BOW = 1.5f
        private const val EDGE_DP = 12f
        private const val SCALE_DP = 2f
        private const val WORDS_GAP_DP = 6f
        private const val WORDS_EDGE_DP = 3f
        private const val SCALE_SHARE = 0.3f
        private const val CENTIMETRES = 100

        /** A gloved finger hits this close to what it means. */
        private const val REACH_DP = 28f

        /** Pixels a metre: a lake of a hundred kilometres, and a hand's breadth. */
        private const val SMALLEST_SCALE = 0.005f
        private const val LARGEST_SCALE = 5_000f
        private const val ABOVE = "above"
        private const val HELD = "held"
        private const val FOLLOWING = "following"
        private val roundLengths =
            listOf(0.1f, 0.2f, 0.5f, 1f, 2f, 5f, 10f, 20f, 50f, 100f, 200f, 500f, 1000f, 2000f, 5000f, 10_000f, 20_000f)
    }
}

/** How a line on the water looks. */
internal class LineStyle(
    val colour: Int,
    val widthDp: Float,
    val isClosed: Boolean = false,
    val isDashed: Boolean = false,
    val hasHalo: Boolean = false,
)
