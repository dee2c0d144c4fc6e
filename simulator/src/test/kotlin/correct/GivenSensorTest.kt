package stillwater.correct

import com.github.ajalt.clikt.core.subcommands
import com.github.ajalt.clikt.testing.CliktCommandTestResult
import com.github.ajalt.clikt.testing.test
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import stillwater.cli.CorrectCommand
import stillwater.cli.MapCommand
import stillwater.cli.Stillwater
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import java.nio.file.Path
import kotlin.io.path.exists
import kotlin.io.path.readLines
import kotlin.io.path.readText
import kotlin.io.path.writeText
import kotlin.math.PI
import kotlin.math.abs
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** `correct` and `map` told the sensor, on legs there and back over water that is the same along each. */
class GivenSensorTest {
    @TempDir
    private lateinit var directory: Path

    private val out: Path get() = directory.resolve("results")

    private fun run(vararg arguments: String): CliktCommandTestResult =
        Stillwater().subcommands(CorrectCommand(), MapCommand())
            .test(arguments.toList() + listOf("--out", "${out.resolve(arguments[0])}"))

    private fun file(name: String, text: String) = directory.resolve(name).also { it.writeText(text) }.toString()

    private fun spec(vararg stages: SensorStage) =
        file("sensor.json", SensorSpec("test", stages.toList()).toJson())

    private fun water(along: Double) = 8 + sin(2 * PI * along / 60) + along / 100

    private fun temperature(row: Int) = 15 + 8 * sin(row / 100.0)

    /** Legs of 100 m, 10 m apart, at 1 m/s and 1 Hz. */
    private fun survey(stage: SensorStage) = buildString {
        appendLine("time_s,x_m,y_m,do_mg_l,temp_c,truth")
        val sensor = SensorSpec("test", listOf(stage)).build(water(0.0), Random(1))
        for (row in 0 until 600) {
            val along = (row % 200).let { if (it < 100) it else 200 - it }.toDouble()
            val warm = temperature(row)
            var shown = 0.0
            repeat(10) { shown = sensor.step(water(along), 0.1, Conditions(mapOf(Conditions.TEMPERATURE to warm))) }
            appendLine("$row,${row / 100 * 10},$along,${Math.rint(shown * 1000) / 1000},$warm,${water(along)}")
        }
    }

    private fun rows(name: String): List<Map<String, Double>> {
        val lines = out.resolve(if (name == "cells.csv") "map" else "correct").resolve(name).readLines()
        val names = lines.first().split(',')
        return lines.drop(1).map { line ->
            names.zip(line.split(',')).associate { (key, cell) -> key to (cell.toDoubleOrNull() ?: Double.NaN) }
        }
    }

    private fun withTemperature(command: String, log: String, stage: SensorStage) = run(
        command,
        log,
        "--value",
        "do_mg_l",
        "--sensor",
        spec(stage),
        "--condition",
        "temperature=temp_c",
    )

    private fun error(rows: List<Map<String, Double>>, column: String, truth: (Map<String, Double>) -> Double) =
        rows.map { abs(it.getValue(column) - truth(it)) }.filter { it.isFinite() }.average()

    @Test
    fun lagThatFollowsTheTemperatureIsUndoneWithIt() {
        val stage = SensorStage.TemperatureLag(8.0, 15.0, -0.06)
        val log = file("log.csv", survey(stage))
        val told = withTemperature("correct", log, stage)
        assertEquals(0, told.statusCode, told.output)
        val truth: (Map<String, Double>) -> Double = { it.getValue("truth") }
        val measured = error(rows("corrected.csv"), "do_mg_l", truth)
        val corrected = error(rows("corrected.csv"), "corrected", truth)
        assertTrue(corrected < 0.1 * measured, "$measured to $corrected")
        // A constant lag is the nearest without the temperature, and worse.
        val constant = run("correct", log, "--value", "do_mg_l", "--sensor", spec(SensorStage.Lag(8.0)))
        assertEquals(0, constant.statusCode, constant.output)
        assertTrue(error(rows("corrected.csv"), "corrected", truth) > 2 * corrected)
    }

