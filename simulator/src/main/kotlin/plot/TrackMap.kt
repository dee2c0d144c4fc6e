package stillwater.plot

import org.jetbrains.letsPlot.Stat
import org.jetbrains.letsPlot.geom.geomPath
import org.jetbrains.letsPlot.geom.geomPoint
import org.jetbrains.letsPlot.geom.geomText
import org.jetbrains.letsPlot.intern.Feature
import org.jetbrains.letsPlot.letsPlot
import org.jetbrains.letsPlot.sampling.samplingNone

/**
 * A boat's track in a local frame (x east, y north), coloured by what its sensor read, true to scale, its ends marked.
 *
 * Points without a finite position are left out and interrupt the track; those without a value are grey. Give some
 * thousand points at most: each becomes an element of the SVG.
 *
 * @param east x of each point, m, length n, in order of time. Retained, not modified.
 * @param north y of each point, m, length n. Retained, not modified.
 * @param value reading at each point, length n, in the map's unit. Retained, not modified.
 * @param unit what the colours mean, such as `Oxygen (mg/L)`.
 * @param colours the values at the ends of the colour scale; by default those of the track. Values beyond take the
 *   colour of the nearer end, and the subtitle says how many there are.
 * @param isDifference whether the values are differences, whose sign is what matters: blue below zero, red above.
 */
public class TrackMap(
    private val title: String,
    private val subtitle: String = "",
    private val east: DoubleArray,
    private val north: DoubleArray,
    private val value: DoubleArray,
    private val unit: String,
    private val colours: ClosedFloatingPointRange<Double>? = null,
    private val isDifference: Boolean = false,
) : Drawing {
    init {
        require(east.size == north.size && east.size == value.size) {
            "east, north and value must be as long, got ${east.size}, ${north.size} and ${value.size}"
        }
    }

    override fun draw(): Figure {
        val placed = east.indices.filter { east[it].isFinite() && north[it].isFinite() }
        if (placed.isEmpty()) return Sheet(title, subtitle, MapFrame.WIDTH, MapFrame.EMPTY_HEIGHT).empty("no positions")
        val x = DoubleArray(placed.size) { east[placed[it]] }
        val y = DoubleArray(placed.size) { north[placed[it]] }
        val frame = MapFrame.around(listOf(x), listOf(y), ROOM_FOR_LABELS)
        val shown = placed.map { value[it] }
        val scale = if (isDifference) ColourScale.ofDifferences(shown) else ColourScale.of(shown, colours)
        val table = mapOf(
            "east" to x.asList(),
            "north" to y.asList(),
            "value" to placed.map { scale.place(value[it]) },
            // Points without position between two placed ones make the difference grow: a new part.
            "part" to placed.mapIndexed { index, point -> point - index },
        )
        val plot = letsPlot(table) {
            this.x = "east"
            this.y = "north"
        } +
            geomPath(color = Palette.AXIS, size = 0.5, sampling = samplingNone) { group = "part" } +
            points(placed, scale.colour(unit, frame.isFlat)) + frame.axes() +
            start(x, y, frame.size) + end(x, y, frame.size)
        val beyond = scale.note(shown, "points")
        val below = listOf(subtitle, beyond).filter { it.isNotEmpty() }.joinToString("; ")
        return frame.sheet(title, below).figure(plot, frame.legend())
    }

    /** Coloured by value where there is any; the library draws no scale for nothing but missing values. */
    private fun points(placed: List<Int>, scale: Feature): Feature =
        if (placed.all { value[it].isNaN() }) {
            geomPoint(size = 2.2, color = Palette.ABSENT, sampling = samplingNone)
        } else {
            geomPoint(size = 2.2, sampling = samplingNone) { color = "value" } + scale
        }

    /** The start's label stands below it and the end's above, so that both can be read where they meet. */
    private fun start(x: DoubleArray, y: DoubleArray, size: Double) =
        marker(x.first(), y.first(), CIRCLE) + label(x.first(), y.first() - size * LABEL_DISTANCE, "start")

    private fun end(x: DoubleArray, y: DoubleArray, size: Double) =
        marker(x.last(), y.last(), SQUARE) + label(x.last(), y.last() + size * LABEL_DISTANCE, "end")

    private fun marker(x: Double, y: Double, shape: Int) = geomPoint(
        data = mapOf("east" to listOf(x), "north" to listOf(y)),
        shape = shape,
        size = 4.5,
        stroke = 1.6,
        color = Palette.TEXT,
    )

    private fun label(x: Double, y: Double, text: String) = geomText(
        data = mapOf("east" to listOf(x), "north" to listOf(y)),
        stat = Stat.identity,
        label = text,
        size = 6,
        color = Palette.TEXT,
        fontface = "bold",
    )

    private companion object {
        const val ROOM_FOR_LABELS = 0.06
        const val LABEL_DISTANCE = 0.028
        const val CIRCLE = 1
        const val SQUARE = 0
    }
}
