package stillwater.plot

import org.jetbrains.letsPlot.Stat
import org.jetbrains.letsPlot.awt.plot.PlotSvgExport
import org.jetbrains.letsPlot.geom.geomText
import org.jetbrains.letsPlot.ggsize
import org.jetbrains.letsPlot.intern.Feature
import org.jetbrains.letsPlot.intern.Plot
import org.jetbrains.letsPlot.intern.toSpec
import org.jetbrains.letsPlot.label.ggtitle
import org.jetbrains.letsPlot.letsPlot
import org.jetbrains.letsPlot.scale.scaleXContinuous
import org.jetbrains.letsPlot.scale.scaleYContinuous
import org.jetbrains.letsPlot.themes.elementBlank
import org.jetbrains.letsPlot.themes.elementLine
import org.jetbrains.letsPlot.themes.elementRect
import org.jetbrains.letsPlot.themes.elementText
import org.jetbrains.letsPlot.themes.margin
import org.jetbrains.letsPlot.themes.theme
import org.jetbrains.letsPlot.themes.themeMinimal

/** Title, subtitle and size, common to all kinds of figures. Sizes in CSS px. */
internal class Sheet(val title: String, val subtitle: String, val width: Int, val height: Int) {
    /** Puts [plot] on this sheet, in the house's type and colours. */
    fun figure(plot: Plot, more: Feature = theme()): Figure {
        val heading = ggtitle(title.ifEmpty { " " }, subtitle.ifEmpty { null })
        val dressed = plot + look() + more + ggsize(width, height) + heading
        val drawn = SecondTry.of { PlotSvgExport.buildSvgImageFromRawSpecs(dressed.toSpec()) }
        return Figure(title, StableSvg.of(drawn, title, width, height), width, height)
    }

    /** A figure that says why it shows no data. */
    fun empty(reason: String): Figure {
        val plot = letsPlot(mapOf("x" to listOf(0.0), "y" to listOf(0.0), "label" to listOf(reason))) +
            geomText(stat = Stat.identity, size = 7, color = Palette.MUTED) {
                x = "x"
                y = "y"
                label = "label"
            } +
            scaleXContinuous(name = " ") + scaleYContinuous(name = " ")
        return figure(plot, bare())
    }

    private fun bare() = theme(
        axisTitle = elementBlank(),
        axisTextX = elementBlank(),
        axisTextY = elementBlank(),
        axisLine = elementBlank(),
        axisTicks = elementBlank(),
        panelGridMajor = elementBlank(),
    )

    private fun look() = themeMinimal() + theme(
        text = elementText(color = Palette.TEXT),
        title = elementText(color = Palette.TEXT, size = 15),
        axisTitle = elementText(color = Palette.TEXT, size = 15),
        axisText = elementText(color = Palette.TEXT, size = 14),
        // Level, or the library turns labels whose neighbours come near.
        axisTextX = elementText(color = Palette.TEXT, size = 14, angle = 0),
        axisLine = elementLine(color = Palette.AXIS, size = 1),
        axisTicks = elementLine(color = Palette.AXIS, size = 1),
        axisTicksLength = 5,
        panelGridMajor = elementLine(color = Palette.GRID, size = 1),
        panelGridMinor = elementBlank(),
        legendTitle = elementText(color = Palette.MUTED, size = 14),
        legendText = elementText(color = Palette.TEXT, size = 14),
        plotTitle = elementText(color = Palette.TEXT, size = 19, face = "bold"),
        plotSubtitle = elementText(color = Palette.MUTED, size = 14),
        plotBackground = elementRect(fill = Palette.PAPER, color = Palette.PAPER, size = 0),
        plotMargin = margin(t = 12, r = 16, b = 10, l = 10),
    )
}
