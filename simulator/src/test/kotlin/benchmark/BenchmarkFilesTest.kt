package stillwater.benchmark

import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonArray
import kotlinx.serialization.json.JsonNull
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.double
import kotlinx.serialization.json.int
import kotlinx.serialization.json.jsonArray
import kotlinx.serialization.json.jsonObject
import kotlinx.serialization.json.jsonPrimitive
import org.junit.jupiter.api.io.TempDir
import stillwater.benchmark.HandMadeResult.Companion.BOUNDED
import stillwater.benchmark.HandMadeResult.Companion.WALK
import stillwater.plot.Figure
import stillwater.report.OutputDirectory
import stillwater.report.writeFigures
import stillwater.run.ExperimentResult
import stillwater.run.Preset
import stillwater.sensor.SensorSpec
import java.nio.file.Path
import kotlin.io.path.exists
import kotlin.io.path.readBytes
import kotlin.io.path.readLines
import kotlin.io.path.readText
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class BenchmarkFilesTest {
    @TempDir
    private lateinit var directory: Path
    private val out: Path get() = directory.resolve("results")
    private val result = HandMadeResult.likeTheReport()

    private fun write(result: ExperimentResult): List<String> {
        val written = OutputDirectory(out).use {
            val warnings = BenchmarkFiles(result, "stillwater benchmark --out <here> & there").write(it)
            assertEquals(emptyList(), warnings)
            it.commit()
        }
        return written.map { it.fileName.toString() }
    }

    private fun rows(name: String) = out.resolve(name).readLines().drop(1).map { it.split(',') }

    @Test
    fun everyFileIsWritten() {
        assertEquals(
            listOf(
                "results.csv",
                "extremes.csv",
                "bounds.csv",
                "sensor.json",
                "figure-6.svg",
                "figure-6.png",
                "figure-7.svg",
                "figure-7.png",
                "report.html",
            ),
            write(result),
        )
        assertContains(out.resolve("figure-7.svg").readText(), "mixture of Gaussians")
        assertEquals("PNG", String(out.resolve("figure-6.png").readBytes(), 1, 3, Charsets.US_ASCII))
        assertEquals(result.settings.sensor, SensorSpec.fromJson(out.resolve("sensor.json").readText()))
    }

    @Test
    fun resultsHaveTheColumnsOfTheIssueAndARowForEachCheckpointOfEachCurve() {
        write(result)
        val header = out.resolve("results.csv").readLines().first()
        assertEquals(
            "field,filter,planner,sensor,move,environments,mean_abs_error,standard_error,p10,p90,boats",
            header,
        )
        val rows = rows("results.csv")
        assertEquals(8 * 3, rows.size)
        assertEquals(
            listOf("uniform", "bounded", "random-walk", "first-order-lag", "50", "2", "0.25"),
            rows.first().take(7),
        )
        // Two environments, 1/1024 either side of the mean: the standard error is 1/1024, the percentiles are the ends.
        assertEquals(1.0 / 1024, rows.first()[7].toDouble(), 1e-18, "rounding of two roots")
        assertEquals(listOf(0.25 - 1.0 / 1024, 0.25 + 1.0 / 1024), rows.first().drop(8).take(2).map { it.toDouble() })
        assertEquals("1", rows.first()[10], "boats")
    }

    @Test
    fun extremesTellTheShareOfCellsAndOfError() {
        write(result)
        assertEquals(
            "field,filter,planner,move,share_of_cells,share_of_error,boats",
            out.resolve("extremes.csv").readLines()[0],
        )
        assertEquals(
            listOf("uniform", "bounded", "random-walk", "50", "0.4375", "0.5", "1"),
            rows("extremes.csv").first(),
        )
    }

    @Test
    fun boundsTellHowOftenTheyHoldAndHowWideTheyAreForFiltersThatGiveThem() {
        write(result)
        assertEquals(
            "field,filter,planner,move,coverage,standard_error,mean_width,boats",
            out.resolve("bounds.csv").readLines()[0],
        )
        val rows = rows("bounds.csv")
        // Two environments, 0.75 and 1: mean 0.875, standard error 0.125.
        assertEquals(listOf("uniform", "bounded", "random-walk", "50", "0.875", "0.125", "0.25", "1"), rows.first())
        assertEquals(setOf("bounded"), rows.map { it[1] }.toSet(), "averaging gives none")
        assertContains(out.resolve("report.html").readText(), "0.875")
        val first = json(result).getValue("results").jsonArray.map { it.jsonObject }
        assertEquals(0.875, first[0].getValue("coverage").jsonPrimitive.double)
        assertEquals(JsonNull, first.first { it["filter"]?.jsonPrimitive?.content == "averaging" }["coverage"])
    }

    @Test
    fun oneEnvironmentLeavesTheStandardErrorEmptyAndNothingElse() {
        write(HandMadeResult.likeTheReport(environments = 1))
        for (row in rows("results.csv")) {
            assertEquals("", row[7])
            assertTrue((row - row[7]).none { it.isEmpty() || it == "NaN" }, "$row")
        }
        assertFalse("NaN" in out.resolve("figure-6.svg").readText())
        assertFalse("NaN" in out.resolve("report.html").readText())
    }

    private fun json(result: ExperimentResult): JsonObject =
        Json.parseToJsonElement(BenchmarkJson.text(result, listOf(Path.of("a b", "results.csv")))).jsonObject

    @Test
    fun jsonAgreesWithTheCsv() {
        write(result)
        val json = json(result)
        val found = json.getValue("results").jsonArray.map { it.jsonObject }
        val rows = rows("results.csv")
        assertEquals(rows.size, found.size)
        for ((row, item) in rows.zip(found)) {
            assertEquals(row[0], item.getValue("field").jsonPrimitive.content)
            assertEquals(row[1], item.getValue("filter").jsonPrimitive.content)
            assertEquals(row[2], item.getValue("planner").jsonPrimitive.content)
            assertEquals(row[4].toInt(), item.getValue("move").jsonPrimitive.int)
            val numbers = listOf("mean_abs_error", "standard_error", "p10", "p90", "boats")
            assertEquals(row.drop(6).map { it.toDouble() }, numbers.map { item.getValue(it).jsonPrimitive.double })
        }
        assertEquals(rows.map { it[3] }.distinct(), listOf(json.getValue("sensor").jsonPrimitive.content))
        assertEquals(rows.map { it[5] }.distinct(), listOf(json.getValue("environments").jsonPrimitive.content))
    }

    @Test
    fun jsonHasTheClaimsAndTheFiles() {
        val json = json(result)
        val claims = json.getValue("claims").jsonArray.map { it.jsonObject }
        val expected = ReportClaims(result).all()
        assertEquals(expected.map { it.text }, claims.map { it.getValue("claim").jsonPrimitive.content })
        assertEquals(expected.map { it.verdict.label }, claims.map { it.getValue("verdict").jsonPrimitive.content })
        assertEquals(expected.map { it.detail }, claims.map { it.getValue("detail").jsonPrimitive.content })
        val file = json.getValue("files").jsonArray.single().jsonPrimitive.content
        assertEquals(Path.of("a b", "results.csv"), Path.of(file))
    }

    @Test
    fun jsonHasNullWhereThereIsNoNumber() {
        val made = HandMadeResult(environments = 1)
        val one = made.curve(WALK, BOUNDED, 0.5, Double.NaN, Double.POSITIVE_INFINITY).build()
        val results: JsonArray = json(one).getValue("results").jsonArray
        assertEquals(JsonNull, results[0].jsonObject["standard_error"])
        for (item in results.drop(1)) {
            for (name in listOf("mean_abs_error", "p10", "p90")) assertEquals(JsonNull, item.jsonObject[name], name)
        }
    }

    @Test
    fun theReportNeedsNothingFromOutsideAndRunsNothing() {
        write(result)
        val page = out.resolve("report.html").readText()
        assertEquals(null, Regex("""(?i)<script|(src|href)\s*=\s*["']?\s*(https?:)?//|@import""").find(page)?.value)
        assertEquals(2, Regex("<svg").findAll(page).count(), "one figure for each field")
    }

    @Test
    fun theReportTellsTheClaimsTheSettingsAndTheCommand() {
        write(result)
        val page = out.resolve("report.html").readText()
        for (claim in ReportClaims(result).all()) assertContains(page, claim.detail)
        assertContains(page, "stillwater benchmark --out &lt;here&gt; &amp; there")
        assertContains(page, "10 x 10 cells, prior 0.0 to 1.0")
        assertContains(page, "horizon 10, 200 expansions, largest change 0.5")
        assertContains(page, "time_constant_s")
    }

    @Test
    fun theReportLeavesOutTheClaimsWhereThereAreNone() {
        write(HandMadeResult().curve(WALK, BOUNDED, 0.5, 0.25, 0.125).build())
        assertFalse("The report's claims" in out.resolve("report.html").readText().replace("&#39;", "'"))
        assertFalse(out.resolve("figure-7.svg").exists())
    }

    @Test
    fun aPngThatCannotBeDrawnIsOneWarningAndItsSvgIsWritten() {
        val broken = "<svg xmlns='http://www.w3.org/2000/svg'><g>"
        val figures = listOf("a", "b").map { it to Figure("figure $it", broken, 300, 300) }
        OutputDirectory(out).use {
            val warning = it.writeFigures(figures).single()
            assertContains(warning, "no PNG figures: cannot draw \"figure a\" as PNG")
            assertEquals(1, warning.lines().size)
            assertEquals(listOf("a.svg", "b.svg"), it.commit().map { path -> path.fileName.toString() })
        }
        assertEquals(broken, out.resolve("b.svg").readText())
    }

    @Test
    fun theFieldsOfThePresetsAreTheReportsFigures() {
        assertEquals(listOf("figure-6", "figure-7"), BenchmarkFigures.of(result).map { it.name })
        assertEquals(listOf(Preset.UNIFORM, Preset.GAUSSIAN), result.settings.fields.keys.toList())
    }
}
