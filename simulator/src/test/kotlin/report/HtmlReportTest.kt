package stillwater.report

import com.github.ajalt.mordant.rendering.AnsiLevel
import com.github.ajalt.mordant.terminal.Terminal
import com.github.ajalt.mordant.terminal.TerminalRecorder
import stillwater.plot.Histogram
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse

class HtmlReportTest {
    private val evil = "<script>alert('x')</script> & \"quoted\""
    private val table = Table.of(listOf("walk" to 0.0396, evil to Double.NaN)) {
        text("Planner $evil") { it.first }
        number("Error") { it.second }
        count("Moves") { 2000 }
    }

    private fun page(): String = HtmlReport(evil, evil, Provenance("1 $evil", "stillwater $evil", 7)).apply {
        answer(evil)
        summary(evil, evil)
        warning(evil)
        section(evil) {
            paragraph(evil)
            table(table, evil)
            keyValues(listOf(evil to evil))
            warnings(listOf(evil))
            figure(Histogram.of(evil, evil, doubleArrayOf(1.0, 2.0), 2, evil).draw(), evil)
            details(evil) { code(evil) }
        }
    }.render()

    @Test
    fun everyTextIsEscaped() {
        val html = page()
        assertFalse("<script" in html)
        assertEquals(0, Regex("& ").findAll(html.replace("&amp; ", "")).count(), "bare ampersands")
        assertContains(html, "&lt;script&gt;")
    }

    @Test
    fun thePageNeedsNothingFromOutside() {
        val outside = Regex("(?i)<link|src=|@import|url\\((?!#)|href=\"(?!#)").find(page())
        assertEquals(null, outside?.value)
    }

    @Test
    fun footerSaysHowToRepeatTheRun() {
        val footer = page().substringAfter("<footer>")
        assertContains(footer, "Stillwater 1 ")
        assertContains(footer, "<code>stillwater ")
        assertContains(footer, "7")
        assertContains(HtmlReport("t", "", Provenance("1", "c", 7, "Bootstrap seed")).render(), "Bootstrap seed: ")
        val calm = HtmlReport("t", "", Provenance("1", "c")).render()
        assertFalse("Seed" in calm)
        assertFalse("class=\"warnings\"" in calm)
    }

    @Test
    fun numbersStandToTheRight() {
        val html = page()
        assertContains(html, "<td class=\"number\">0.0396</td>")
        assertContains(html, "<td>walk</td>")
        assertContains(html, "<td class=\"number\">–</td>")
    }

    @Test
    fun theSameReportGivesTheSameText() {
        assertEquals(page(), page())
    }

    @Test
    fun theTerminalShowsTheSameCellsAlignedByColumn() {
        val recorder = TerminalRecorder(ansiLevel = AnsiLevel.NONE, width = 100)
        val small = Table.of(listOf("walk" to 0.0396, "lawnmower" to 12.0)) {
            text("Planner") { it.first }
            number("Error") { it.second }
        }
        Terminal(terminalInterface = recorder).println(small.toTerminal())
        val lines = recorder.output().lines().filter { it.isNotBlank() }.map { it.trimEnd() }
        assertEquals(4, lines.size)
        assertEquals(lines[2].length, lines[3].length, "numbers end in one column")
        assertContains(lines[2], "walk")
    }

    @Test
    fun rowsMustFitTheColumns() {
        val columns = listOf(TableColumn("a", Align.LEFT))
        assertFailsWith<IllegalArgumentException> { Table(columns, listOf(listOf("1", "2"))) }
        assertFailsWith<IllegalArgumentException> { Table(emptyList(), emptyList()) }
    }
}
