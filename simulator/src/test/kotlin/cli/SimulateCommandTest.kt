package stillwater.cli

import com.github.ajalt.clikt.core.subcommands
import com.github.ajalt.clikt.testing.CliktCommandTestResult
import com.github.ajalt.clikt.testing.test
import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonArray
import kotlinx.serialization.json.JsonElement
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.JsonPrimitive
import kotlinx.serialization.json.doubleOrNull
import kotlinx.serialization.json.int
import kotlinx.serialization.json.jsonArray
import kotlinx.serialization.json.jsonObject
import kotlinx.serialization.json.jsonPrimitive
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.TestInstance
import org.junit.jupiter.api.io.TempDir
import stillwater.io.LogChoice
import stillwater.io.SurveyLog
import java.nio.file.Files
import java.nio.file.Path
import java.util.Locale
import kotlin.io.path.createDirectories
import kotlin.io.path.exists
import kotlin.io.path.listDirectoryEntries
import kotlin.io.path.name
import kotlin.io.path.readBytes
import kotlin.io.path.readLines
import kotlin.io.path.readText
import kotlin.io.path.writeText
import kotlin.test.assertContentEquals
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

@TestInstance(TestInstance.Lifecycle.PER_CLASS)
class SimulateCommandTest {
    private val mission by lazy { directory.resolve("pond.json").apply { writeText(POND) } }

    /** The one run that most tests look at. */
    private val sailed by lazy { directory.resolve("sailed").also { assertEquals(0, simulate(it).statusCode) } }

    private fun simulate(out: Path, vararg more: String): CliktCommandTestResult = Stillwater()
        .subcommands(SimulateCommand(), MapCommand())
        .test(listOf("simulate", mission.toString(), "--out", out.toString(), "--probe-period", "1") + OPTIONS + more)

    private fun summary(): JsonObject = Json.parseToJsonElement(sailed.resolve("summary.json").readText()).jsonObject

    @Test
    fun itWritesAllThatItPromises() {
        val names = sailed.listDirectoryEntries().map { it.name }.toSet()
        for (name in listOf("mission.txt", "cells.csv", "summary.json", "animation.html", "report.html")) {
            assertTrue(name in names, "$name in $names")
        }
        for (figure in listOf("estimate", "water", "error", "track", "trace", "error-over-time")) {
            assertTrue("$figure.svg" in names, "$figure.svg in $names")
        }
        assertEquals(37, sailed.resolve("cells.csv").readLines().size)
        assertEquals(true, summary().getValue("over").jsonPrimitive.content.toBoolean())
    }

    @Test
    fun aLogFromTheWaterIsNotReplaced() {
        val log = directory.resolve("afloat").createDirectories().resolve("mission.txt").apply { writeText("measured") }
        val result = simulate(log.parent)
        assertEquals(2, result.statusCode, result.output)
        assertTrue("has the log of another mission" in result.output, result.output)
        assertEquals("measured", log.readText())
    }

    @Test
    fun otherCommandsDoNotReplaceAMissionsFiles() {
        val cells = sailed.resolve("cells.csv").readText()
        val log = sailed.resolve("mission.txt").toString()
        val commands = listOf("map", "correct", "diagnose").map { listOf(it, log) } + listOf(listOf("benchmark"))
        for (arguments in commands) {
            val result = Stillwater().subcommands(commands()).test(arguments + listOf("--out", "$sailed"))
            assertEquals(BAD_INPUT, result.statusCode, "$arguments: ${result.output}")
            assertTrue("$sailed has the log of a mission, $log; name another" in result.stderr, result.stderr)
            assertEquals(cells, sailed.resolve("cells.csv").readText())
        }
    }

    @Test
    fun theSummaryIsWhatItWas() {
        // To three digits: what is not exact may differ in its last bits on another machine.
        val found = shortened(summary()).toString().replace(",\"", ",\n\"") + "\n"
        val golden = javaClass.getResource("/stillwater/simulation/summary-golden.txt")?.readText()
        if (found != golden) {
            Path.of("target/golden").createDirectories().resolve("summary-golden.txt").writeText(found)
        }
        assertEquals(golden, found, "target/golden/summary-golden.txt has what was found")
    }

