package stillwater.correct

import com.github.ajalt.clikt.core.subcommands
import com.github.ajalt.clikt.testing.CliktCommandTestResult
import com.github.ajalt.clikt.testing.test
import kotlinx.serialization.json.Json
import kotlinx.serialization.json.double
import kotlinx.serialization.json.jsonArray
import kotlinx.serialization.json.jsonObject
import kotlinx.serialization.json.jsonPrimitive
import org.junit.jupiter.api.Assumptions.assumeTrue
import org.junit.jupiter.api.Tag
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import stillwater.cli.CorrectCommand
import stillwater.cli.Stillwater
import stillwater.sensor.SensorSpec
import java.nio.file.Files
import java.nio.file.Path
import java.time.Instant
import kotlin.io.path.exists
import kotlin.io.path.readLines
import kotlin.io.path.readText
import kotlin.io.path.writeText
import kotlin.math.sin
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class CorrectCommandTest {
    @TempDir
    private lateinit var directory: Path

    private val out: Path get() = directory.resolve("results")

    private fun run(vararg arguments: String): CliktCommandTestResult =
        Stillwater().subcommands(CorrectCommand()).test(listOf("correct") + arguments + listOf("--out", out.toString()))

    private fun log(text: String): String = directory.resolve("log.csv").also { it.writeText(text) }.toString()

    private fun file(name: String, text: String) = directory.resolve(name).also { it.writeText(text) }.toString()

    private fun survey(rows: Int = 120) = buildString {
        appendLine("time_s,x_m,y_m,slow,fast,note")
        for (i in 0 until rows) appendLine("$i,$i,0,${water(i - 5)},${water(i)},\"a, b\"")
    }

    /** Two waves, with the two digits that an instrument shows. */
    private fun water(t: Int) = Math.round(100 * (sin(t / 9.0) + sin(t / 4.1))) / 100.0

    private fun spec(json: String): String = directory.resolve("sensor.json").also { it.writeText(json) }.toString()

    @Test
    fun everyRowIsWrittenWithItsOwnColumns() {
        val text = survey().replace("\n7,7,", "\n7,,")
        val result = run(log(text), "--value", "slow", "--skip-bad-rows")
        assertEquals(0, result.statusCode, result.output)
        val lines = out.resolve("corrected.csv").readLines()
        assertEquals(121, lines.size)
        assertEquals("time_s,x_m,y_m,slow,fast,note,corrected,corrected_low,corrected_high", lines[0])
        assertTrue(lines[8].endsWith(",,,"), lines[8])
        assertContains(lines[1], "\"a, b\"")
        assertContains(result.stderr, "1 row could not be used and has empty cells")
        for (name in listOf("sensor.json", "summary.json", "report.html", "corrected.svg", "corrected.png")) {
            assertTrue(out.resolve(name).exists(), name)
        }
    }

    @Test
    fun rowsThatShareAWholeSecondKeepTheirTimesAndAreAllCorrected() {
        val rows = (0 until 120).map { "${it / 2},$it,0,${water(it - 5)}" }
        val result = run(log((listOf("time_s,x_m,y_m,slow") + rows).joinToString("\n")), "--value", "slow")
        assertEquals(0, result.statusCode, result.output)
        assertContains(result.stderr, "times are whole seconds (60 rows of the time of the row before)")
        val lines = out.resolve("corrected.csv").readLines().drop(1)
        assertEquals(rows, lines.map { it.split(',').take(4).joinToString(",") })
        assertEquals(emptyList(), lines.filter { it.endsWith(",") })
    }

    @Test
    fun allBytesOfTheLogAreKept() {
        for ((name, charset, mark) in listOf(
            Triple("utf-8", Charsets.UTF_8, ""),
            Triple("with a mark", Charsets.UTF_8, "\uFEFF"),
            Triple("utf-16", Charsets.UTF_16LE, "\uFEFF"),
        )) {
            val text = survey(60).replace("\"a, b\"", "\"ä \"\"b\"\"\nc\"").replace("\n", "\r\n")
                .replace("\r\n9,9,0", "\r\n# a remark\r\n\r\n 9,\"9\",0").trimEnd()
            val file = directory.resolve("log.csv").also { Files.write(it, (mark + text).toByteArray(charset)) }
            val result = run(file.toString(), "--value", "slow", "--skip-bad-rows")
            assertEquals(0, result.statusCode, "$name: ${result.output}")
            val written = String(Files.readAllBytes(out.resolve("corrected.csv")), charset)
            val own = written.replace(",corrected,corrected_low,corrected_high", "")
                .replace(Regex("""("),[-0-9.E]+,[-0-9.E]+,[-0-9.E]+(?=\r\n|$)"""), "$1")
            assertEquals(mark + text, own, name)
            assertEquals(60, Regex("""c",[-0-9.E]+,[-0-9.E]+,[-0-9.E]+""").findAll(written).count(), name)
        }
    }

    @Test
    fun trackWithoutRevisitsSaysSoAndDoesNotInventASensor() {
        val result = run(log(survey()), "--value", "slow")
        assertContains(result.stderr, "no pass comes near another")
        assertEquals("nothing", summary().getValue("sensor_from").jsonPrimitive.content)
    }

    @Test
    fun referenceColumnTeachesTheDelayAndTheSpecIsReadAgain() {
        val file = log(survey(600))
        assertEquals(0, run(file, "--value", "slow", "--reference", "fast").statusCode)
        val candidate = summary().getValue("candidates").jsonArray.map { it.jsonObject }
            .first { it.getValue("response").jsonPrimitive.content == "dead-time" }
        // 5 s late. Half a second: the reference is known each second, and between, a straight line smooths its
        // rounding.
        assertEquals(5.0, candidate.getValue("mean_delay_s").jsonPrimitive.double, 0.5)
        val learned = out.resolve("sensor.json")
        SensorSpec.fromJson(learned.readText())
        val copy = directory.resolve("learned.json").also { Files.copy(learned, it) }
        assertEquals(0, run(file, "--value", "slow", "--sensor", copy.toString()).statusCode)
        assertEquals("given", summary().getValue("sensor_from").jsonPrimitive.content)
    }

    @Test
    fun badInputIsOneLineAndLeavesNothing() {
        val file = log(survey())
        val lag = """{"type": "first-order-lag", "time_constant_s": 6.0}"""
        val twice = """{"name": "s", "stages": [{"type": "saturation", "upper": 5.0}, $lag]}"""
        val cases = listOf(
            listOf(file) to "--value",
            listOf(file, "--value", "fog") to "fog",
            listOf(file, "--value", "slow", "--reference", "fog") to "fog",
            listOf(file, "--value", "slow", "--sensor", "none.json") to "no such file",
            listOf(file, "--value", "slow", "--sensor", spec(twice)) to "cannot",
            listOf(file, "--value", "slow", "--sensor", spec(twice), "--reference", "fast") to "both",
            listOf(file, "--value", "slow", "--reference", "slow") to "another column",
            listOf(
                file("still.csv", survey().replace(Regex("[-0-9.]+,\"a"), "1,\"a")),
                "--value",
                "slow",
                "--reference",
                "fast",
            ) to
                "a reference that changes",
            listOf(file("again.csv", survey().replace("note", "corrected")), "--value", "slow") to
                "a log without this column",
            listOf(
                file("huge.csv", survey().replace("\n7,7,0,", "\n7,7,0,1e90,1,\n8,8,0,")),
                "--value",
                "slow",
            ) to
                "1.0E90",
            listOf(directory.resolve("short.csv").also { it.writeText(survey(5)) }.toString(), "--value", "slow") to
                "at least 30",
        )
        for ((arguments, word) in cases) {
            val result = run(*arguments.toTypedArray())
            assertEquals(2, result.statusCode, "$arguments: ${result.output}")
            assertContains(result.stderr, word)
            assertEquals(1, result.stderr.trim().lines().size, result.stderr)
            assertFalse(out.exists(), "$arguments")
        }
    }

    @Test
    fun boatAtRestAndConstantReadingsAreAnHonestAnswer() {
        val rest = survey().lines().joinToString("\n") { row ->
            row.split(',').let {
                if (it.size > 3 &&
                    it[0] != "time_s"
                ) {
                    "${it[0]},0,0,${it.drop(3).joinToString(",")}"
                } else {
                    row
                }
            }
        }
        val atRest = run(log(rest), "--value", "slow")
        assertEquals(0, atRest.statusCode, atRest.output)
        assertContains(atRest.stderr, "the boat never moves")
        val same = (0 until 200).joinToString("\n", "time_s,x_m,y_m,slow\n") { "$it,${it % 50},${it / 50},8" }
        val constant = run(log(same), "--value", "slow")
        assertEquals(0, constant.statusCode, constant.output)
        assertContains(constant.stderr, "the readings never change")
        assertContains(constant.stderr, "the readings are all the same, as a stuck sensor's")
        val (low, high) = out.resolve("corrected.csv").readLines()[50].split(',').takeLast(2).map { it.toDouble() }
        assertTrue(low <= 7.5 && high >= 8.5, "$low to $high: nobody knows the digits of an 8 behind the point")
        assertFalse("NaN" in constant.output, constant.output)
    }

    @Test
    fun severalColumnsAreCorrectedEachByItself() {
        // A reading of one column is missing where the other has one.
        val text = survey().replace("\n7,7,0,${water(2)},", "\n7,7,0,,")
        val both = run(log(text), "--value", "slow", "--value", "fast", "--skip-bad-rows", "--unit", "V", "--unit", "A")
        assertEquals(0, both.statusCode, both.output)
        val lines = out.resolve("corrected.csv").readLines()
        val names = listOf("slow", "fast").flatMap { listOf("", "_low", "_high").map { end -> "${it}_corrected$end" } }
        assertEquals("time_s,x_m,y_m,slow,fast,note," + names.joinToString(","), lines[0])
        assertEquals(text.trimEnd().lines().drop(1), lines.drop(1).map { it.split(',').take(7).joinToString(",") })
        assertEquals(listOf(true, false), lines[8].split(',').takeLast(6).chunked(3).map { it.all(String::isEmpty) })
        assertContains(both.stdout, "slow, as slow_corrected")
        assertContains(both.stdout, " A either way")
        assertContains(both.stderr, "slow: 1 row could not be used and has empty cells")
        val pairs = lines.drop(1).map { it.split(',').takeLast(6).chunked(3) }
        for ((i, column) in listOf("slow", "fast").withIndex()) {
            for (file in listOf("sensor.json", "summary.json", "report.html", "corrected.png")) {
                assertTrue(out.resolve("$column/$file").exists(), "$column/$file")
            }
            // By itself it comes to the same.
            val alone = run(log(text), "--value", column, "--skip-bad-rows")
            assertEquals(0, alone.statusCode, alone.output)
            val rows = out.resolve("corrected.csv").readLines().drop(1).map { it.split(',').takeLast(3) }
            assertEquals(pairs.map { it[i] }, rows, column)
        }
    }

    @Test
    fun timesAsTextAreFoundAgain() {
        val rows = survey().trimEnd().lines()
        val noon = Instant.parse("2025-06-01T12:00:00Z")
        val text = rows.drop(1).mapIndexed { i, row -> "${noon.plusSeconds(i.toLong())},${row.substringAfter(',')}" }
        val file = log((listOf(rows[0].replace("time_s", "stamp")) + text).joinToString("\n"))
        val result = run(file, "--time", "stamp", "--value", "slow")
        assertEquals(0, result.statusCode, result.output)
        val written = out.resolve("corrected.csv").readLines()
        assertEquals(text, written.drop(1).map { it.split(',').dropLast(3).joinToString(",") })
        assertTrue(written.drop(1).none { it.endsWith(",,,") })
    }

    @Test
    fun namesOfColumnsAreWrittenAsTheLogHasThem() {
        val degrees = "Temp, \u00B0C (no. \"7\")"
        val quoted = "\"${degrees.replace("\"", "\"\"")}\""
        for (charset in listOf(Charsets.UTF_8, Charsets.UTF_16LE)) {
            val text = "\uFEFF" + survey(60).replaceFirst("slow,fast", "$quoted,\u00B5S")
            val file = directory.resolve("log.csv").also { Files.write(it, text.toByteArray(charset)) }
            val result = run(file.toString(), "--value", degrees, "--value", "\u00B5S")
            assertEquals(0, result.statusCode, result.output)
            val header = String(Files.readAllBytes(out.resolve("corrected.csv")), charset).lines()[0].drop(1)
            val expected = listOf("", "_low", "_high").joinToString("") { ",${quoted.dropLast(1)}_corrected$it\"" }
            assertContains(header, "note$expected,\u00B5S_corrected,")
            assertFalse('\uFFFD' in header)
        }
    }

    @Test
    fun severalColumnsCannotShareWhatIsOfOne() {
        val file = log(survey())
        val two = listOf(file, "--value", "slow", "--value", "fast")
        val lag = spec("""{"name": "s", "stages": [{"type": "first-order-lag", "time_constant_s": 3}]}""")
        for ((arguments, word) in listOf(
            two + listOf("--reference", "x_m") to "--reference: expected one --value",
            two + listOf("--sensor", lag) to "--sensor: expected one --value",
            two + listOf("--unit", "V") to "--unit: expected one unit for each --value",
            listOf(file, "--value", "slow", "--value", "slow") to "--value: expected each column once",
        )) {
            val result = run(*arguments.toTypedArray())
            assertEquals(2, result.statusCode, result.output)
            assertContains(result.stderr, word)
            assertFalse(out.exists(), "$arguments")
        }
    }

    @Test
    fun timeConstantsBeyondAllLogsAreRefusedAndThoseBeyondThisOneAreSaid() {
        val file = log(survey())
        fun lag(time: String) =
            spec("""{"name": "s", "stages": [{"type": "first-order-lag", "time_constant_s": $time}]}""")
        for (time in listOf("1e308", "1.1e9")) {
            val refused = run(file, "--value", "slow", "--sensor", lag(time))
            assertEquals(2, refused.statusCode, refused.output)
            assertContains(refused.stderr, "stages[0].time_constant_s: expected at most 1.0E9 s")
        }
        val slow = run(file, "--value", "slow", "--sensor", lag("1e9"))
        assertEquals(0, slow.statusCode, slow.output)
        assertContains(slow.stderr, "is longer than the log (119 s)")
        assertFalse("NaN" in out.resolve("corrected.csv").readText())
    }

    @Test
    fun rowLeftOutForItsPlaceDoesNotTakeItsTwinsCells() {
        val rows = survey().lines().toMutableList()
        rows.add(8, rows[8].replaceFirst("7,7,", "7,,"))
        rows.add(20, "1,2")
        assertEquals(0, run(log(rows.joinToString("\n")), "--value", "slow", "--skip-bad-rows").statusCode)
        val lines = out.resolve("corrected.csv").readLines()
        assertTrue(lines[8].startsWith("7,,") && lines[8].endsWith(",,,"), lines[8])
        assertTrue(lines[9].startsWith("7,7,") && !lines[9].endsWith(",,,"), lines[9])
        // A row of another width stays as it is: added cells would stand under the log's own columns.
        assertEquals("1,2", lines[20])
    }

    @Test
    fun givenSensorIsDescribedInWords() {
        val limited = """{"name": "s", "stages": [{"type": "slew-limit", "rate_per_s": 0.0301749999}]}"""
        val result = run(log(survey()), "--value", "slow", "--sensor", spec(limited))
        assertContains(result.stdout, "sensor: slew-limit: rate per s 0.0302\n")
        assertContains(out.resolve("report.html").readText(), "A limit on the rate of change is recognised only where")
    }

    @Test
    @Tag("long")
    fun longLogOfShortLegsIsLearnedFromAPartOfIt() {
        val rows = 12_000
        val legs = buildString {
            appendLine("time_s,x_m,y_m,slow")
            for (i in 0 until rows) appendLine("$i,${along(i)},${i / 40},${water2(i - 5)}")
        }
        val result = run(log(legs), "--value", "slow")
        assertEquals(0, result.statusCode, result.output)
        assertEquals("revisits", summary().getValue("sensor_from").jsonPrimitive.content)
        assertContains(result.stderr, "readings in the middle of the log")
    }

    /** Legs of 40 m, there and back. */
    private fun along(t: Int) = Math.floorMod(t, 80).let { if (it < 40) it else 79 - it }

    private fun water2(t: Int) = Math.round(1000 * (sin(along(t) / 9.0) + sin(along(t) / 4.1 + t / 4000.0))) / 1000.0

    @Test
    @Tag("long")
    fun lacHertelsLegsAgreeBetterAndDeadTimeAndTimeConstantStayOpen() {
        val data = System.getenv("STILLWATER_DATA")
        assumeTrue(data != null, "STILLWATER_DATA names no directory with real logs: skipped")
        val file = Path.of(data).resolve("lac_hertel_asv/survey.csv").toString()
        assertEquals(0, run(file, "--value", "odo_percent_sat", "--held-out").statusCode)
        val summary = summary()
        // Issue 3 asks for 46 % on legs that nothing was learned on; it is 51 %.
        val gains = heldOut("opposite_legs").map { (before, after) -> 1 - after / before }
        assertTrue(gains.size == 4 && gains.average() >= 0.46, "$gains")
        val open = summary.getValue("open").jsonArray.map { it.jsonPrimitive.content }
        assertTrue("first-order-lag" in open && "dead-time" in open, "$open")
        assertFalse("none" in open, "$open")
    }

    @Test
    @Tag("long")
    fun gordonsCastsAgreeBetterAndTheFloatIsNotCalledAsymmetric() {
        val data = System.getenv("STILLWATER_DATA")
        assumeTrue(data != null, "STILLWATER_DATA names no directory with real logs: skipped")
        val file = Path.of(data).resolve("gordon2020_float/profiles.csv").toString()
        val flags = arrayOf("--x", "pres_dbar", "--value", "doxy_umol", "--held-out", "--between", "20:180")
        assertEquals(0, run(file, *flags).statusCode)
        val summary = summary()
        // Issue 3 asks for 15.4 to 4.0 umol on casts that nothing was learned on; it is 15.1 to 3.5.
        val left = heldOut("passes_rms")
        assertTrue(left.size == 4 && left.map { it.first }.average() > 14, "$left")
        assertTrue(left.map { it.second }.average() <= 4.0, "$left")
        assertFalse("asymmetric-lag" in summary.getValue("open").jsonArray.map { it.jsonPrimitive.content })
        val first = summary.getValue("candidates").jsonArray.map { it.jsonObject }
            .first { it.getValue("response").jsonPrimitive.content == "first-order-lag" }
        // Source's own fit: 76 s; two standard errors are 6 s.
        assertEquals(76.0, first.getValue("mean_delay_s").jsonPrimitive.double, 8.0)
    }

    @Test
    fun fewLegsAreNotHeldOut() {
        val result = run(log(survey()), "--value", "slow", "--held-out")
        assertContains(result.stdout, "held out: fewer than 8 legs")
        assertTrue(summary().getValue("held_out").jsonArray.isEmpty())
    }

    /** What of a [measure] there was before and after, for each part held out. */
    private fun heldOut(measure: String) = summary().getValue("held_out").jsonArray.map { it.jsonObject }
        .map { it.number("${measure}_before") to it.number("${measure}_after") }

    private fun summary() = Json.parseToJsonElement(out.resolve("summary.json").readText()).jsonObject

    private fun kotlinx.serialization.json.JsonObject.number(name: String) = getValue(name).jsonPrimitive.double
}
