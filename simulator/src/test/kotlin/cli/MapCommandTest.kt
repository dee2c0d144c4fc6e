package stillwater.cli

import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.jsonArray
import kotlinx.serialization.json.jsonObject
import kotlinx.serialization.json.jsonPrimitive
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import java.nio.file.Path
import kotlin.io.path.exists
import kotlin.io.path.readLines
import kotlin.io.path.readText
import kotlin.io.path.writeText
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class MapCommandTest {
    @TempDir
    private lateinit var directory: Path

    private fun log(text: String = smallSurvey()): String =
        directory.resolve("survey.csv").apply { writeText(text) }.toString()

    private fun cells(): List<List<String>> =
        directory.out().resolve("cells.csv").readLines().drop(1).map { it.split(',') }

    @Test
    fun writesCellsFiguresAndReport() {
        val result = runMap(log(), "--out", directory.out().toString(), "--filter", "averaging,exponential,bounded")
        assertEquals(0, result.statusCode, result.output)
        for (name in listOf(
            "track",
            "estimate-averaging",
            "estimate-exponential",
            "estimate-bounded",
            "bounds-width",
        )) {
            assertTrue(directory.out().resolve("$name.svg").exists(), name)
            assertTrue(directory.out().resolve("$name.png").exists(), name)
        }
        assertContains(directory.out().resolve("report.html").readText(), "Do opposite passes agree?")
        val rows = cells()
        assertEquals(listOf("averaging", "exponential", "bounded"), rows.map { it[0] }.distinct())
        assertEquals(200, rows.filter { it[0] == "averaging" }.sumOf { it[11].toInt() })
    }

    @Test
    fun takesTheMeanOfEachCellsReadings() {
        val text = "time_s,x_m,y_m,v\n0,1,1,1\n1,2,1,2\n2,11,1,5\n3,12,1,7\n4,13,1,9\n"
        val out = directory.out().toString()
        runMap(log(text), "--out", out, "--cell", "10", "--filter", "averaging", "--quiet")
        val rows = cells()
        assertEquals(listOf("1.5", "7.0"), rows.map { it[7] })
        assertEquals(listOf("2", "3"), rows.map { it[11] })
        assertEquals(listOf("", ""), rows.map { it[5] }, "no latitudes in this log")
    }

    @Test
    fun writesGeoJsonOfVisitedCells() {
        runMap(log(), "--out", directory.out().toString(), "--filter", "averaging", "--quiet")
        val features = Json.parseToJsonElement(directory.out().resolve("cells.geojson").readText())
            .jsonObject.getValue("features").jsonArray
        assertEquals(cells().count { it[10] != "0" }, features.size)
        val ring = features[0].jsonObject.getValue("geometry").jsonObject.getValue("coordinates").jsonArray[0].jsonArray
        assertEquals(5, ring.size)
        assertEquals(ring.first(), ring.last())
    }

    @Test
    fun printsASummaryForMachines() {
        val result = runMap(log(), "--out", directory.out().toString(), "--json", "--grid", "4x3")
        val summary = Json.parseToJsonElement(result.stdout).jsonObject
        assertEquals("200", summary.getValue("readings").jsonPrimitive.content)
        assertEquals("4", summary.getValue("grid").jsonObject.getValue("columns").jsonPrimitive.content)
        assertTrue(summary.getValue("legs") is JsonObject)
        assertEquals("", result.stderr)
    }

    @Test
    fun saysNothingWhenAskedTo() {
        val result = runMap(log(), "--out", directory.out().toString(), "--quiet", "--filter", "averaging")
        assertEquals("", result.output)
    }

    @Test
    fun givesTheSameBytesEveryTime() {
        val (once, again) = listOf("once", "again").map { name ->
            runMap(log(), "--out", directory.resolve(name).toString(), "--quiet")
            directory.resolve(name)
        }
        for (name in listOf("cells.csv", "cells.geojson", "track.svg", "estimate-bounded.svg")) {
            assertEquals(once.resolve(name).readText(), again.resolve(name).readText(), name)
        }
    }

    @Test
    fun leavesOlderResultsAloneWhenSomethingIsWrong() {
        val out = directory.out()
        runMap(log(), "--out", out.toString(), "--quiet")
        val before = out.resolve("cells.csv").readText()
        val result = runMap(log(smallSurvey() + "1,45,7,8\n"), "--out", out.toString(), "--quiet")
        assertEquals(BAD_INPUT, result.statusCode)
        assertEquals(before, out.resolve("cells.csv").readText())
    }

    @Test
    fun acceptsMarksLineEndsSeparatorsAndQuotes() {
        val plain = smallSurvey()
        fun bytes(text: String): String {
            directory.resolve("survey.csv").toFile().writeText(text)
            val result = runMap(log(text), "--out", directory.out().toString(), "--quiet", "--filter", "averaging")
            assertEquals(0, result.statusCode, result.output)
            return directory.out().resolve("cells.csv").readText()
        }
        val expected = bytes(plain)
        assertEquals(expected, bytes("\uFEFF$plain"), "byte order mark")
        assertEquals(expected, bytes(plain.replace("\n", "\r\n")), "CRLF")
        assertEquals(expected, bytes(plain.replace(",", ";")), "semicolons")
        assertEquals(expected, bytes(plain.replace(",", "\t")), "tabs")
        assertEquals(expected, bytes(plain.replace(",", " , ")), "blanks")
        assertEquals(expected, bytes(plain.trimEnd()), "no last line end")
        assertEquals(
            expected,
            bytes(
                plain.lines().joinToString("\n") {
                    it.replace(Regex("[^,]+"), "\"$0\"")
                },
            ),
            "quotes",
        )
    }

    @Test
    fun leavesOutPositionsWithoutAFix() {
        val lines = smallSurvey().lines()
        val text = (lines.take(1) + listOf("-2,0,0,8", "-1,0.0,0.0,8") + lines.drop(1)).joinToString("\n")
        val result = runMap(log(text), "--out", directory.out().toString(), "--filter", "averaging")
        assertContains(result.stdout, Regex("""positions without a fix \(0, 0\) +2 skipped"""))
    }

    @Test
    fun showsExamplesInItsHelp() {
        val help = runMap("--help")
        assertEquals(0, help.statusCode)
        assertContains(help.stdout, "stillwater map survey.csv --value odo_percent_sat --unit %sat --out map")
    }
}
