package stillwater.plot

import org.jetbrains.letsPlot.intern.Feature
import org.jetbrains.letsPlot.scale.scaleXContinuous
import org.jetbrains.letsPlot.scale.scaleYContinuous
import kotlin.math.abs
import kotlin.math.log10
import kotlin.math.pow

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
        val (left, right) = widened(fromX, toX, x, AT_SIDES)
        val (foot, top) = widened(fromY, toY, y, ABOVE_AND_BELOW)
        val across = ticks(left, right, x, ACROSS)
        val up = ticks(foot, top, y, UP)
        return scaleXContinuous(
            name = xLabel,
            breaks = across.places,
            labels = across.labels,
            limits = left to right,
            expand = NO_MORE,
            trans = transform(x),
        ) + scaleYContinuous(
            name = yLabel,
            breaks = up.places,
            labels = up.labels,
            limits = foot to top,
            expand = NO_MORE,
            trans = transform(y),
        )
    }

    private fun transform(scale: AxisScale) = if (scale == AxisScale.LOG10) "log10" else null

    private fun ticks(from: Double, to: Double, scale: AxisScale, most: Int) =
        if (scale == AxisScale.LOG10) Ticks.log(from, to, most) else Ticks.linear(from, to, most)

    /** The range with [share] of its length added at either end; a single value gets room around it. */
    private fun widened(from: Double, to: Double, scale: AxisScale, share: Double): Pair<Double, Double> {
        val low = length(from, scale)
        val high = length(to, scale)
        val size = maxOf(abs(low), abs(high))
        val room = when {
            high - low > size * SAME -> (high - low) * share
            scale == AxisScale.LOG10 -> DOUBLED
            else -> if (size > 0) size / 2 else 1.0
        }
        if (scale == AxisScale.LINEAR) return low - room to high + room
        return maxOf(TEN.pow(low - room), 1 / LARGEST) to minOf(TEN.pow(high + room), LARGEST)
    }

    internal companion object {
        /** Closer points than this share of the axis (half a pixel) are one point to the eye. */
        const val SMALLEST_STEP = 1.0 / 1600

        private const val LARGEST = 1e300
        private const val SAME = 1e-9
        private const val TEN = 10.0
        private const val DOUBLED = 0.30103
        private const val AT_SIDES = 0.015
        private const val ABOVE_AND_BELOW = 0.04
        private const val ACROSS = 10
        private const val UP = 8
        private val NO_MORE = listOf(0.0, 0.0)

        /** Axes that hold all that can be drawn of [strokes]; null if that is nothing. */
        fun around(strokes: List<Stroke>, wantedX: AxisScale, wantedY: AxisScale): Axes? {
            val x = wantedX.takeIf { scale -> strokes.any { s -> s.x.any { shows(it, scale) } } } ?: AxisScale.LINEAR
            val y = wantedY.takeIf { scale -> strokes.any { s -> s.y.any { shows(it, scale) } } } ?: AxisScale.LINEAR
            val xs = Extent()
            val ys = Extent()
            val band = Extent()
            for (stroke in strokes) {
                for (i in stroke.x.indices) {
                    if (!shows(stroke.x[i], x)) continue
                    if (shows(stroke.y[i], y)) {
                        xs.add(stroke.x[i])
                        ys.add(stroke.y[i])
                    }
                    if (shows(stroke.lower[i], y)) band.add(stroke.lower[i])
                    if (shows(stroke.upper[i], y)) band.add(stroke.upper[i])
                    // A band may reach farther than its line.
                    if (shows(stroke.lower[i], y) && shows(stroke.upper[i], y)) xs.add(stroke.x[i])
                }
            }
            if (ys.isEmpty) return null
            val foot = if (y == AxisScale.LOG10) maxOf(band.from, ys.from / BELOW) else band.from
            return Axes(x, y, xs.from, xs.to, minOf(ys.from, foot), maxOf(ys.to, band.to))
        }

        /** On a logarithmic axis a band is drawn down to this factor below the lowest line. */
        private const val BELOW = 3.0

        private fun shows(value: Double, scale: AxisScale) =
            abs(value) <= LARGEST && (scale == AxisScale.LINEAR || value >= 1 / LARGEST)

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
