package stillwater.plot

import org.jetbrains.letsPlot.geom.geomPath
import org.jetbrains.letsPlot.geom.geomPoint
import org.jetbrains.letsPlot.geom.geomPolygon
import org.jetbrains.letsPlot.geom.geomSegment
import org.jetbrains.letsPlot.letsPlot
import org.jetbrains.letsPlot.sampling.samplingNone
import org.jetbrains.letsPlot.scale.scaleColorManual

/**
 * A line on a map, in a local frame.
 *
 * @param name shown in the legend.
 * @param east x, m, length n, in order. Retained, not modified.
 * @param north y, m, as many. Retained, not modified.
 */
public class MapLine(public val name: String, internal val east: DoubleArray, internal val north: DoubleArray) {
    init {
        require(east.size == north.size) { "line $name has ${east.size} east but ${north.size} north" }
        require(east.all(Double::isFinite) && north.all(Double::isFinite)) { "line $name must have finite places" }
    }
}

/**
 * Water with its islands and other keep-outs, the tracks of boats upon it, each from a dot, and below them the legs of a
 * planner's tree. True to scale.
 *
 * @param outlines the shore, then the keep-outs.
 * @param tracks drawn in colours of their own.
 * @param legs thin lines, each from its first place to its last.
 */
public class WaterMap(
    private val title: String,
    private val subtitle: String = "",
    private val outlines: List<MapLine>,
    private val tracks: List<MapLine>,
    private val legs: List<MapLine> = emptyList(),
) : Drawing {
    override fun draw(): Figure {
        val all = outlines + tracks.filter { it.east.isNotEmpty() }
        if (all.isEmpty()) return Sheet(title, subtitle, MapFrame.WIDTH, MapFrame.EMPTY_HEIGHT).empty("no water")
        val frame = MapFrame.around(all.map { it.east }, all.map { it.north }, MARGIN)
        val names = tracks.map { it.name }.distinct()
        var plot = letsPlot() + frame.axes() +
            scaleColorManual(names.indices.map(Palette::of), name = "", limits = names)
        if (outlines.isNotEmpty()) plot += area(outlines.take(1), WATER) + area(outlines.drop(1), Palette.ABSENT)
        if (legs.isNotEmpty()) plot += tree()
        for (track in tracks.filter { it.east.isNotEmpty() }) plot += line(track)
        return frame.sheet(title, subtitle).figure(plot, frame.legend())
    }

    private fun area(rings: List<MapLine>, colour: String) = geomPolygon(
        mapOf(
            "east" to rings.flatMap { it.east.asList() },
            "north" to rings.flatMap { it.north.asList() },
            "ring" to rings.flatMapIndexed { index, ring -> List(ring.east.size) { index } },
        ),
        fill = colour,
        color = Palette.AXIS,
        size = 0.7,
        sampling = samplingNone,
    ) {
        x = "east"
        y = "north"
        group = "ring"
    }

    private fun tree() = geomSegment(
        mapOf(
            "east" to legs.map { it.east.first() },
            "north" to legs.map { it.north.first() },
            "toEast" to legs.map { it.east.last() },
            "toNorth" to legs.map { it.north.last() },
        ),
        color = Palette.MUTED,
        size = 0.35,
        alpha = 0.6,
        sampling = samplingNone,
    ) {
        x = "east"
        y = "north"
        xend = "toEast"
        yend = "toNorth"
    }

    private fun line(track: MapLine) = geomPath(
        mapOf("east" to track.east.asList(), "north" to track.north.asList(), "name" to track.east.map { track.name }),
        size = 0.9,
        sampling = samplingNone,
    ) {
        x = "east"
        y = "north"
        color = "name"
    } + geomPoint(
        mapOf(
            "east" to listOf(track.east.first()),
            "north" to listOf(track.north.first()),
            "name" to listOf(track.name),
        ),
        size = 4.0,
        sampling = samplingNone,
        showLegend = false,
    ) {
        x = "east"
        y = "north"
        color = "name"
    }

    private companion object {
        const val MARGIN = 0.03
        const val WATER = "#DDEEF7"
    }
}
