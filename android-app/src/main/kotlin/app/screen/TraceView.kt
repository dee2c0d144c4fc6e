package stillwater.app.screen

import android.content.Context
import android.graphics.Canvas
import android.graphics.DashPathEffect
import android.graphics.Paint
import android.graphics.Path
import android.view.View
import stillwater.app.R
import java.util.Locale
import kotlin.math.abs
import kotlin.math.ceil
import kotlin.math.floor
import kotlin.math.log10
import kotlin.math.pow

/**
 * The last minutes: readings, and what is believed of each cell that was crossed, with its bounds; below, the gradient of
 * the readings.
 *
 * Newest at the right. Confined to the main thread.
 */
internal class TraceView(context: Context) : View(context) {
    /** What is drawn. */
    var scene = TraceScene()
        set(value) {
            field = value
            val said = described(value)
            if (contentDescription != said) contentDescription = said
            invalidate()
        }

    private val density = resources.displayMetrics.density
    private val line = Paint(Paint.ANTI_ALIAS_FLAG).apply { style = Paint.Style.STROKE }
    private val fill = Paint(Paint.ANTI_ALIAS_FLAG).apply { style = Paint.Style.FILL }
    private val words = Paint(Paint.ANTI_ALIAS_FLAG).apply { textSize = resources.getDimension(R.dimen.map_text) }
    private val dashes = DashPathEffect(floatArrayOf(6 * density, 4 * density), 0f)
    private val path = Path()

    init {
        contentDescription = described(scene)
        minimumHeight = (LEAST_HEIGHT * words.textSize).toInt()
    }

    override fun onDraw(canvas: Canvas) {
        val moments = scene.moments
        if (moments.none { it.reading.isFinite() }) {
            words.color = context.getColor(R.color.quiet_text)
            words.textAlign = Paint.Align.CENTER
            canvas.drawText(resources.getString(R.string.trace_empty), width / 2f, height / 2f, words)
            return
        }
        val span = moments.last().seconds - moments.first().seconds
        val time = Axis(moments.last().seconds - maxOf(span, LEAST_SPAN), moments.last().seconds)
        val text = words.textSize
        val bottom = height - text - 2 * GAP_DP * density
        // Where there is little room the gradient is left to the words above.
        val isLow = height < LEAST_LINES * text
        val middle = if (isLow) bottom + text else text + (bottom - text) * UPPER_SHARE
        val valueTicks = ((middle - 3 * text) / (ROOM_A_TICK * text)).toInt().coerceIn(1, VALUE_TICKS)
        val seen = moments.flatMap { listOf(it.reading, it.corrected) } + boundsInSight(moments)
        val values = Axis.round(seen, valueTicks)
        val slopes = Axis.round(moments.map { it.gradient } + listOf(0.0), SLOPE_TICKS)
        val ticks = (values.ticks() + slopes.ticks()).map { (_, words) -> words }
        val left = EDGE_DP * density + ticks.maxOf { words.measureText(it) }
        val upper = Panel(left, 2 * text, width - GAP_DP * density, middle - text, time, values)
        drawValues(canvas, upper, moments)
        if (isLow) return drawTimes(canvas, upper)
        val lower = Panel(left, middle + text, width - GAP_DP * density, bottom, time, slopes)
        drawFrame(canvas, lower, resources.getString(R.string.trace_gradient, context.perSecond(scene.unit)))
        drawLine(canvas, lower, moments, R.color.text) { it.gradient }
        drawTimes(canvas, lower)
    }

    /** Bounds far off would flatten what is between them: they are in sight as far as the readings' range thrice. */
    private fun boundsInSight(moments: List<TraceMoment>): List<Double> {
        val seen = moments.flatMap { listOf(it.reading, it.corrected) }.filter { it.isFinite() }
        val (low, high) = seen.min() to seen.max()
        val room = maxOf(high - low, abs(high) * LEAST_ROOM)
        return moments.flatMap { listOf(it.lower, it.upper) }.filter { it > low - room && it < high + room }
    }

    private fun drawValues(canvas: Canvas, panel: Panel, moments: List<TraceMoment>) {
        val title =
            if (scene.unit.isEmpty()) {
                resources.getString(R.string.trace_values_without_unit)
            } else {
                resources.getString(R.string.trace_values, scene.unit)
            }
        drawFrame(canvas, panel, title)
        canvas.save()
        canvas.clipRect(panel.left, panel.top, panel.right, panel.bottom)
        val known = scene.settled.filter { it.lower.isFinite() && it.upper.isFinite() }
        path.rewind()
        known.forEachIndexed { index, moment ->
            val x = panel.x(moment)
            if (index == 0) path.moveTo(x, panel.y(moment.upper)) else path.lineTo(x, panel.y(moment.upper))
        }
        known.asReversed().forEach { path.lineTo(panel.x(it), panel.y(it.lower)) }
        fill.color = context.getColor(R.color.band)
        canvas.drawPath(path, fill)
        drawLine(canvas, panel, moments, R.color.text) { it.reading }
        line.pathEffect = dashes
        drawLine(canvas, panel, scene.settled, R.color.plan) { it.corrected }
        line.pathEffect = null
        canvas.restore()
    }

