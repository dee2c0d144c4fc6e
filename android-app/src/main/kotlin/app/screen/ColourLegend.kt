package stillwater.app.screen

import android.graphics.Canvas
import android.graphics.LinearGradient
import android.graphics.Paint
import android.graphics.Shader
import android.view.View
import stillwater.app.R
import stillwater.model.Interval

/** What the map's colours mean: a bar at the lower right with the values at its ends. */
internal class ColourLegend(private val view: View) {
    private val density = view.resources.displayMetrics.density
    private val bar = Paint()
    private val words =
        Paint(Paint.ANTI_ALIAS_FLAG).apply { textSize = view.resources.getDimension(R.dimen.map_text) }
    private val colours = IntArray(STEPS) { FieldColours.of(it / (STEPS - 1.0)) }

    fun draw(canvas: Canvas, range: Interval, unit: String) {
        val right = view.width - EDGE_DP * density
        val (lower, upper) =
            view.resources.run {
                getString(R.string.legend_end, range.lower, "").trim() to
                    getString(R.string.legend_end, range.upper, unit).trim()
            }
        val both = words.measureText(lower) + words.measureText(upper) + words.textSize
        val left = right - maxOf(LENGTH_DP * density, both)
        val bottom = view.height - EDGE_DP * density / 2
        val top = bottom - HEIGHT_DP * density
        bar.shader = LinearGradient(left, 0f, right, 0f, colours, null, Shader.TileMode.CLAMP)
        canvas.drawRect(left, top, right, bottom, bar)
        words.color = view.context.getColor(R.color.text)
        words.textAlign = Paint.Align.LEFT
        val baseline = top - GAP_DP * density
        canvas.drawText(lower, left, baseline, words)
        words.textAlign = Paint.Align.RIGHT
        canvas.drawText(upper, right, baseline, words)
    }

    private companion object {
        const val STEPS = 33
        const val EDGE_DP = 16f
        const val LENGTH_DP = 170f
        const val HEIGHT_DP = 14f
        const val GAP_DP = 4f
    }
}