    private fun shortened(json: JsonElement): JsonElement = when (json) {
        is JsonObject -> JsonObject(json.mapValues { shortened(it.value) })
        is JsonArray -> JsonArray(json.map(::shortened))
        is JsonPrimitive -> json.doubleOrNull?.takeIf { !json.isString && '.' in json.content }
            ?.let { JsonPrimitive(String.format(Locale.ROOT, "%.3g", it)) } ?: json
    }

    @Test
    fun theSameSeedGivesTheSameBytes() {
        val again = directory.resolve("again")
        simulate(again, "--quiet")
        for (file in listOf("mission.txt", "cells.csv", "summary.json", "animation.html", "track.svg")) {
            assertContentEquals(sailed.resolve(file).readBytes(), again.resolve(file).readBytes(), file)
        }
        val other = directory.resolve("other")
        simulate(other, "--quiet", "--seed", "8")
        assertFalse(other.resolve("cells.csv").readText() == sailed.resolve("cells.csv").readText())
    }

    @Test
    fun itsLogIsReadBackByMap() {
        val readings = summary().getValue("readings").jsonObject
        assertEquals(true, readings.getValue("complete").jsonPrimitive.content.toBoolean())
        val log = SurveyLog.open(sailed.resolve("mission.txt"), LogChoice(value = "ATLAS_DO"))
        assertEquals("Platypus log 4.2.0", log.format)
        var rows = 0
        log.read { _, _, _, _, _ -> rows++ }
        assertEquals(readings.getValue("received").jsonPrimitive.int, rows)
        val out = directory.resolve("map")
        val result = Stillwater().subcommands(MapCommand())
            .test(listOf("map", "${sailed.resolve("mission.txt")}", "--value", "ATLAS_DO", "--out", "$out"))
        assertEquals(0, result.statusCode, result.output)
        assertTrue(out.resolve("cells.csv").exists())
    }

    @Test
    fun theAnimationStandsAlone() {
        val page = sailed.resolve("animation.html").readText()
        for (outside in listOf("http:", "https:", "src=", "<link", "import(", "@import", "url(")) {
            assertFalse(outside in page, "'$outside' in the page")
        }
        assertFalse("__DATA__" in page)
        val text = page.substringAfter("id=\"data\">").substringBefore("</script>")
        val data = Json.parseToJsonElement(text).jsonObject
        val frames = data.getValue("t").jsonArray.size
        assertTrue(frames > 300, "$frames frames")
        for (name in listOf("x", "y", "state", "reading", "lower", "upper", "under", "plan", "changes", "volts")) {
            assertEquals(frames, data.getValue(name).jsonArray.size, name)
        }
        assertEquals(36, data.getValue("cells").jsonArray.size)
        // The name has markup in it, which must not become markup.
        assertTrue("<b>" !in text && "pond <b>" == data.getValue("title").jsonPrimitive.content)
    }