    private fun drawLine(
        canvas: Canvas,
        panel: Panel,
        moments: List<TraceMoment>,
        colour: Int,
        value: (TraceMoment) -> Double,
    ) {
        path.rewind()
        var isDown = false
        for (moment in moments) {
            val y = value(moment)
            // A gap stays a gap.
            if (!y.isFinite()) {
                isDown = false
            } else if (isDown) {
                path.lineTo(panel.x(moment), panel.y(y))
            } else {
                path.moveTo(panel.x(moment), panel.y(y))
                isDown = true
            }
        }
        line.color = context.getColor(colour)
        line.strokeWidth = LINE_DP * density
        canvas.drawPath(path, line)
    }

    private fun drawFrame(canvas: Canvas, panel: Panel, title: String) {
        words.color = context.getColor(R.color.text)
        words.textAlign = Paint.Align.LEFT
        canvas.drawText(title, panel.left, panel.top - GAP_DP * density, words)
        words.textAlign = Paint.Align.RIGHT
        line.color = context.getColor(R.color.line)
        line.strokeWidth = HAIR_DP * density
        for ((tick, text) in panel.value.ticks()) {
            val y = panel.y(tick)
            canvas.drawLine(panel.left, y, panel.right, y, line)
            canvas.drawText(text, panel.left - GAP_DP * density, y + words.textSize / 3, words)
        }
    }

    private fun drawTimes(canvas: Canvas, panel: Panel) {
        val baseline = panel.bottom + words.textSize + GAP_DP * density
        words.textAlign = Paint.Align.LEFT
        val ago = context.duration(panel.time.high - panel.time.low)
        val since = resources.getString(R.string.trace_ago, ago)
        canvas.drawText(since, panel.left, baseline, words)
        words.textAlign = Paint.Align.RIGHT
        // Where there is room beside the other end; which is newer is seen by that end, too.
        val now = resources.getString(R.string.trace_now)
        if (words.measureText(since) + words.measureText(now) + words.textSize > panel.right - panel.left) return
        canvas.drawText(now, panel.right, baseline, words)
    }

    private fun described(scene: TraceScene): String {
        val last =
            scene.moments.lastOrNull { it.reading.isFinite() } ?: return resources.getString(R.string.trace_empty)
        val span = context.duration(last.seconds - scene.moments.first().seconds)
        return resources.getString(R.string.trace_said, span)
    }

    /** A range of numbers along an edge, with a mark every [step]. */
    private class Axis(val low: Double, val high: Double, private val step: Double = high - low) {
        /** Where a number is written, and how: with as many digits as tell it from the next. */
        fun ticks(): List<Pair<Double, String>> {
            val digits = maxOf(0, -floor(log10(step) + ROUNDING).toInt())
            val first = Math.round(low / step)
            val last = Math.round(high / step)
            return (first..last).map { it * step to String.format(Locale.getDefault(), "%.${digits}f", it * step) }
        }

        companion object {
            /** From a round number below [values] to one above them, in [count] steps or so. */
            fun round(values: List<Double>, count: Int): Axis {
                val known = values.filter { it.isFinite() }
                if (known.isEmpty()) return Axis(-1.0, 1.0, 1.0)
                val (low, high) = known.min() to known.max()
                val spread = maxOf(high - low, abs(high) * LEAST_ROOM, LEAST_ROOM)
                val raw = spread / count
                val power = 10.0.pow(floor(log10(raw)))
                val step = power * (listOf(1.0, 2.0, 5.0).firstOrNull { it * power >= raw } ?: 10.0)
                val lowest = floor(low / step + ROUNDING) * step
                return Axis(lowest, maxOf(ceil(high / step - ROUNDING) * step, lowest + step), step)
            }

            private const val ROUNDING = 1e-9
            private const val LEAST_ROOM = 1e-3
        }
    }

    private class Panel(
        val left: Float,
        val top: Float,
        val right: Float,
        val bottom: Float,
        val time: Axis,
        val value: Axis,
    ) {
        fun x(moment: TraceMoment): Float =
            left + ((moment.seconds - time.low) / (time.high - time.low)).toFloat() * (right - left)

        fun y(value: Double): Float =
            bottom - ((value - this.value.low) / (this.value.high - this.value.low)).toFloat() * (bottom - top)
    }

    private companion object {
        const val EDGE_DP = 14f
        const val GAP_DP = 6f
        const val LINE_DP = 2.5f
        const val HAIR_DP = 0.75f
        const val UPPER_SHARE = 0.66f

        /** Lines of text that the upper curve needs. */
        const val LEAST_HEIGHT = 9

        /** Lines of text that both curves together need. */
        const val LEAST_LINES = 14
        const val ROOM_A_TICK = 1.6f

        /** Shorter, a trace would move too fast to be read, s. */
        const val LEAST_SPAN = 30.0
        const val VALUE_TICKS = 5
        const val SLOPE_TICKS = 2
        const val LEAST_ROOM = 1e-3
    }
}
