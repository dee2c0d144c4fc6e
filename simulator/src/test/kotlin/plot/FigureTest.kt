package stillwater.plot

import java.awt.Color
import java.util.Locale
import javax.imageio.ImageIO
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertContentEquals
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class FigureTest {
    private val x = DoubleArray(30) { it + 1.0 }

    private fun drawings(): List<Drawing> = listOf(
        ErrorCurves(
            "Errors",
            "a < b & c",
            listOf(ErrorCurve("walk", "bounded", x, x), ErrorCurve("lawn", "averaging", x, x)),
        ),
        CellMap("Cells", "", List(12) { MapCell.rectangle(it * 5.0, 0.0, 5.0, 5.0, 0.3, it * 1.5) }, "mg/L"),
        TrackMap("Track", "", x, x, x, "mg/L"),
        LinePlot("Lines", "", listOf(Series("a", x, x), Series("b", x, x, mark = Mark.LINE_AND_POINTS)), "s", "m"),
        Histogram.of("Histogram", "", x, 5, "s"),
        Bars("Bars", "", listOf(Bar("one", 1.0, 0.5, 1.5)), "m"),
        CellMap("Nothing", "", emptyList(), "u"),
    )

    @Test
    fun theSameDataGiveTheSameBytesAlsoInParallelAndInAnotherLocale() {
        val first = drawings().map { it.draw().svg }
        val before = Locale.getDefault()
        try {
            Locale.setDefault(Locale.forLanguageTag("ar-EG"))
            assertEquals(first, drawings().map { it.draw().svg })
        } finally {
            Locale.setDefault(before)
        }
        assertEquals(first, drawings().drawAll().map { it.svg })
    }

    @Test
    fun aFigureNeedsNothingFromOutsideAndRunsNothing() {
        for (figure in drawings().map { it.draw() }) {
            val outside = Regex("(?i)<script|@import|href=|url\\((?!#)|<image|<foreignObject|on\\w+=").find(figure.svg)
            assertEquals(null, outside?.value, figure.title)
            assertEquals("0 0 ${figure.width} ${figure.height}", SvgParts(figure).root.getAttribute("viewBox"))
        }
    }

    @Test
    fun idsAreUniqueAcrossTheFiguresOfAPage() {
        val ids = drawings().flatMap { drawing ->
            Regex("id=\"([^\"]+)\"").findAll(drawing.draw().svg).map { it.groupValues[1] }
        }
        assertEquals(ids.distinct(), ids)
    }

    @Test
    fun titleIsEscapedAndNamesTheFigure() {
        val figure = Histogram.of("1 < 2 & \"3\"", "", x, 5, "s").draw()
        assertEquals("1 < 2 & \"3\"", SvgParts(figure).all("title").single().textContent)
    }

    @Test
    fun pngIsTwiceTheSizeOnWhiteAndHasInk() {
        for (figure in drawings().drawAll()) {
            val image = ImageIO.read(figure.png().inputStream())
            assertEquals(2 * figure.width to 2 * figure.height, image.width to image.height)
            assertTrue(image.width >= 1200, "${figure.title}: ${image.width} px")
            assertEquals(-1, image.getRGB(1, 1), "white corner of ${figure.title}")
            val ink = (0 until image.width).count { px -> (0 until image.height).any { image.getRGB(px, it) != -1 } }
            assertTrue(ink > 20, "columns with ink in ${figure.title}: $ink")
        }
    }

    @Test
    fun pngBytesRepeatAndAreTheCallersOwn() {
        val figure = Histogram.of("t", "", x, 5, "s").draw()
        val bytes = figure.png()
        bytes.fill(0)
        assertContentEquals(Histogram.of("t", "", x, 5, "s").draw().png(), figure.png())
    }

    @Test
    fun bandsHaveNoOutlineAndSlantingEdgesAreSmooth() {
        val flat = DoubleArray(x.size) { 1.0 }
        val figure = LinePlot("", "", listOf(Series("", x, flat, flat, x)), "", "").draw()
        assertFalse("stroke-width=\"0\"" in figure.svg, "Java draws a line of no width as a hairline")
        val image = ImageIO.read(figure.png().inputStream())
        val colours = (0 until image.width * image.height)
            .map { Color(image.getRGB(it % image.width, it / image.width)) }.toSet()
        // Blue on white at 0.18 is (209, 230, 241); an edge without smoothing has that and white only.
        val shades = colours.count { it.red in 212..252 && it.blue - it.red in 3..30 && it.green > it.red }
        assertTrue(shades > 5, "shades between paper and band: $shades")
    }

    @Test
    fun anSvgThatCannotBeReadIsAFigureException() {
        val broken = Figure("t", "<svg xmlns='http://www.w3.org/2000/svg'><g>", 300, 300)
        val message = assertFailsWith<FigureException> { broken.png() }.message.orEmpty()
        assertContains(message, "cannot draw \"t\" as PNG")
    }
}
