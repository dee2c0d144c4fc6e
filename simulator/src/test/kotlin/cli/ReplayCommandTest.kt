package stillwater.cli

import kotlinx.serialization.json.Json
import kotlinx.serialization.json.JsonObject
import kotlinx.serialization.json.double
import kotlinx.serialization.json.jsonObject
import kotlinx.serialization.json.jsonPrimitive
import kotlinx.serialization.json.long
import org.junit.jupiter.api.Assumptions.assumeTrue
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import org.junit.jupiter.params.ParameterizedTest
import org.junit.jupiter.params.provider.CsvSource
import stillwater.control.Mixing
import stillwater.mission.Mission
import stillwater.mission.MissionRecovery
import stillwater.mission.MissionSpec
import stillwater.mission.Wish
import java.nio.file.Path
import kotlin.io.path.deleteExisting
import kotlin.io.path.exists
import kotlin.io.path.readLines
import kotlin.io.path.readText
import kotlin.io.path.writeText
import kotlin.random.Random
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class ReplayCommandTest {
    @TempDir
    private lateinit var directory: Path

    private fun write(name: String, lines: List<String>) =
        directory.resolve(name).apply { writeText(lines.joinToString("") { "$it\n" }) }

    private fun replay(log: Path, out: String, vararg flags: String): JsonObject {
        val into = directory.resolve(out).toString()
        val result = runBoatCommand("replay", log.toString(), "--out", into, "--numbers-only", "--json", *flags)
        assertEquals(0, result.statusCode, result.output)
        return Json.parseToJsonElement(result.stdout).jsonObject
    }

    private fun JsonObject.word(key: String) = getValue(key).jsonPrimitive.content

    private fun JsonObject.count(vararg path: String): Long {
        val parent = path.dropLast(1).fold(this) { json, key -> json.getValue(key).jsonObject }
        return parent[path.last()]?.jsonPrimitive?.long ?: 0
    }

    private fun assertSameMap(mission: Mission, cells: Path) {
        for ((cell, line) in cells.readLines().drop(1).withIndex()) {
            val fields = line.split(',')
            val map = mission.map
            val numbers = listOf(map.value(cell), map.lower(cell), map.upper(cell))
            assertEquals(numbers.map { if (it.isNaN()) "" else it.toString() }, fields.subList(3, 6), "cell $cell")
            assertEquals(listOf(map.visits(cell), map.readings(cell)).map { "$it" }, fields.subList(6, 8), "cell $cell")
        }
    }

    @Test
    fun anOwnLogIsReplayedBitForBitThoughTheLinkWasBad() {
        for (seed in 41L..43L) {
            val (lines, mission) = sailed(seed, 200)
            val summary = replay(write("log.txt", lines), "out$seed")
            assertSameMap(mission, directory.resolve("out$seed/cells.csv"))
            assertEquals(lines, directory.resolve("out$seed/mission.txt").readLines(), "seed $seed")
            assertEquals("true", summary.word("same_map_as_recorded"))
            assertEquals(0, summary.count("steps_otherwise_than_recorded"))
            assertEquals(mission.readings.passed, summary.count("readings", "taken"))
            assertEquals(emptyMap(), summary.getValue("lines_not_understood").jsonObject.toMap())
            assertTrue(summary.getValue("board_lines_not_understood").jsonObject.isNotEmpty(), "seed $seed: $summary")
        }
    }

    @Test
    fun aLogThatIsOtherwiseThanItsReplayIsTold() {
        val (lines, _) = sailed(41, 120)
        fun told(name: String, log: List<String>): String {
            val out = directory.resolve("out-$name").toString()
            val result = runBoatCommand("replay", "${write("$name.txt", log)}", "--out", out, "--numbers-only")
            assertEquals(0, result.statusCode, result.output)
            return result.stderr
        }
        val words = "the log is not what this program makes of what its mission heard"
        assertFalse(words in told("whole", lines))
        assertContains(told("joined", lines + lines), words)
        assertContains(directory.resolve("out-joined/replay.json").readText(), words)
    }

    @Test
    fun aBoatWhoseThrusterSwivelsIsReplayedAsOne() {
        val pond = MissionSpec.fromJson(POND)
        val spec = pond.copy(boat = pond.boat.copy(mixing = Mixing.VECTORED))
        val (lines, mission) = sailed(45, 120, spec = spec)
        assertTrue(mission.readings.passed > 50, "the virtual boat did not sail")
        val log = write("log.txt", lines)
        val summary = replay(log, "out")
        assertEquals(0, summary.count("steps_otherwise_than_recorded"))
        assertSameMap(mission, directory.resolve("out/cells.csv"))
        assertEquals(lines, directory.resolve("out/mission.txt").readLines())
        // Another mission that says nothing of the boat goes with the one that sailed.
        val other = write("other.json", listOf(pond.toJson()))
        replay(log, "other", "--mission", other.toString())
        assertEquals(lines, directory.resolve("other/mission.txt").readLines())
    }

    @Test
    fun aLogFromTheWaterIsNotReplaced() {
        val (lines, _) = sailed(44, 30)
        for (name in listOf("mission.txt", "mission.txt.incomplete")) {
            val log = write(name, lines)
            val result = runBoatCommand("replay", log.toString(), "--out", directory.toString())
            assertEquals(2, result.statusCode, result.output)
            assertContains(result.output, "has the log of another mission")
            assertEquals(lines, log.readLines(), name)
            log.deleteExisting()
        }
    }

    @Test
    fun whatAPersonWishedAndALostLogAreReplayedToo() {
        val states = HashSet<String>()
        val (lines, mission) = sailed(46, 150) { step, mission ->
            when (step) {
                300 -> mission.wish = Wish.WAIT
                400 -> mission.wish = Wish.GO_ON
                600 -> mission.wish = Wish.HOLD
                800 -> mission.wish = Wish.GO_ON
                1000 -> mission.wish = Wish.RETURN
                1020 -> mission.wish = Wish.GO_ON
                1100 -> mission.phoneCharge(14.0)
                1110 -> mission.phoneCharge(Double.NaN)
                in 1200..1210 -> mission.logLost()
            }
            states += mission.state.word
        }
        assertTrue(states.containsAll(listOf("surveying", "holding", "returning")), "$states")
        assertEquals(1, lines.count { "\"log-lost\"" in it })
        val charges = lines.mapNotNull { Regex("\"phone\":(.*?])").find(it)?.groupValues?.get(1) }
        assertEquals(listOf("[14.0]", "[null]"), charges)
        val summary = replay(write("log.txt", lines), "out")
        assertSameMap(mission, directory.resolve("out/cells.csv"))
        assertEquals(lines, directory.resolve("out/mission.txt").readLines())
        assertEquals(0, summary.count("steps_otherwise_than_recorded"))
        assertEquals(emptyMap(), summary.getValue("lines_not_understood").jsonObject.toMap())
    }

    @Test
    fun linesThatAreNoneAreCountedAndTheRestIsReplayed() {
        val (lines, mission) = sailed(44, 60)
        val others = listOf("1\tI\t{\"what\":1}", "2\tI\t{\"mission\":{}}", lines.last().take(30))
        val rest = lines.flatMapIndexed { i, line -> listOfNotNull("rubbish $i".takeIf { i % 100 == 50 }, line) }
        val broken = rest + others
        val summary = replay(write("log.txt.incomplete", broken), "out")
        assertSameMap(mission, directory.resolve("out/cells.csv"))
        // Lines without a frame, and the last one, which was cut.
        val rubbish = broken.count { it.startsWith("rubbish") } + 1L
        assertEquals(rubbish, summary.count("lines_not_understood", "<ms> TAB I TAB {json}"))
        assertEquals(1, summary.count("lines_not_understood", "spec, mission, reading, sensor or pass"))
        assertEquals(1, summary.count("lines_not_understood", "a step's t_s"))
    }

    @Test
    fun aPlaceThatIsNoneIsCountedAndTheRestIsReplayed() {
        val (lines, mission) = sailed(49, 30)
        val at = lines.indexOfFirst { "\"fix\":[[" in it }
        val fix = Regex(""""fix":\[\[[^]]*]""")
        val broken = lines.toMutableList().apply { this[at] = get(at).replace(fix, "\"fix\":[[1.0,45.5,-999.0]") }
        val summary = replay(write("log.txt", broken), "out")
        assertEquals(1, summary.count("lines_not_understood", "a place"))
        assertEquals(mission.readings.passed, summary.count("readings", "taken"))
    }

    @Test
    fun whatNoLogWouldHaveIsCountedWithItsLineAndHarmsNothing() {
        val (lines, mission) = sailed(47, 60)
        val deep = "1\tI\t{\"a\":" + "[".repeat(100_000)
        val long = "1\tI\t{\"a\":\"" + "x".repeat(5_000_000) + "\"}"
        val broken = lines.take(300) + deep + long + "\u0000\u0001" + lines.drop(300)
        val log = write("log.txt", broken)
        val summary = replay(log, "out")
        assertSameMap(mission, directory.resolve("out/cells.csv"))
        assertEquals(3, summary.count("lines_not_understood", "<ms> TAB I TAB {json}"))
        assertEquals(301, summary.count("first_line_not_understood", "<ms> TAB I TAB {json}"))
        assertEquals(0, summary.count("steps_otherwise_than_recorded"))
        // The same log when its lines lost their order, and when it was joined with itself.
        val shuffled = lines.take(1) + lines.drop(1).shuffled(Random(48))
        assertTrue(
            replay(write("other.txt", shuffled), "other")
                .count("lines_not_understood", "a step later than the one before it") > 100,
        )
        val twice = replay(write("twice.txt", lines + lines), "twice")
        assertEquals(2, twice.count("lines", "beginnings"))
        assertTrue(twice.getValue("seconds_in_state").jsonObject.values.all { it.jsonPrimitive.double >= 0 }, "$twice")
    }

    @Test
    fun aLogThatWasGoneOnWithIsReplayedWithWhatWasKnownThen() {
        val (lines, _) = sailed(49, 60)
        val recovery = MissionRecovery().apply { lines.forEach(::line) }
        val (rest, mission) = sailed(50, 60, recovery.recovered())
        val summary = replay(write("log.txt", lines + rest), "out")
        assertEquals("true", summary.word("same_map_as_recorded"))
        assertEquals(0, summary.count("steps_otherwise_than_recorded"))
        assertSameMap(mission, directory.resolve("out/cells.csv"))
        val other = directory.resolve("other.json").apply { writeText(POND.replace("self-calibrating", "averaging")) }
        val taken = summary.count("lines", "readings")
        val averaged = replay(directory.resolve("log.txt"), "averaged", "--mission", other.toString())
        assertEquals(taken, averaged.count("lines", "readings"))
        val map = directory.resolve("averaged/cells.csv").readLines().drop(1).sumOf { it.split(',')[7].toInt() }
        val before = averaged.count("readings", "taken_before_it_was_taken_up_again")
        assertTrue(before > 0)
        assertEquals(
            averaged.count("readings", "taken").toInt(),
            map,
            "readings of before the crash are in the map too",
        )
    }

    @Test
    fun anotherMissionOnTheSameWayMakesAnotherMap() {
        val (lines, _) = sailed(45, 150)
        val other = directory.resolve("other.json").apply { writeText(POND.replace("self-calibrating", "averaging")) }
        val summary = replay(write("log.txt", lines), "out", "--mission", other.toString())
        assertEquals("averaging", summary.word("estimator"))
        assertEquals("null", summary.word("same_map_as_recorded"))
        assertTrue(summary.count("readings", "taken") > 100)
    }

    @ParameterizedTest
    @CsvSource(
        // Lines of the log, those before a fix, and readings of the probe that have a place and are not left out: in
        // the last log the boat leaves a cell before its first reading is confirmed.
        "airboat_20130807_063622.txt, 4.0.0, 23, 18, surveying",
        "airboat_20151220_043848.txt, 4.0.0, 15, 0, preflight",
        "platypus_20160426_024734.txt, 4.1.0, 0, 21, preflight",
        "platypus_20160519_013623.txt, 4.2.0, 29, 30, surveying",
    )
    fun platypusLogsAreReplayedAndTheirReplayIsALogAgain(
        name: String,
        version: String,
        placeholders: Long,
        readings: Long,
        ended: String,
    ) {
        val data = System.getenv("STILLWATER_DATA")
        assumeTrue(data != null, "STILLWATER_DATA names no directory with real logs: skipped")
        val log = Path.of(data, "platypus_logs", name)
        val summary = replay(log, "first")
        assertEquals("Platypus log $version", summary.word("format"))
        assertEquals(placeholders, summary.count("lines", "poses before the first fix"))
        assertEquals(readings, summary.count("readings", "taken"))
        assertEquals(ended, summary.word("ended"))
        // Every line is accounted for.
        val known = summary.getValue("lines").jsonObject.values.sumOf { it.jsonPrimitive.long }
        val unknown = summary.getValue("lines_not_understood").jsonObject.values.sumOf { it.jsonPrimitive.long }
        assertEquals(log.readLines().count { it.isNotBlank() }.toLong(), known + unknown)
        val again = replay(directory.resolve("first/mission.txt"), "second")
        assertEquals("true", again.word("same_map_as_recorded"))
        for (file in listOf("cells.csv", "mission.txt", "decisions.csv")) {
            assertEquals(
                directory.resolve("first/$file").readText(),
                directory.resolve("second/$file").readText(),
                file,
            )
        }
    }

    @ParameterizedTest
    @CsvSource(
        "'', temperature, °C, ES2#3.temp of the log with 31 readings; --value takes ES2#3.ec",
        "ES2.ec, conductivity, µS/cm, ES2#3.ec of the log",
        "ATLAS_PH, acidity, '', ATLAS_PH#2 of the log with 10 readings",
        "ATLAS_DO#1, dissolved oxygen, mg/L, ATLAS_DO#1 of the log with 14 readings",
    )
    fun aPlatypusLogsReplaySaysWhatItIsOfAndTakesAnother(value: String, quantity: String, unit: String, said: String) {
        val data = System.getenv("STILLWATER_DATA")
        assumeTrue(data != null, "STILLWATER_DATA names no directory with real logs: skipped")
        val log = Path.of(data).resolve("platypus_logs/platypus_20160519_013623.txt").toString()
        val flags = if (value.isEmpty()) emptyArray() else arrayOf("--value", value)
        val out = directory.resolve("out")
        val result = runBoatCommand("replay", log, "--out", out.toString(), "--numbers-only", *flags)
        assertEquals(0, result.statusCode, result.output)
        assertContains(result.stdout, said)
        val json = Json.parseToJsonElement(out.resolve("replay.json").readText()).jsonObject
        assertEquals(listOf(quantity, unit), listOf(json.word("quantity"), json.word("unit")))
    }

    @Test
    fun aSensorThatIsNotThereOrHasNoSayIsRefused() {
        val data = System.getenv("STILLWATER_DATA")
        assumeTrue(data != null, "STILLWATER_DATA names no directory with real logs: skipped")
        val log = Path.of(data).resolve("platypus_logs/platypus_20160519_013623.txt").toString()
        val own = write("log.txt", sailed(41, 20).first).toString()
        for ((arguments, words) in listOf(
            listOf(log, "--value", "ATLAS_ORP") to "found those of ES2#3.ec, ES2#3.temp, ATLAS_DO#1, ATLAS_PH#2",
            listOf(log, "--value", "a b") to "--value: expected TYPE[#CHANNEL][.FIELD], found 'a b'",
            listOf(own, "--value", "ATLAS_DO") to "--value: expected it with a Platypus log and without --mission",
        )) {
            val out = directory.resolve("none")
            val result = runBoatCommand("replay", *arguments.toTypedArray(), "--out", out.toString())
            assertEquals(2, result.statusCode, result.output)
            assertContains(result.stderr, words)
            assertFalse(out.exists())
        }
    }

    @ParameterizedTest
    @CsvSource(
        "a survey, 'time_s,do\n1,2\n', 'expected a mission''s log or a Platypus log, found neither'",
        "no readable mission, '0\tI\t{\"spec\":{\"name\":1}}\n', 'log.txt:1: expected a mission''s log, found no mission that can be read (name: expected a text in quotes, found ''1'')'",
        "nothing, '', 'expected a log, found an empty file'",
    )
    fun whatIsNoLogIsRefusedInOneLineAndNothingIsWritten(case: String, text: String, message: String) {
        val log = directory.resolve("log.txt").apply { writeText(text) }
        val out = directory.resolve("out")
        val result = runBoatCommand("replay", log.toString(), "--out", out.toString())
        assertEquals(2, result.statusCode, case)
        assertContains(result.stderr, message, message = case)
        assertEquals(1, result.stderr.trimEnd().lines().size, result.stderr)
        assertFalse(out.exists(), case)
    }
}
