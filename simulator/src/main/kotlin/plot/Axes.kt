package stillwater.plot

import org.jetbrains.letsPlot.intern.Feature
import org.jetbrains.letsPlot.scale.scaleXContinuous
import org.jetbrains.letsPlot.scale.scaleXLog10
import org.jetbrains.letsPlot.scale.scaleYContinuous
import org.jetbrains.letsPlot.scale.scaleYLog10
import kotlin.math.abs
import kotlin.math.log10

/** The two axes of a figure: scales that the data allow, and the range they cover. */
internal class Axes private constructor(
    private val x: AxisScale,
    private val y: AxisScale,
    private val fromX: Double,
    private val toX: Double,
    private val fromY: Double,
    private val toY: Double,
) {
    fun showsX(value: Double) = shows(value, x)

    fun showsY(value: Double) = shows(value, y)

    /** Where along the axis [value] is drawn, as a share of its length. */
    fun placeX(value: Double): Double {
        val from = length(fromX, x)
        val span = length(toX, x) - from
        return if (span > 0) (length(value, x) - from) / span else 0.0
    }

    /** [value] moved onto the axis: a band that reaches below a logarithmic axis ends at its foot. NaN stays. */
    fun clampY(value: Double): Double = if (value.isNaN()) value else value.coerceIn(fromY, toY)

    /** The library's scales for these axes. */
    fun scales(xLabel: String, yLabel: String): Feature {
        val across = when (x) {
            AxisScale.LINEAR -> scaleXContinuous(name = xLabel, format = Ticks.format(fromX, toX))
            AxisScale.LOG10 -> Ticks.log(fromX, toX).let { scaleXLog10(name = xLabel, breaks = it.first, labels = it.second) }
        }
        val up = when (y) {
            AxisScale.LINEAR -> scaleYContinuous(name = yLabel, format = Ticks.format(fromY, toY))
            AxisScale.LOG10 -> Ticks.log(fromY, toY).let { scaleYLog10(name = yLabel, breaks = it.first, labels = it.second) }
        }
        return across + up
    }

    internal companion object {
        /** Closer points than this share of the axis (half a pixel) are one point to the eye. */
        const val SMALLEST_STEP = 1.0 / 1600

        private const val LARGEST = 1e300

        /** Axes that hold all that can be drawn of [strokes]; null if that is nothing. */
        fun around(strokes: List<Stroke>, wantedX: AxisScale, wantedY: AxisScale): Axes? {
            val x = wantedX.takeIf { scale -> strokes.any { s -> s.x.any { shows(it, scale) } } } ?: AxisScale.LINEAR
            val y = wantedY.takeIf { scale -> strokes.any { s -> s.y.any { shows(it, scale) } } } ?: AxisScale.LINEAR
            val xs = Extent()
            val ys = Extent()
            val band = Extent()
            for (stroke in strokes) for (i in stroke.x.indices) {
                if (!shows(stroke.x[i], x)) continue
                if (shows(stroke.y[i], y)) {
                    xs.add(stroke.x[i])
                    ys.add(stroke.y[i])
                }
                if (shows(stroke.lower[i], y)) band.add(stroke.lower[i])
                if (shows(stroke.upper[i], y)) band.add(stroke.upper[i])
            }
            if (xs.isEmpty) return null
            val foot = if (y == AxisScale.LOG10) maxOf(band.from, ys.from / BELOW) else band.from
            return Axes(x, y, xs.from, xs.to, minOf(ys.from, foot), maxOf(ys.to, band.to))
        }

        /** On a logarithmic axis a band is drawn down to this factor below the lowest line. */
        private const val BELOW = 3.0

        private fun shows(value: Double, scale: AxisScale) =
            abs(value) <= LARGEST && (scale == AxisScale.LINEAR || value > 0)

        private fun length(value: Double, scale: AxisScale) = if (scale == AxisScale.LOG10) log10(value) else value
    }

    private class Extent {
        var from = Double.POSITIVE_INFINITY
        var to = Double.NEGATIVE_INFINITY
        val isEmpty get() = from > to

        fun add(value: Double) {
            from = minOf(from, value)
            to = maxOf(to, value)
        }
    }
}
