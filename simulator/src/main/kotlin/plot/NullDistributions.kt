package stillwater.plot

import org.jetbrains.letsPlot.Stat
import org.jetbrains.letsPlot.geom.geomRibbon
import org.jetbrains.letsPlot.geom.geomSegment
import org.jetbrains.letsPlot.geom.geomText
import org.jetbrains.letsPlot.letsPlot
import org.jetbrains.letsPlot.sampling.samplingNone
import org.jetbrains.letsPlot.scale.scaleXContinuous
import org.jetbrains.letsPlot.scale.scaleYContinuous
import org.jetbrains.letsPlot.themes.elementBlank
import org.jetbrains.letsPlot.themes.theme
import java.util.Locale
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.sqrt

/**
 * A statistic and how chance distributes it.
 *
 * @property name what it is. @property value what was measured. @property chance what it is where chance alone is at
 *   work, at least two numbers. Not to be modified.
 */
public class NullDistribution(public val name: String, public val value: Double, public val chance: DoubleArray) {
    init {
        require(chance.size >= 2) { "$name: ${chance.size} draws tell no distribution; give 2 or more" }
    }
}

/**
 * Statistics one below the other, each as a mark on the density of its null distribution: all in standard deviations of
 * that, from its mean, so that one axis serves all. What is farther out than the axis is an arrow at its end. Not finite
 * ones are left out.
 */
public class NullDistributions(
    private val title: String,
    private val subtitle: String = "",
    private val statistics: List<NullDistribution>,
) : Drawing {
    private class Row(val name: String, val at: Double, val foot: Double, val density: List<Double>)

    override fun draw(): Figure {
        val shown = statistics.filter { it.value.isFinite() && it.chance.all(Double::isFinite) }
        val sheet = Sheet(title, subtitle, WIDTH, BASE + ROW * shown.size)
        if (shown.isEmpty()) return sheet.empty("no data")
        val rows = shown.mapIndexed { k, statistic -> row(statistic, (shown.size - k).toDouble()) }
        val ticks = Ticks.linear(-REACH, REACH, TICKS)
        val plot = letsPlot() + densities(rows) + marks(rows) + beyond(rows) + names(rows) +
            scaleXContinuous(
                "Standard deviations from what noise alone gives on average",
                ticks.places,
                ticks.labels,
                limits = -SIDE to SIDE,
                expand = NO_MORE,
            ) +
            scaleYContinuous("", emptyList(), limits = 1 - HALF to shown.size + HALF, expand = NO_MORE)
        return sheet.figure(plot, theme(axisLineY = elementBlank(), panelGridMajorY = elementBlank()))
    }

    private fun row(statistic: NullDistribution, place: Double): Row {
        val mean = statistic.chance.average()
        val spread = sqrt(statistic.chance.sumOf { (it - mean) * (it - mean) } / (statistic.chance.size - 1))
        fun scaled(value: Double) = if (spread > 0) (value - mean) / spread else Math.signum(value - mean) * SIDE
        val chance = statistic.chance.map(::scaled)
        // Silverman's rule for a normal density of variance 1.
        val width = WIDTH_OF_KERNEL * Math.pow(chance.size.toDouble(), -1.0 / 5)
        val density = GRID.map { x -> chance.sumOf { exp(-(x - it) * (x - it) / (2 * width * width)) } }
        val top = density.max()
        return Row(
            statistic.name,
            scaled(statistic.value),
            place - FOOT,
            density.map { if (top > 0) it / top else 0.0 },
        )
    }

    private fun densities(rows: List<Row>) = geomRibbon(
        mapOf(
            "x" to rows.flatMap { GRID },
            "foot" to rows.flatMap { row -> GRID.map { row.foot } },
            "top" to rows.flatMap { row -> row.density.map { row.foot + HEIGHT * it } },
            "row" to rows.flatMap { row -> GRID.map { row.name } },
        ),
        fill = Palette.of(0),
        color = Palette.of(0),
        alpha = 0.3,
        size = 0.6,
        showLegend = false,
        sampling = samplingNone,
    ) {
        x = "x"
        ymin = "foot"
        ymax = "top"
        group = "row"
    }

    private fun marks(rows: List<Row>) = rows.filter { abs(it.at) <= REACH }.let { near ->
        geomSegment(
            mapOf(
                "x" to near.map { it.at },
                "foot" to near.map { it.foot },
                "top" to near.map { it.foot + HEIGHT * MARK },
            ),
            size = 2.0,
            color = Palette.of(1),
            sampling = samplingNone,
        ) {
            x = "x"
            xend = "x"
            y = "foot"
            yend = "top"
        }
    }

    /** Arrows of text to those that are farther out than the axis. */
    private fun beyond(rows: List<Row>) = rows.filter { abs(it.at) > REACH }.let { far ->
        geomText(
            mapOf(
                "x" to far.map { if (it.at > 0) SIDE - EDGE else -SIDE + EDGE },
                "y" to far.map { it.foot + HEIGHT / 2 },
                "label" to far.map { if (it.at > 0) "${whole(it.at)} →" else "← ${whole(it.at)}" },
                "side" to far.map { if (it.at > 0) "right" else "left" },
            ),
            stat = Stat.identity,
            size = 6.8,
            color = Palette.of(1),
            sampling = samplingNone,
        ) {
            x = "x"
            y = "y"
            label = "label"
            hjust = "side"
        }
    }

    private fun whole(at: Double) = String.format(Locale.ROOT, "%.0f", at).replace('-', '−')

    private fun names(rows: List<Row>) = geomText(
        mapOf(
            "x" to rows.map { -SIDE + EDGE },
            "y" to rows.map { it.foot + NAME },
            "label" to rows.map { it.name },
        ),
        stat = Stat.identity,
        size = 6.4,
        color = Palette.TEXT,
        hjust = 0,
        sampling = samplingNone,
    ) {
        x = "x"
        y = "y"
        label = "label"
    }

    private companion object {
        const val WIDTH = 860
        const val BASE = 135
        const val ROW = 72

        /** How far the axis has ticks, and how far it reaches, standard deviations. */
        const val REACH = 6.0
        const val SIDE = 6.5
        const val EDGE = 0.1
        const val TICKS = 7
        const val HALF = 0.5

        /** Within a row of height 1: its foot below the middle, the density's height, the mark over that, the name above the foot. */
        const val FOOT = 0.45
        const val HEIGHT = 0.55
        const val MARK = 1.1
        const val NAME = 0.78
        const val WIDTH_OF_KERNEL = 1.06
        val NO_MORE = listOf(0.0, 0.0)

        /** Where densities are told. */
        val GRID = List(121) { -REACH + it * REACH / 60 }
    }
}
