package stillwater.plot

import org.jetbrains.letsPlot.geom.geomLine
import org.jetbrains.letsPlot.geom.geomRibbon
import org.jetbrains.letsPlot.letsPlot
import org.jetbrains.letsPlot.sampling.samplingNone
import org.jetbrains.letsPlot.scale.scaleColorManual
import org.jetbrains.letsPlot.scale.scaleFillManual
import org.jetbrains.letsPlot.scale.scaleLinetypeManual

/**
 * One error curve of a comparison: how wrong the map is after each move.
 *
 * @param planner the planner's name; curves of one planner share a colour.
 * @param filter the filter's name; curves of one filter share a line type.
 * @param move moves made, dimensionless, length n, ascending. Retained, not modified.
 * @param error mean absolute error, sensor units, length n. Retained, not modified.
 * @param lower lower end of the band, sensor units, length n, or null for no band. Retained, not modified.
 * @param upper upper end of the band, sensor units, length n, or null for no band. Retained, not modified.
 */
public class ErrorCurve(
    public val planner: String,
    public val filter: String,
    internal val move: DoubleArray,
    internal val error: DoubleArray,
    internal val lower: DoubleArray? = null,
    internal val upper: DoubleArray? = null,
) {
    init {
        require(error.size == move.size) { "error has ${error.size} values but move has ${move.size}; give one each" }
        require((lower == null) == (upper == null)) { "give both ends of the band, or none" }
        require(lower == null || lower.size == move.size) { "lower has ${lower?.size} values, move ${move.size}" }
        require(upper == null || upper.size == move.size) { "upper has ${upper?.size} values, move ${move.size}" }
    }
}

/**
 * The report's comparison of planners and filters (its Figures 6 and 7): error over moves, both on logarithmic
 * axes, planners by colour, filters by line type, bands shaded.
 *
 * Colours and line types go by the order of first appearance, but the report's filters always look as there:
 * `bounded` solid, `averaging` dashed, `exponential` dotted.
 */
public class ErrorCurves(
    title: String,
    subtitle: String = "",
    private val curves: List<ErrorCurve>,
) : Drawing {
    private val sheet = Sheet(title, subtitle, WIDTH, HEIGHT)

    override fun draw(): Figure {
        val strokes = curves.map { curve ->
            Stroke.of(curve.move, curve.error, curve.lower, curve.upper, curve.planner, curve.filter)
        }
        val axes = Axes.around(strokes, AxisScale.LOG10, AxisScale.LOG10) ?: return sheet.empty("no data")
        val table = StrokeTable(strokes.map { it.on(axes) })
        val planners = curves.map { it.planner }.distinct()
        val filters = curves.map { it.filter }.distinct()
        val colours = planners.indices.map(Palette::of)
        val plot = letsPlot(table.columns) {
            x = StrokeTable.X
            group = StrokeTable.PART
        } +
            geomRibbon(alpha = 0.14, size = 0, showLegend = false, sampling = samplingNone) {
                ymin = StrokeTable.LOWER
                ymax = StrokeTable.UPPER
                fill = StrokeTable.COLOUR
            } +
            geomLine(size = 1.1, sampling = samplingNone) {
                y = StrokeTable.Y
                color = StrokeTable.COLOUR
                linetype = StrokeTable.LINE
            } +
            scaleColorManual(colours, name = "Planner", limits = planners) +
            scaleFillManual(colours, limits = planners, guide = "none") +
            scaleLinetypeManual(lineTypesOf(filters).map { it.pattern }, name = "Filter", limits = filters) +
            axes.scales("Moves", "Mean absolute error")
        return sheet.figure(plot)
    }

    private fun lineTypesOf(filters: List<String>): List<LineType> {
        val free = LineType.entries - filters.mapNotNull(REPORT_LINES::get).toSet()
        var next = 0
        return filters.map { REPORT_LINES[it] ?: free[next++ % free.size] }
    }

    private companion object {
        const val WIDTH = 860
        const val HEIGHT = 540
        val REPORT_LINES = mapOf(
            "bounded" to LineType.SOLID,
            "averaging" to LineType.DASHED,
            "exponential" to LineType.DOTTED,
        )
    }
}
