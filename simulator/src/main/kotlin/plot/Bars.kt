package stillwater.plot

import org.jetbrains.letsPlot.coord.coordFlip
import org.jetbrains.letsPlot.geom.geomErrorBar
import org.jetbrains.letsPlot.geom.geomBar
import org.jetbrains.letsPlot.Stat
import org.jetbrains.letsPlot.letsPlot
import org.jetbrains.letsPlot.sampling.samplingNone
import org.jetbrains.letsPlot.scale.scaleXDiscrete
import org.jetbrains.letsPlot.scale.scaleYContinuous

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

/** Named values as horizontal bars, the first on top, with whiskers where an uncertainty is given. */
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
        val names = shown.map { it.name }.distinct().asReversed()
        val table = mapOf(
            "name" to shown.map { it.name },
            "value" to shown.map { it.value },
            "lower" to shown.map { it.lower.takeIf(Double::isFinite) },
            "upper" to shown.map { it.upper.takeIf(Double::isFinite) },
        )
        val plot = letsPlot(table) { x = "name" } +
            geomBar(stat = Stat.identity, fill = Palette.of(0), size = 0, width = 0.7, alpha = 0.85, sampling = samplingNone) {
                y = "value"
            } +
            geomErrorBar(width = 0.25, size = 0.9, color = Palette.TEXT) { ymin = "lower"; ymax = "upper" } +
            scaleXDiscrete(name = "", limits = names) +
            scaleYContinuous(name = valueLabel) + coordFlip()
        return sheet.figure(plot)
    }

    private companion object {
        const val WIDTH = 860
        const val BASE = 150
        const val ROW = 36
        const val LOWEST = 260
        const val TALLEST = 1400
    }
}
