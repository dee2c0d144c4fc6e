package stillwater.plot

import org.jetbrains.letsPlot.coord.coordFixed
import org.jetbrains.letsPlot.intern.Feature
import org.jetbrains.letsPlot.scale.scaleXContinuous
import org.jetbrains.letsPlot.scale.scaleYContinuous
import org.jetbrains.letsPlot.themes.theme

/** The part of the local frame that a map shows, and a sheet of the same shape. */
internal class MapFrame private constructor(
    private val west: Double,
    private val east: Double,
    private val south: Double,
    private val north: Double,
) {
    private val shape = (north - south) / (east - west)

    /** Whether the legend stands below the map, because the map is much wider than high. */
    val isFlat = shape < FLAT

    /** The longer side, m. */
    val size = maxOf(north - south, east - west)

    /** Axes in metres, one metre as long on either; what belongs to the map's shape. */
    fun axes(): Feature {
        val x = Ticks.linear(west, east, if (shape > 1) maxOf(3, (TICKS / shape).toInt()) else TICKS)
        val y = Ticks.linear(south, north, if (shape < 1) maxOf(3, (TICKS * shape).toInt()) else TICKS)
        return scaleXContinuous("East (m)", x.places, x.labels, limits = west to east, expand = NO_MORE) +
            scaleYContinuous("North (m)", y.places, y.labels, limits = south to north, expand = NO_MORE) +
            coordFixed()
    }

    /** Where the legend stands. */
    fun legend(): Feature = if (isFlat) theme().legendPositionBottom() else theme().legendPositionRight()

    /** A sheet that the map fills, within sizes that a page can show. */
    fun sheet(title: String, subtitle: String): Sheet {
        val beside = if (isFlat) AXIS_BESIDE else AXIS_BESIDE + LEGEND_BESIDE
        val above = if (isFlat) TITLE_AND_AXIS + LEGEND_BELOW else TITLE_AND_AXIS
        val high = (WIDTH - beside) * shape + above
        if (high <= TALLEST) return Sheet(title, subtitle, WIDTH, maxOf(high, LOWEST).toInt())
        val width = (TALLEST - above) / shape + beside
        return Sheet(title, subtitle, width.coerceIn(NARROWEST, WIDTH.toDouble()).toInt(), TALLEST.toInt())
    }

    internal companion object {
        const val WIDTH = 860
        const val EMPTY_HEIGHT = 420
        private const val TALLEST = 900.0
        private const val LOWEST = 300.0
        private const val NARROWEST = 620.0
        private const val FLAT = 0.4

        /** Room around the map, px. */
        private const val AXIS_BESIDE = 85.0
        private const val LEGEND_BESIDE = 125.0
        private const val TITLE_AND_AXIS = 125.0
        private const val LEGEND_BELOW = 70.0
        private const val TICKS = 10
        private val NO_MORE = listOf(0.0, 0.0)

        /** The frame around all points, with [margin] of its longer side around it; a single point gets 1 m around it. */
        fun around(east: List<DoubleArray>, north: List<DoubleArray>, margin: Double): MapFrame {
            val west = east.minOf { it.min() }
            val right = east.maxOf { it.max() }
            val south = north.minOf { it.min() }
            val top = north.maxOf { it.max() }
            val size = maxOf(right - west, top - south)
            val room = if (size > 0) size * margin else 1.0
            return MapFrame(west - room, right + room, south - room, top + room)
        }
    }
}
