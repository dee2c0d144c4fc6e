package stillwater.plot

import org.jetbrains.letsPlot.geom.geomHLine
import org.jetbrains.letsPlot.geom.geomPath
import org.jetbrains.letsPlot.geom.geomPoint
import org.jetbrains.letsPlot.geom.geomRibbon
import org.jetbrains.letsPlot.letsPlot
import org.jetbrains.letsPlot.sampling.samplingNone
import org.jetbrains.letsPlot.scale.scaleColorManual
import org.jetbrains.letsPlot.scale.scaleFillManual

/** How the values of a [Series] are shown. */
public enum class Mark { LINE, POINTS, LINE_AND_POINTS }

/**
 * Named values over x, with a band where there is one.
 *
 * @property name shown in the legend; series of one name share a colour. Without any name there is no legend.
 * @param x abscissae, length n, in the order in which a line joins them. Retained, not modified.
 * @param y ordinates, length n; NaN interrupts a line. Retained, not modified.
 * @param lower lower end of the band, length n, or null; bands are drawn by ascending x. Retained, not modified.
 * @param upper upper end of the band, length n, or null. Retained, not modified.
 */
public class Series(
    public val name: String,
    internal val x: DoubleArray,
    internal val y: DoubleArray,
    internal val lower: DoubleArray? = null,
    internal val upper: DoubleArray? = null,
    internal val mark: Mark = Mark.LINE,
) {
    init {
        require(x.size == y.size) { "series $name has ${x.size} x but ${y.size} y; give one each" }
        require((lower == null) == (upper == null)) { "series $name: give both ends of the band, or none" }
        require(lower == null || (lower.size == x.size && upper?.size == x.size)) {
            "series $name: the band must have ${x.size} values at either end"
        }
    }
}

/**
 * Lines and points over x: time series, residuals, whatever has two axes.
 *
 * Lines are thinned to half a pixel; points are all drawn, so give some thousand at most.
 *
 * @param references y values to mark with a thin line across, such as 0 for residuals.
 */
public class LinePlot(
    title: String,
    subtitle: String = "",
    private val series: List<Series>,
    private val xLabel: String,
    private val yLabel: String,
    private val xScale: AxisScale = AxisScale.LINEAR,
    private val yScale: AxisScale = AxisScale.LINEAR,
    private val references: List<Double> = emptyList(),
) : Drawing {
    private val sheet = Sheet(title, subtitle, WIDTH, HEIGHT)

    override fun draw(): Figure {
        val strokes = series.map { it to Stroke.of(it.x, it.y, it.lower, it.upper, it.name, "") }
        val axes = Axes.around(strokes.map { it.second }, xScale, yScale) ?: return sheet.empty("no data")
        val names = series.map { it.name }.distinct()
        val colours = names.indices.map(Palette::of)
        val keys = names.zip(colours) { name, colour -> if (isBandAlone(name)) Palette.ofBand(colour) else colour }
        val lines = strokes.filter { it.first.mark != Mark.POINTS }.map { it.second.on(axes) }
        val points = strokes.filter { it.first.mark != Mark.LINE }.map { it.second }
        var plot = letsPlot() + scaleColorManual(keys, name = "", limits = names, guide = guide(names)) +
            scaleFillManual(colours, limits = names, guide = "none") + axes.scales(xLabel, yLabel)
        for (level in references.filter(axes::showsY)) {
            plot +=
                geomHLine(yintercept = level, color = Palette.AXIS, size = 0.8)
        }
        if (strokes.any { it.first.lower != null }) plot += bands(strokes.map { it.second.on(axes) })
        if (lines.isNotEmpty()) plot += lines(lines)
        if (points.isNotEmpty()) plot += points(points.map { it.visible(axes) })
        return sheet.figure(plot)
    }

    /** Whether all that is drawn of [name] is a band: a legend that shows a line of full colour would name nothing. */
    private fun isBandAlone(name: String) =
        series.filter { it.name == name }.all { line -> line.lower != null && line.y.none { it.isFinite() } }

    private fun guide(names: List<String>): Any? = if (names.all(String::isEmpty)) "none" else null

    private fun bands(strokes: List<Stroke>) =
        geomRibbon(
            StrokeTable(strokes, isBand = true).columns,
            alpha = 0.18,
            size = 0,
            showLegend = false,
            sampling = samplingNone,
        ) {
            x = StrokeTable.X
            ymin = StrokeTable.LOWER
            ymax = StrokeTable.UPPER
            fill = StrokeTable.COLOUR
            group = StrokeTable.PART
        }

    private fun lines(strokes: List<Stroke>) =
        geomPath(StrokeTable(strokes).columns, size = 1.0, sampling = samplingNone) {
            x = StrokeTable.X
            y = StrokeTable.Y
            color = StrokeTable.COLOUR
            group = StrokeTable.PART
        }

    private fun points(strokes: List<Stroke>) =
        geomPoint(StrokeTable(strokes).columns, size = 2.4, alpha = 0.75, sampling = samplingNone) {
            x = StrokeTable.X
            y = StrokeTable.Y
            color = StrokeTable.COLOUR
        }

    private companion object {
        const val WIDTH = 860
        const val HEIGHT = 460
    }
}
