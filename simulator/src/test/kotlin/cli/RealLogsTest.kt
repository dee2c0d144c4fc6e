package stillwater.cli

import com.github.ajalt.clikt.core.subcommands
import com.github.ajalt.clikt.testing.test
import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.double
import kotlinx.serialization.json.jsonArray
import kotlinx.serialization.json.jsonObject
import kotlinx.serialization.json.jsonPrimitive
import kotlinx.serialization.json.long
import org.junit.jupiter.api.Assumptions.assumeTrue
import org.junit.jupiter.api.Tag
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import org.junit.jupiter.params.ParameterizedTest
import org.junit.jupiter.params.provider.CsvSource
import java.nio.file.Path
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** Every survey and log of the data directory that STILLWATER_DATA names. */
class RealLogsTest {
    @TempDir
    private lateinit var directory: Path

    private fun data(): Path {
        val data = System.getenv("STILLWATER_DATA")
        assumeTrue(data != null, "STILLWATER_DATA names no directory with real logs: skipped")
        return Path.of(data)
    }

    private fun summary(file: String, vararg flags: String): JsonObject {
        val log = data().resolve(file).toString()
        return summaries.getOrPut(listOf(file) + flags) {
            val result = runMap(log, "--out", directory.out().toString(), "--json", "--filter", "averaging", *flags)
            assertEquals(0, result.statusCode, result.output)
            Json.parseToJsonElement(result.stdout).jsonObject
        }
    }

    private fun JsonObject.child(name: String) = getValue(name).jsonObject

    private fun JsonObject.number(name: String) = getValue(name).jsonPrimitive.double

    @ParameterizedTest
    @CsvSource(
        // File, quantity, rows of the file without its header.
        "lac_hertel_asv/survey.csv, odo_percent_sat, 4514",
        "lac_hertel_asv/survey.csv, temp_c, 4514",
        "catabot/catabot_china_20200915.csv, do_pct_sat, 2655",
        "catabot/catabot_china_20201006.csv, do_pct_sat, 2414",
        "catabot/catabot_sabattus_20201006.csv, do_pct_sat, 1833",
    )
    fun readsEveryRowOfTheSurveys(file: String, quantity: String, rows: Long) {
        val summary = summary(file, "--value", quantity)
        assertEquals(rows, summary.getValue("readings").jsonPrimitive.long)
        assertTrue(summary.child("skipped").isEmpty())
        assertEquals(0, summary.child("filters").child("averaging").getValue("outside").jsonPrimitive.long)
    }

    @ParameterizedTest
    @CsvSource(
        // Counted in the samples by hand: sensor lines, those placed, poses before the first fix.
        "platypus_logs/airboat_20130807_063622.txt, ES2.temp, 20, 23",
        "platypus_logs/platypus_20160426_024734.txt, ATLAS_DO, 21, 0",
        "platypus_logs/platypus_20160519_013623.txt, ATLAS_DO, 14, 29",
    )
    fun readsEveryPlacedReadingOfTheBoatLogs(file: String, sensor: String, readings: Long, placeholders: Long) {
        val summary = summary(file, "--value", sensor)
        assertEquals(readings, summary.getValue("readings").jsonPrimitive.long)
        val skipped = summary.child("skipped")["poses before the first fix"]?.jsonPrimitive?.long ?: 0
        assertEquals(placeholders, skipped)
    }

    @Test
    fun saysThatABoatNeverHadAFix() {
        val log = data().resolve("platypus_logs/airboat_20151220_043848.txt").toString()
        val result = runMap(log, "--out", directory.out().toString())
        assertEquals(BAD_INPUT, result.statusCode)
        assertContains(result.stderr, "expected poses with a GPS fix, found only the placeholder")
    }

    @Test
    fun showsTheLagOfTheOxygenSensorOfLacHertel() {
        val legs = summary("lac_hertel_asv/survey.csv", "--value", "odo_percent_sat").child("legs")
        assertEquals(19.0, legs.number("found"))
        // An independent calculation in numpy (other leg finder, interpolation instead of bins): 0.134 at 0 s, 0.053
        // at 14 s; the curve is flat within 0.002 from 12 to 15 s.
        assertEquals(0.134, legs.child("opposite_mismatch").number("mean"), 0.004)
        assertEquals(0.054, legs.child("best_shift").number("mismatch"), 0.003)
        assertEquals(13.5, legs.child("best_shift").number("earlier_by_s"), 1.6)
        assertEquals("true", legs.child("best_shift").getValue("clear").jsonPrimitive.content)
    }

    private fun diagnosis(file: String, vararg flags: String): JsonObject {
        val given = listOf("diagnose", data().resolve(file).toString(), "--numbers-only", "--json")
        val result = Stillwater().subcommands(DiagnoseCommand())
            .test(given + listOf("--out", directory.out().toString()) + flags)
        assertEquals(0, result.statusCode, result.output)
        return Json.parseToJsonElement(result.stdout).jsonObject
    }

    @Test
    fun findsTheLagOfTheOxygenSensorOfLacHertelWithoutAReference() {
        val answer = diagnosis("lac_hertel_asv/survey.csv", "--value", "odo_percent_sat")
        assertEquals("ambiguous", answer.getValue("verdict").jsonPrimitive.content)
        assertEquals("""[["time-constant","dead-time"]]""", answer.getValue("ambiguity").toString())
        val lag = answer.child("baseline").getValue("parameters").jsonArray.single().jsonObject
        // By shifting opposite legs others found 11 s (9 to 12).
        assertTrue(lag.number("lower") < 11.0 && lag.number("upper") > 11.0, "$lag")
        assertEquals(14.0, lag.number("value"), 3.0)
    }

    @Test
    @Tag("long")
    fun theFloatsOptodeLagsByATimeConstantOrADeadTimeAndIsNoFasterUpThanDown() {
        val answer = diagnosis("gordon2020_float/profiles.csv", "--x", "pres_dbar", "--value", "doxy_umol")
        assertEquals("ambiguous", answer.getValue("verdict").jsonPrimitive.content)
        val sets = answer.getValue("ambiguity").jsonArray.map { set -> set.jsonArray.map { it.jsonPrimitive.content } }
        assertContains(sets, listOf("time-constant", "dead-time"))
        val causes = answer.getValue("causes").jsonArray.map { it.jsonPrimitive.content }
        assertFalse("asymmetric-response" in causes + sets.flatten(), "$causes $sets")
    }

    @Test
    fun showsTheLagOfTheFloatsOptode() {
        val flags = arrayOf("--x", "pres_dbar", "--value", "doxy_umol")
        val legs = summary("gordon2020_float/profiles.csv", *flags).child("legs")
        assertEquals(20.0, legs.number("found"))
        // Published: a time constant of 76 s; a pure delay of 74 s does as well. Sampling is every 26 s.
        assertEquals(74.0, legs.child("best_shift").number("earlier_by_s"), 15.0)
        assertTrue(legs.child("opposite_minus_same").run { number("mean") > 10 * number("standard_error") })
    }

    @ParameterizedTest
    @CsvSource("china_20200915", "china_20201006", "sabattus_20201006")
    fun tellsNoLagFromTheFewLegsOfTheLakeSurveys(lake: String) {
        val legs = summary("catabot/catabot_$lake.csv", "--value", "do_pct_sat").child("legs")
        assertEquals("false", legs.child("best_shift").getValue("clear").jsonPrimitive.content)
    }

    private companion object {
        /** Each is looked at by several tests. */
        val summaries = HashMap<List<String>, JsonObject>()
    }
}
