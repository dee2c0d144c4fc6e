package stillwater.plot

import org.jetbrains.letsPlot.Stat
import org.jetbrains.letsPlot.geom.geomRect
import org.jetbrains.letsPlot.geom.geomSegment
import org.jetbrains.letsPlot.geom.geomText
import org.jetbrains.letsPlot.geom.geomVLine
import org.jetbrains.letsPlot.letsPlot
import org.jetbrains.letsPlot.sampling.samplingNone
import org.jetbrains.letsPlot.scale.scaleXContinuous
import org.jetbrains.letsPlot.scale.scaleYContinuous
import org.jetbrains.letsPlot.themes.elementBlank
import org.jetbrains.letsPlot.themes.theme

/**
 * One bar of [Bars].
 *
 * @property name what is measured. @property value its length, in the figure's unit.
 * @property lower lower end of its uncertainty, same unit, NaN for none. @property upper upper end, likewise.
 */
public class Bar(
    public val name: String,
    public val value: Double,
    public val lower: Double = Double.NaN,
    public val upper: Double = Double.NaN,
)

/**
 * Named values as horizontal bars from 0, the first on top, each under its name, with a whisker where an uncertainty
 * is given. Bars without a finite value are left out.
 *
 * @param valueLabel what the lengths mean, such as `Mismatch (mg/L)`.
 */
public class Bars(
    private val title: String,
    private val subtitle: String = "",
    private val bars: List<Bar>,
    private val valueLabel: String,
) : Drawing {
    override fun draw(): Figure {
        val shown = bars.filter { it.value.isFinite() }
        val sheet = Sheet(title, subtitle, WIDTH, (BASE + ROW * shown.size).coerceIn(LOWEST, TALLEST))
        if (shown.isEmpty()) return sheet.empty("no data")
        val ends = shown.flatMap { listOf(0.0, it.value, it.lower, it.upper) }.filter(Double::isFinite)
        val room = (ends.max() - ends.min()).takeIf { it > 0 }?.times(MARGIN) ?: 1.0
        val from = if (ends.min() < 0) ends.min() - room else 0.0
        val to = if (ends.max() > 0) ends.max() + room else room
        val ticks = Ticks.linear(from, to, TICKS)
        val places = List(shown.size) { (shown.size - it).toDouble() }
        val table = mapOf(
            "left" to shown.map { minOf(0.0, it.value) },
            "right" to shown.map { maxOf(0.0, it.value) },
            "foot" to places.map { it - FOOT },
            "top" to places.map { it + TOP },
            "middle" to places.map { it + (TOP - FOOT) / 2 },
            "lower" to shown.map { it.lower.takeIf(Double::isFinite) },
            "upper" to shown.map { it.upper.takeIf(Double::isFinite) },
            "edge" to shown.map { from },
            "above" to places.map { it + NAME },
            "name" to shown.map { it.name },
        )
        val plot = letsPlot(table) +
            geomRect(fill = Palette.of(0), size = 0, alpha = 0.85, sampling = samplingNone) {
                xmin = "left"
                xmax = "right"
                ymin = "foot"
                ymax = "top"
            } +
            geomSegment(size = 1.2, color = Palette.TEXT, sampling = samplingNone) {
                x = "lower"
                xend = "upper"
                y = "middle"
                yend = "middle"
            } +
            geomText(stat = Stat.identity, size = 6.4, color = Palette.TEXT, hjust = 0, sampling = samplingNone) {
                x = "edge"
                y = "above"
                label = "name"
            } +
            geomVLine(xintercept = 0.0, color = Palette.AXIS, size = 0.8) +
            scaleXContinuous(valueLabel, ticks.places, ticks.labels, limits = from to to, expand = NO_MORE) +
            scaleYContinuous("", emptyList(), limits = 1 - HALF to shown.size + HALF, expand = NO_MORE)
        return sheet.figure(plot, theme(axisLineY = elementBlank(), panelGridMajorY = elementBlank()))
    }

    private companion object {
        const val WIDTH = 860
        const val BASE = 135
        const val ROW = 56
        const val LOWEST = 220
        const val TALLEST = 1400
        const val MARGIN = 0.05
        const val TICKS = 8

        /** Within a bar's row of height 1: the bar's foot and top, and its name above, from the row's middle. */
        const val FOOT = 0.35
        const val TOP = 0.1
        const val NAME = 0.3
        const val HALF = 0.5
        val NO_MORE = listOf(0.0, 0.0)
    }
}