    /** A bench whose sample is changed every 100 s, and its flow every 60 s; without places. */
    private fun bench(stage: SensorStage) = buildString {
        appendLine("time_s,do_mg_l,truth,flow")
        val sensor = SensorSpec("test", listOf(stage, SensorStage.Noise(0.01))).build(8.0, Random(1))
        for (row in 0 until 600) {
            val truth = if (row / 100 % 2 == 0) 8.0 else 4.0
            val flow = if (row / 60 % 2 == 0) 1.0 else 0.25
            val shown = sensor.step(truth, 1.0, Conditions(mapOf(Conditions.SPEED to flow)))
            appendLine("$row,${Math.rint(shown * 1000) / 1000},$truth,$flow")
        }
    }

    @Test
    fun thatNothingCheckedTheSensorGivenIsSaid() {
        val log = file("bench.csv", bench(SensorStage.Lag(12.0)))
        val given = run("correct", log, "--value", "do_mg_l", "--sensor", spec(SensorStage.Lag(12.0)))
        assertEquals(0, given.statusCode, given.output)
        assertContains(given.stderr, "nothing in the log checked the sensor given, for the log has no places")
    }

    @Test
    fun aReferenceThatIsTheReadingsIsRefused() {
        val rows = bench(SensorStage.Lag(12.0)).trim().lines().map { it.split(",") }
        val log = file("copy.csv", rows.joinToString("\n") { "${it[0]},${it[1]},${it[1].replace("do", "copy")}" })
        val copied = run("correct", log, "--value", "do_mg_l", "--reference", "copy_mg_l")
        assertEquals(2, copied.statusCode, copied.output)
        assertContains(copied.stderr, "found the numbers of do_mg_l in every row")
    }

    @Test
    fun aLogWithoutPlacesIsCorrectedInTime() {
        val log = file("bench.csv", bench(SensorStage.Lag(12.0)))
        for (known in listOf(listOf("--sensor", spec(SensorStage.Lag(12.0))), listOf("--reference", "truth"))) {
            val result = run("correct", log, "--value", "do_mg_l", *known.toTypedArray())
            assertEquals(0, result.statusCode, result.output)
            assertContains(result.stdout, "not checked, for the log has no places")
            val rows = rows("corrected.csv")
            val truth: (Map<String, Double>) -> Double = { it.getValue("truth") }
            assertTrue(error(rows, "corrected", truth) < 0.2 * error(rows, "do_mg_l", truth), "$known")
        }
        val unknown = run("correct", log, "--value", "do_mg_l")
        assertEquals(2, unknown.statusCode, unknown.output)
        assertContains(unknown.stderr, "or correct with --sensor")
    }

    @Test
    fun withoutPlacesTheSpeedThatASensorFollowsMustBeThere() {
        val stage = SensorStage.FlowLag(12.0, 1.0, 0.5)
        val log = file("bench.csv", bench(stage))
        val given = arrayOf("correct", log, "--value", "do_mg_l", "--sensor", spec(stage))
        val without = run(*given)
        assertEquals(2, without.statusCode, without.output)
        assertContains(without.stderr, "--condition speed=COLUMN")
        assertFalse(out.exists())
        val told = run(*given, "--condition", "speed=flow")
        assertEquals(0, told.statusCode, told.output)
        val rows = rows("corrected.csv")
        val truth: (Map<String, Double>) -> Double = { it.getValue("truth") }
        assertTrue(error(rows, "corrected", truth) < 0.2 * error(rows, "do_mg_l", truth))
        // Along a line in unknown units no speed is known either.
        assertEquals(2, run(*given, "--x", "truth").statusCode)
    }

    @Test
    fun aSensorThatSetsOppositeLegsApartIsWarnedOf() {
        val log = file("log.csv", survey(SensorStage.Lag(4.0)))
        for ((tau, isWrong) in listOf(4.0 to false, 20.0 to true)) {
            val result = run("correct", log, "--value", "do_mg_l", "--sensor", spec(SensorStage.Lag(tau)))
            assertEquals(0, result.statusCode, result.output)
            assertEquals(isWrong, "the sensor given is not this one's" in result.stderr, "$tau s: ${result.stderr}")
        }
    }

