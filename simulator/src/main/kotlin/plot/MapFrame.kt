package stillwater.plot

import org.jetbrains.letsPlot.coord.coordFixed
import org.jetbrains.letsPlot.intern.Feature
import org.jetbrains.letsPlot.scale.scaleXContinuous
import org.jetbrains.letsPlot.scale.scaleYContinuous

/** The part of the local frame that a map shows, and a sheet of the same shape. */
internal class MapFrame private constructor(
    private val west: Double,
    private val east: Double,
    private val south: Double,
    private val north: Double,
) {
    /** Axes in metres, one metre as long on either. */
    fun axes(): Feature = scaleXContinuous(name = "East (m)", format = METRES, limits = west to east) +
        scaleYContinuous(name = "North (m)", format = METRES, limits = south to north) + coordFixed()

    /** A sheet that the map fills, within sizes that a page can show. */
    fun sheet(title: String, subtitle: String): Sheet {
        val shape = (north - south) / (east - west)
        val beside = BESIDE
        val wide = (WIDTH - beside) * shape + ABOVE
        if (wide <= TALLEST) return Sheet(title, subtitle, WIDTH, wide.toInt().coerceAtLeast(LOWEST))
        val width = ((TALLEST - ABOVE) / shape + beside).toInt().coerceIn(NARROWEST, WIDTH)
        return Sheet(title, subtitle, width, TALLEST)
    }

    internal companion object {
        const val WIDTH = 860
        const val EMPTY_HEIGHT = 420
        private const val TALLEST = 900
        private const val LOWEST = 400
        private const val NARROWEST = 620

        /** Room for axis and legend beside the map, and for title and axis above and below it, px. */
        private const val BESIDE = 210.0
        private const val ABOVE = 130.0
        private const val METRES = ",d"
        private const val MARGIN = 0.03

        /** The frame around all points, with a little room; a single point gets 1 m around it. */
        fun around(east: List<DoubleArray>, north: List<DoubleArray>): MapFrame {
            val west = east.minOf { it.min() }
            val right = east.maxOf { it.max() }
            val south = north.minOf { it.min() }
            val top = north.maxOf { it.max() }
            val size = maxOf(right - west, top - south)
            val room = if (size > 0) size * MARGIN else 1.0
            return MapFrame(west - room, right + room, south - room, top + room)
        }
    }
}