    @Test
    fun whatIsWrongIsSaidInOneLineAndNothingIsTouched() {
        val wrong = directory.resolve("wrong.json").apply { writeText(POND.replace("lawnmower", "mower")) }
        val acid = directory.resolve("acid.json").apply { writeText(POND.replace("dissolved-oxygen", "acidity")) }
        val port = directory.resolve("port.json").apply { writeText(POND.replace("\"port\": 1", "\"port\": 2")) }
        val text = directory.resolve("text.json").apply { writeText("no sensor") }
        for ((arguments, expected) in listOf(
            listOf("$directory/none.json") to "none.json: expected a mission (JSON), found no such file",
            listOf("$wrong") to "wrong.json:7:14: planner: expected one of",
            listOf("$acid") to "probe.quantity: expected dissolved-oxygen",
            listOf("$port") to "probe.port: expected dissolved-oxygen on port 1",
            listOf("$mission", "--sensor", "$text") to "text.json:1:1: expected an object in braces with name, stages",
            listOf("$mission", "--field", "calm") to "--field: expected one of uniform, gaussian, smooth",
            listOf("$mission", "--field-range", "5,2") to "--field-range: expected two numbers, the first below",
            listOf(
                "$mission",
                "--field-range=-1e308,1e308",
            ) to "--field-range: expected numbers within -1.0E60..1.0E60",
            listOf("$mission", "--field-range", "0,1e-300") to "--field-range: expected a range with an end beyond",
            listOf("$mission", "--wind", "strong") to "--wind: expected velocities east and north",
            listOf(
                "$mission",
                "--current-turn",
                "60",
            ) to "--current-turn: expected --current to go with it, found none",
            listOf("$mission", "--headless", "--speed", "9") to "--speed: expected a mission that is shown as it runs",
            listOf("$mission", "--current", "0.3") to "--current: expected velocities east and north",
            listOf("$mission", "--current", "0.3,inf") to "--current: expected velocities east and north",
            listOf("$mission", "--link-loss", "1.5") to "--link-loss: expected a number within 0..1",
            listOf("$mission", "--seed", "one") to "--seed: expected a whole number",
            listOf("$mission", "--probe-period", "0") to "--probe-period: expected a number within",
            listOf("$mission", "--longest", "-1") to "--longest: expected a number within",
        )) {
            val out = directory.resolve("refused").createDirectories()
            out.resolve("cells.csv").writeText("earlier")
            val result = Stillwater().subcommands(SimulateCommand())
                .test(listOf("simulate") + arguments + listOf("--out", "$out"))
            assertEquals(BAD_INPUT, result.statusCode, "$arguments: ${result.output}")
            assertTrue(expected in result.stderr, "$arguments: ${result.stderr}")
            assertEquals(1, result.stderr.trim().lines().size, result.stderr)
            assertEquals(listOf("cells.csv"), Files.list(out).use { files -> files.map { it.name }.toList() })
            assertEquals("earlier", out.resolve("cells.csv").readText())
        }
    }

    @Test
    fun aMissionTooShortToSetOutSaysThatNothingWasSurveyed() {
        val short = directory.resolve("short.json").apply { writeText(POND.replace("300", "5")) }
        val out = directory.resolve("short")
        val result = Stillwater().subcommands(SimulateCommand()).test("simulate $short --out $out --headless")
        assertEquals(0, result.statusCode, result.output)
        assertTrue(", nothing surveyed\n" in result.stdout, result.stdout)
        assertTrue("warning: nothing was surveyed: the budget was spent before" in result.stderr, result.stderr)
        assertFalse("nothing was surveyed" in summary().getValue("warnings").toString())
    }

    @Test
    fun readingsThatWereAllRefusedAreNoBudgetSpent() {
        val stages = """[{"type": "first-order-lag", "time_constant_s": 10}, {"type": "saturation", "lower": 120}]"""
        val sensor = directory.resolve("high.json").apply { writeText("""{"name": "high", "stages": $stages}""") }
        val result = simulate(directory.resolve("high"), "--sensor", "$sensor")
        assertEquals(0, result.statusCode, result.output)
        val why = Regex("nothing was surveyed: all \\d+ readings were refused: outside of the probe's range, 0 to 15 ")
        assertTrue(why.containsMatchIn(result.stderr), result.stderr)
        assertFalse("budget" in result.stderr, result.stderr)
    }

    @Test
    fun theSummaryCanBePrintedAsJson() {
        val result = simulate(directory.resolve("json"), "--json", "--longest", "20")
        val json = Json.parseToJsonElement(result.stdout).jsonObject
        assertEquals(false, json.getValue("over").jsonPrimitive.content.toBoolean())
        assertTrue(json.getValue("warnings").jsonArray.any { "was not over" in it.jsonPrimitive.content })
    }

    private companion object {
        @TempDir
        @JvmStatic
        lateinit var directory: Path

        val OPTIONS = listOf("--headless", "--seed", "7", "--current", "-0.1,0.05", "--current-turn", "600")
        const val POND = """{
  "name": "pond <b>",
  "origin": {"lat_deg": 45.5, "lon_deg": -73.6},
  "area": {"south_west": {"x_m": -20, "y_m": -20}, "north_east": {"x_m": 80, "y_m": 80}},
  "grid": {"south_west": {"x_m": 0, "y_m": 0}, "columns": 6, "rows": 6, "cell_m": 10},
  "probe": {"quantity": "dissolved-oxygen", "port": 1, "lowest": 0, "highest": 15},
  "planner": "lawnmower",
  "budget": {"seconds": 300},
  "home": {"x_m": 5, "y_m": 5}
}
"""
    }
}