    @Test
    fun aSensorThatCannotBeUndoneIsRefusedWithItsFileAndPlace() {
        val log = file("log.csv", survey(SensorStage.Lag(6.0)))
        val lag = """{"type":"first-order-lag","time_constant_s":4}"""
        val cases = listOf(
            """{"type":"saturation","lower":0,"upper":12},
                $lag""" to ":2:17: stages[1]: expected a stage that can be undone, found first-order-lag: a stage " +
                "that takes time after a saturation cannot be undone",
            "$lag,$lag,\n$lag" to ":2:1: stages[2]: expected a stage that can be undone, found first-order-lag: ",
            """$lag,{"type":"flow-dependent-lag","time_constant_s":6,"reference_speed_m_per_s":1,"exponent":0.5}""" to
                ":1:73: stages[1]: expected a stage that can be undone, found flow-dependent-lag: a lag that changes",
        )
        for ((stages, words) in cases) {
            val sensor = file("bent.json", """{"name":"bent","stages":[$stages]}""")
            for (command in listOf("correct", "map")) {
                val result = run(command, log, "--value", "do_mg_l", "--sensor", sensor)
                assertEquals(2, result.statusCode, result.output)
                assertContains(result.stderr, "stillwater $command: --sensor: $sensor$words")
                assertFalse(out.exists())
            }
        }
    }

    @Test
    fun missingOrWrongConditionIsNamed() {
        val stage = SensorStage.TemperatureLag(8.0, 15.0, -0.06)
        val log = file("log.csv", survey(stage))
        val cases = listOf(
            emptyList<String>() to
                "${spec(stage)}: expected --condition temperature=COLUMN, which undoing it takes, found none",
            listOf("--condition", "temperature=fog") to "fog",
            listOf("--condition", "salinity=temp_c") to "--condition temperature=COLUMN",
        )
        for ((more, word) in cases) {
            for (command in listOf("correct", "map")) {
                val arguments = listOf(command, log, "--value", "do_mg_l", "--sensor", spec(stage)) + more
                val result = run(*arguments.toTypedArray())
                assertEquals(2, result.statusCode, "$arguments: ${result.output}")
                assertContains(result.stderr, word)
                assertFalse(out.exists(), "$arguments")
            }
        }
    }

    @Test
    fun missingNumbersOfAConditionAreBridgedAndToldOrRefused() {
        val stage = SensorStage.TemperatureLag(8.0, 15.0, -0.06)
        val whole = survey(stage).lines()
        fun without(isMissing: (Int) -> Boolean) = whole.mapIndexed { line, text ->
            val cells = text.split(',')
            if (line == 0 || cells.size < 2 || !isMissing(line)) {
                text
            } else {
                (cells.take(4) + "" + cells.drop(5)).joinToString(",")
            }
        }.joinToString("\n")
        val truth: (Map<String, Double>) -> Double = { it.getValue("truth") }
        fun result(command: String, log: String) = withTemperature(command, file("log.csv", log), stage)
        assertEquals(0, result("correct", whole.joinToString("\n")).statusCode)
        val measured = error(rows("corrected.csv"), "corrected", truth)
        for (command in listOf("correct", "map")) {
            val some = result(command, without { it % 5 != 0 && it % 2 == 0 })
            assertEquals(0, some.statusCode, some.output)
            assertContains(some.stderr, "the column temp_c has no number in 240 of 600 rows: temperature was taken")
            if (command == "correct") {
                assertEquals(measured, error(rows("corrected.csv"), "corrected", truth), 0.001 * measured)
            }
            val most = result(command, without { it > 20 })
            assertEquals(2, most.statusCode, most.output)
            assertContains(most.stderr, "column temp_c: expected a number for temperature in at least half of the rows")
            assertContains(most.stderr, "found numbers in 20 of 600 rows")
        }
    }

    @Test
    fun aConditionThatTheSensorDoesNotDependOnIsRefused() {
        val warm = SensorStage.TemperatureLag(8.0, 15.0, -0.06)
        val log = file("log.csv", survey(warm))
        val cases = mapOf<SensorStage, String>(
            warm to "--condition: expected temperature, on which the sensor given depends, found speed",
            SensorStage.Lag(8.0) to
                "--condition: expected none, for the sensor given depends on none, found temperature",
        )
        for ((stage, message) in cases) {
            for (command in listOf("correct", "map")) {
                val more = listOf("temperature=temp_c", "speed=temp_c").take(if (stage == warm) 2 else 1)
                val arguments = listOf(command, log, "--value", "do_mg_l", "--sensor", spec(stage)) +
                    more.flatMap { listOf("--condition", it) }
                val result = run(*arguments.toTypedArray())
                assertEquals(2, result.statusCode, "$arguments: ${result.output}")
                assertContains(result.stderr, message)
                assertFalse(out.exists(), "$arguments")
            }
        }
    }

    /** As the diagnosis writes it: what cannot be had back does not keep the lag from being undone. */
    @Test
    fun aSensorOfWhichSomethingIsLostIsUndoneButForThat() {
        val lag = SensorStage.Lag(8.0)
        val log = file("log.csv", survey(lag))
        val extended =
            spec(lag, SensorStage.Backlash(0.02), SensorStage.Range(null, 9.0), SensorStage.Outlying(0.01, 1.0))
        for (command in listOf("correct", "map")) {
            val result = run(command, log, "--value", "do_mg_l", "--sensor", extended)
            assertEquals(0, result.statusCode, result.output)
            assertContains(result.stderr, "hysteresis in the sensor hides changes within 0.02")
            assertContains(result.stderr, "at the upper end of the sensor's range")
        }
    }

    @Test
    fun mapShowsTheWaterAndNotTheLag() {
        val stage = SensorStage.Lag(8.0)
        val log = file("log.csv", survey(stage))
        val centre: (Map<String, Double>) -> Double = { water(it.getValue("y_m")) }
        fun mapped(vararg more: String): Double {
            val result = run("map", log, "--value", "do_mg_l", "--filter", "averaging", "--cell", "10", *more)
            assertEquals(0, result.statusCode, result.output)
            return error(rows("cells.csv"), "value", centre)
        }
        val measured = mapped()
        val corrected = mapped("--sensor", spec(stage))
        assertTrue(corrected < 0.5 * measured, "$measured to $corrected")
        assertEquals(2, run("map", log, "--value", "do_mg_l", "--sensor", "none.json").statusCode)
    }

    @Test
    fun aCorrectedMapSaysSoAndHowWellTheWaterIsKnown() {
        val stage = SensorStage.Lag(8.0)
        val log = file("log.csv", survey(stage))
        val result = run("map", log, "--value", "do_mg_l", "--cell", "10", "--sensor", spec(stage))
        assertEquals(0, result.statusCode, result.output)
        assertContains(result.stdout, "test (first-order-lag: time constant in s 8)")
        assertEquals(
            setOf("averaging"),
            out.resolve("map/cells.csv").readLines().drop(1).map {
                it.split(',')[0]
            }.toSet(),
        )
        val cells = rows("cells.csv").filter { it.getValue("visits") > 0 }
        for (cell in cells) {
            assertTrue(cell.getValue("lower") <= cell.getValue("value"), "$cell")
            assertTrue(cell.getValue("upper") >= cell.getValue("value"), "$cell")
        }
        assertContains(out.resolve("map/estimate-averaging.svg").readText(), "log.csv, corrected (sensor: test)")
        assertTrue(out.resolve("map/bounds-width-averaging.svg").exists())
        val lag = run("map", log, "--value", "do_mg_l", "--filter", "bounded,averaging", "--sensor", spec(stage))
        assertContains(lag.stderr, "bounded reckons with a lag that --sensor has undone already")
    }

    @Test
    fun aSensorThatCannotBeThisLogsIsRefusedOrTold() {
        val log = file("log.csv", survey(SensorStage.Lag(4.0)))
        fun told(stage: SensorStage) = run("map", log, "--value", "do_mg_l", "--sensor", spec(stage))
        val far = told(SensorStage.Delay(600.0))
        assertEquals(2, far.statusCode)
        assertContains(far.stderr, "found a dead time of 600 s in a log of 599 s")
        assertContains(told(SensorStage.Lag(1e6)).stderr, "is longer than the log (599 s")
        assertContains(told(SensorStage.Lag(60.0)).stderr, "the sensor given is not this one's")
        val late = told(SensorStage.Delay(25.5))
        assertContains(late.stdout, Regex("last readings +26 left out"))
        // 26 of 600 rows, a second apart, come within 25.5 s of the end, that at the end itself among them.
        assertEquals(574.0, rows("cells.csv").sumOf { it.getValue("readings") })
    }

    @Test
    fun thatALearnedSensorIsNotKnownExactlyIsSaid() {
        val log = file("log.csv", survey(SensorStage.Lag(8.0)))
        val words = "intervals know nothing of that"
        assertFalse(words in run("map", log, "--value", "do_mg_l", "--sensor", spec(SensorStage.Lag(8.0))).stderr)
        assertEquals(0, run("correct", log, "--value", "do_mg_l").statusCode)
        val learned = "${out.resolve("correct/sensor.json")}"
        assertContains(run("map", log, "--value", "do_mg_l", "--sensor", learned).stderr, words)
    }
}
