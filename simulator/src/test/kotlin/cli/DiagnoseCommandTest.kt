package stillwater.cli

import com.github.ajalt.clikt.core.subcommands
import com.github.ajalt.clikt.testing.test
import kotlinx.serialization.json.Json
import kotlinx.serialization.json.double
import kotlinx.serialization.json.jsonArray
import kotlinx.serialization.json.jsonObject
import kotlinx.serialization.json.jsonPrimitive
import org.junit.jupiter.api.io.TempDir
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import java.nio.file.Files
import java.nio.file.Path
import kotlin.io.path.exists
import kotlin.math.PI
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class DiagnoseCommandTest {
    @TempDir
    private lateinit var directory: Path

    private fun diagnose(vararg arguments: String) =
        Stillwater().subcommands(DiagnoseCommand()).test(listOf("diagnose") + arguments)

    /** A bench log of a sensor that rises slower than it falls. */
    private fun bench(): String {
        val truth = DoubleArray(400) { 5 + sin(it / 9.0) + 0.5 * sin(it / 23.0) }
        val spec = SensorSpec("hidden", listOf(SensorStage.Asymmetric(8.0, 5.0), SensorStage.Noise(0.01)))
        val sensor = spec.build(truth[0], Random(3))
        val lines = truth.indices.map { "$it,0,0,${sensor.step(truth[it], 1.0, Conditions.NONE)},${truth[it]}" }
        val file = directory.resolve("bench.csv")
        Files.write(file, listOf("time_s,x_m,y_m,probe,sample") + lines)
        return file.toString()
    }

    /** A walk of the truth that a sensor follows by what the row before had, of which every fifth reading is missing. */
    private fun unread(): String {
        val random = Random(5)
        var truth = 0.0
        var state = 0.0
        val lines = List(600) { i ->
            state += (truth - state) / 6
            truth = 0.97 * truth + random.nextDouble(-1.0, 1.0)
            val reading = if (i % 5 ==
                2
            ) {
                (if (i % 2 == 0) "" else "-9999")
            } else {
                "${state + random.nextDouble(-0.01, 0.01)}"
            }
            "$i,$reading,$truth"
        }
        // A row without a reading need not have its time in order.
        val file = directory.resolve("unread.csv")
        Files.write(file, listOf("time_s,probe,sample") + lines + "3,,1.0" + "700,$state,$truth")
        return file.toString()
    }

    private fun huge(): String {
        val file = directory.resolve("huge.csv")
        Files.write(file, listOf("time_s,x_m,y_m,probe") + List(99) { "$it,$it,0,${if (it == 7) 1e90 else 1.0}" })
        return file.toString()
    }

    /** The bench log with no sample at all. */
    private fun emptied() = changed("emptied.csv") { it.substringBeforeLast(',') + "," }

    /** The bench log of a clock that stands. */
    private fun stopped() = changed("stopped.csv") { "7," + it.substringAfter(',') }

    private fun changed(name: String, row: (String) -> String): String {
        val lines = Files.readAllLines(Path.of(bench()))
        val file = directory.resolve(name)
        Files.write(file, lines.take(1) + lines.drop(1).map(row))
        return file.toString()
    }

    @Test
    fun aBenchLogNeedsNoPlaces() {
        val placed = Path.of(bench())
        val bare = directory.resolve("bare.csv")
        Files.write(bare, Files.readAllLines(placed).map { it.replace(Regex("(,0,0|,x_m,y_m)"), "") })
        val (with, without) = listOf(placed, bare).map { file ->
            val out = directory.resolve("of-${file.fileName}")
            val flags = arrayOf("--value", "probe", "--reference", "sample", "--numbers-only")
            val result = diagnose("$file", *flags, "--out", "$out")
            assertEquals(0, result.statusCode, result.output)
            Files.readString(out.resolve("diagnosis.json")).replace("bare.csv", "bench.csv")
        }
        assertEquals(with, without)
        val blind = diagnose("$bare", "--value", "probe", "--out", "${directory.resolve("blind")}")
        assertEquals(2, blind.statusCode)
        assertContains(blind.output, "expected columns lat_deg and lon_deg, or x_m and y_m")
    }

    @Test
    fun whatTheSensorSawWhereItsReadingIsMissingIsNotLost() {
        val out = directory.resolve("out")
        val result = diagnose(unread(), "--value", "probe", "--reference", "sample", "--numbers-only", "--out", "$out")
        assertContains(result.output, "verdict: consistent")
        assertContains(result.output, "61 rows left out: missing readings")
        assertContains(result.output, "60 rows left out: codes for a missing reading")
        assertEquals(1 + 481, Files.readAllLines(out.resolve("residuals.csv")).size)
    }

    @Test
    fun aSensorThatReadsHighIsSaidTo() {
        val lines = List(300) { i ->
            val truth = 5 + sin(i / 9.0) + 0.5 * sin(i / 23.0)
            "$i,${1.12 * truth + 0.003 * sin(41.0 * i * i)},$truth"
        }
        val file = directory.resolve("high.csv")
        Files.write(file, listOf("time_s,probe,sample") + lines)
        val out = directory.resolve("high")
        val result = diagnose("$file", "--value", "probe", "--reference", "sample", "--unit", "mg/L", "--out", "$out")
        assertContains(result.stdout, "verdict: consistent")
        val gain = "alibration against the reference: gain 1.1202 [1.1199, 1.1205]"
        assertContains(result.stdout, "c$gain")
        assertContains(result.stdout, "mg/L too high (12.0 %)")
        assertContains(Files.readString(out.resolve("report.html")), "C$gain")
    }

    @Test
    fun aRateHasItsUnitBehindTheNumber() {
        val file = directory.resolve("drift.csv")
        val random = Random(5)
        val lines = List(300) { i ->
            val truth = 5 + sin(i / 9.0) + 0.5 * sin(i / 23.0)
            "$i,${truth + 0.004 * i + 0.02 * random.nextDouble()},$truth"
        }
        Files.write(file, listOf("time_s,probe,sample") + lines)
        val out = "${directory.resolve("out")}"
        val result = diagnose("$file", "--value", "probe", "--reference", "sample", "--numbers-only", "--out", out)
        assertContains(result.stdout, "verdict: named (drift)")
        assertContains(result.stdout, Regex("""rate 0\.004\d* \[\S+ \S+] sensor units/s"""))
    }

    /** Gain and offset of a log without noise are off by what sums lose, which is no fault of the sensor. */
    @Test
    fun roundingIsNoCalibration() {
        fun truth(i: Int) = 5 + sin(i / 9.0) + sin(i / 4.1)
        val file = directory.resolve("late.csv")
        Files.write(file, listOf("time_s,probe,sample") + List(300) { "$it,${truth(maxOf(0, it - 8))},${truth(it)}" })
        val out = "${directory.resolve("out")}"
        val result = diagnose("$file", "--value", "probe", "--reference", "sample", "--numbers-only", "--out", out)
        assertContains(result.stdout, "dead time 8.00 [8.00, 8.00] s")
        assertFalse("calibration" in result.stdout, result.stdout)
    }

    @Test
    fun whereNothingWasTriedNothingIsLikeliest() {
        val file = directory.resolve("anchor.csv")
        Files.write(file, listOf("time_s,x_m,y_m,probe") + List(99) { "$it,5,5,${8 + sin(it / 9.0)}" })
        val result = diagnose("$file", "--numbers-only", "--out", "${directory.resolve("out")}")
        assertContains(result.stdout, "verdict: insufficient-data")
        assertContains(result.stdout, "\nno cause was tried\n")
        assertEquals(5, result.stdout.trim().lines().filterNot { it.startsWith("wrote") }.size, result.stdout)
    }

    @Test
    fun whereNothingWasFittedNoModelIsShown() {
        val file = directory.resolve("anchor.csv")
        Files.write(file, listOf("time_s,x_m,y_m,probe") + List(99) { "$it,5,5,${8 + sin(it / 9.0)}" })
        val out = directory.resolve("out")
        assertContains(diagnose("$file", "--out", "$out").stdout, "base: nothing was fitted")
        val names = Files.list(out).use { files -> files.map { "${it.fileName}" }.sorted().toList() }
        assertEquals(listOf("diagnosis.json", "report.html", "residuals.csv"), names)
        val rows = Files.readAllLines(out.resolve("residuals.csv")).drop(1)
        assertTrue(rows.size == 99 && rows.all { it.endsWith(",,,,,,,") }, rows[0])
        assertFalse("whitened" in Files.readString(out.resolve("report.html")))
    }

    @Test
    fun howManyRowsItTakesIsSaid() {
        for (flags in listOf(emptyList(), listOf("--reference", "sample"))) {
            val file = directory.resolve("few.csv")
            val lines = List(31) { "$it,$it,0,${8 + sin(it / 9.0)},${8 + sin(it / 7.0)}" }
            Files.write(file, listOf("time_s,x_m,y_m,probe,sample") + lines)
            val out = "${directory.resolve("out")}"
            val result = diagnose("$file", "--value", "probe", "--numbers-only", "--out", out, *flags.toTypedArray())
            assertContains(result.stdout, "there are 31 rows only, and 60 are needed")
        }
    }

    @Test
    fun itWritesWhatTheIssueAsksFor() {
        val out = directory.resolve("out")
        val result = diagnose(bench(), "--value", "probe", "--reference", "sample", "--out", "$out")
        assertEquals(0, result.statusCode, result.output)
        assertContains(result.stdout, "verdict: named (asymmetric-response)")
        assertEquals(5, result.stdout.trim().lines().size, result.stdout)
        val fields = Json.parseToJsonElement(Files.readString(out.resolve("diagnosis.json"))).jsonObject.keys
        assertEquals(
            setOf(
                "verdict",
                "answer",
                "causes",
                "candidates",
                "baseline",
                "extended",
                "gain",
                "ambiguity",
                "separatingManoeuvre",
                "warnings",
            ),
            fields,
        )
        SensorSpec.fromJson(Files.readString(out.resolve("extended-sensor.json")))
        for (name in listOf(
            "residuals.csv",
            "report.html",
            "predicted.svg",
            "cause-asymmetric-response.png",
            "checks.png",
        )) {
            assertTrue(out.resolve(name).exists(), name)
        }
    }

    /** Two channels that are late by 3 and 6 s, along a way that crosses itself often; a noise of one in 500. */
    private fun survey(): String {
        val random = Random(11)
        val file = directory.resolve("survey.csv")
        val rows = (0 until 900).map { i ->
            fun x(t: Double) = 15 * sin(t / 19)
            fun y(t: Double) = 15 * sin(t / 25 + 1)
            fun water(t: Double) = sin(x(t) / 4) + sin(y(t) / 5 + 1) + sin((x(t) + y(t)) / 7)
            val late = listOf(6.0, 3.0).map { water(i - it) + 0.004 * random.nextDouble() }
            "$i,${x(i.toDouble())},${y(i.toDouble())},${late[0]},${late[1]}"
        }
        Files.write(file, listOf("time_s,x_m,y_m,oxygen,temperature") + rows)
        return file.toString()
    }

    /** A dead time of 5 s beside a hum with a period of 7 s, along a way that crosses itself often. */
    private fun humming(): String {
        val x = DoubleArray(900) { 15 * sin(it / 19.0) }
        val y = DoubleArray(900) { 15 * sin(it / 25.0 + 1) }
        val water = DoubleArray(900) { sin(x[it] / 4) + sin(y[it] / 5 + 1) + sin((x[it] + y[it]) / 7) }
        val spec = SensorSpec("hidden", listOf(SensorStage.Delay(5.0), SensorStage.Noise(0.004)))
        val sensor = spec.build(water[0], Random(7))
        val rows = water.indices.map { i ->
            "$i,${x[i]},${y[i]},${sensor.step(water[i], 1.0, Conditions.NONE) + 1.0 * sin(2 * PI * i / 7)}"
        }
        val file = directory.resolve("humming.csv")
        Files.write(file, listOf("time_s,x_m,y_m,oxygen") + rows)
        return file.toString()
    }

    @Test
    fun theKindsOfALagAreSaidBesideWhatNothingExplains() {
        val out = directory.resolve("hum")
        val flags = arrayOf("--numbers-only", "--unit", "mg/L")
        val result = diagnose(humming(), "--value", "oxygen", *flags, "--out", "$out")
        assertEquals(0, result.statusCode, result.output)
        val residuals = Regex("""residuals [0-9.]+ mg/L, on held-out blocks [0-9.]+ mg/L \(root mean square\)""")
        assertContains(result.stdout, residuals)
        assertContains(result.stdout, "verdict: unexplained")
        assertContains(
            result.stdout,
            "The readings lag the water, by a time constant or by a dead time; this track cannot",
        )
        assertContains(result.stderr, "The readings lag the water by")
        val json = Json.parseToJsonElement(Files.readString(out.resolve("diagnosis.json"))).jsonObject
        assertEquals("""[["time-constant","dead-time"]]""", "${json.getValue("ambiguity")}")
        assertContains("${json.getValue("separatingManoeuvre")}", "cross a sharp front")
    }

    @Test
    fun withoutAReferenceAGivenLagThatIsWrongIsNamedAndChannelsAreCompared() {
        val spec = directory.resolve("spec.json")
        Files.writeString(spec, """{"name": "s", "stages": [{"type": "first-order-lag", "time_constant_s": 1.5}]}""")
        val out = directory.resolve("blind")
        val flags = listOf("--value", "oxygen", "--compare", "temperature", "--sensor", "$spec", "--numbers-only")
        val result = diagnose(survey(), *flags.toTypedArray(), "--out", "$out")
        assertEquals(0, result.statusCode, result.output)
        assertContains(result.stdout, "time-constant")
        assertContains(result.stdout, "base: the sensor given")
        assertContains(result.stderr, "Lags as dead times: oxygen")
        val channels = Json.parseToJsonElement(Files.readString(out.resolve("diagnosis.json"))).jsonObject
            .getValue("channels").jsonObject
        assertEquals(2, channels.getValue("deadTimes").jsonArray.size)
        // Half a second: rows are a second apart.
        assertEquals(3.0, channels.getValue("mostCommon_s").jsonPrimitive.double, 0.5)
    }

    @Test
    fun logsThatCannotShowItAreNotCalledConsistentOrLagging() {
        val water = List(200) { 5 + sin(it / 9.0) }
        val rest = directory.resolve("rest.csv")
        Files.write(rest, listOf("time_s,x_m,y_m,probe") + water.indices.map { "$it,3,4,${water[it]}" })
        val same = directory.resolve("same.csv")
        Files.write(same, listOf("time_s,x_m,y_m,probe,sample") + water.indices.map { "$it,$it,0,8,8" })
        val cases = listOf(
            listOf("$rest", "--value", "probe") to "the boat never moves",
            listOf("$same", "--value", "probe") to "the readings never change",
            listOf("$same", "--value", "probe", "--reference", "sample") to "neither the readings nor the truth",
        )
        for ((arguments, reason) in cases) {
            val out = directory.resolve("blind")
            val result = diagnose(*arguments.toTypedArray(), "--numbers-only", "--out", "$out")
            assertEquals(0, result.statusCode, result.output)
            assertContains(result.stdout, "verdict: insufficient-data")
            assertContains(result.stdout, reason)
        }
    }

    @Test
    fun givenSensorIsTheBaseAndMissingReferencesAreSaidToHideDelays() {
        val spec = directory.resolve("spec.json")
        Files.writeString(spec, """{"name": "s", "stages": [{"type": "slew-limit", "rate_per_s": 0.1}]}""")
        val rows = Files.readAllLines(Path.of(bench()))
        val sparse = directory.resolve("sparse.csv")
        Files.write(sparse, rows.mapIndexed { i, row -> if (i % 3 == 2) row.substringBeforeLast(',') + "," else row })
        val out = directory.resolve("given")
        val arguments = listOf("$sparse", "--value", "probe", "--reference", "sample", "--sensor", "$spec")
        val result = diagnose(*arguments.toTypedArray(), "--numbers-only", "--out", "$out")
        assertContains(result.stdout, "base: the sensor given; residuals")
        assertContains(result.stderr, "rows left out: no number in the column sample")
        assertContains(result.stderr, "may look like a delay")
    }

    @Test
    fun aGivenNumberThatIsWrongIsSaidToBeTheFilesAndNotTheSensors() {
        val water = DoubleArray(600) { 5 + sin(it / 9.0) + 0.5 * sin(it / 23.0) + 0.3 * sin(it / 4.1) }
        val random = Random(9)
        val sensor = SensorSpec("true", listOf(SensorStage.Lag(8.0), SensorStage.Noise(0.01))).build(water[0], random)
        val lines = water.indices.map { "$it,0,0,${sensor.step(water[it], 1.0, Conditions.NONE)},${water[it]}" }
        val log = directory.resolve("log.csv")
        Files.write(log, listOf("time_s,x_m,y_m,probe,sample") + lines)
        val given = directory.resolve("given.json")
        val stages = listOf(SensorStage.Delay(3.0), SensorStage.Lag(8.0), SensorStage.Calibration(1.0, 0.0))
        Files.writeString(given, SensorSpec("given", stages).toJson())
        val arguments = listOf("$log", "--value", "probe", "--reference", "sample", "--sensor", "$given", "--out")
        val result = diagnose(*arguments.toTypedArray(), "${directory.resolve("wrong")}", "--numbers-only")
        assertContains(result.stdout, "verdict: named (dead-time)")
        assertContains(result.stdout, "The sensor given is wrong in its dead-time, 3.00 s, and shows another one here.")
        assertFalse("less than a tenth" in result.stderr, result.stderr)
    }

    /** Legs along and across a pond whose water swings by 0.4 over three quarters of a period, as no drift does. */
    @Test
    fun waterThatSwingsIsInTheAnswerThoughItIsNotNamed() {
        val sensor = SensorSpec("true", listOf(SensorStage.Lag(6.0), SensorStage.Noise(0.01))).build(0.0, Random(11))
        val legs = (0..6).flatMap { leg -> (0 until 60).map { (if (leg % 2 == 0) it else 60 - it) to 10 * leg } } +
            (0..6).flatMap { leg -> (0 until 60).map { 60 - 10 * leg to if (leg % 2 == 0) 60 - it else it } }
        val lines = legs.mapIndexed { second, (x, y) ->
            val tide = 0.4 * sin(2 * PI * 0.75 * second / legs.size)
            val water = sin(x / 14.0 + 1) * sin(y / 17.0) + 0.5 * sin(x / 9.0 - y / 12.0) + tide
            "$second,$x,$y,${sensor.step(water, 1.0, Conditions.NONE)}"
        }
        val log = directory.resolve("swing.csv")
        Files.write(log, listOf("time_s,x_m,y_m,probe") + lines)
        val result = diagnose("$log", "--value", "probe", "--numbers-only", "--out", "${directory.resolve("swing")}")
        val isNamed = "time-varying-field" in result.stdout.lines().take(2).joinToString()
        assertTrue(isNamed || "but the water may have changed meanwhile" in result.stdout, result.output)
    }

    @Test
    fun badInputIsOneLineAndLeavesNothing() {
        val log = bench()
        val cases = listOf(
            listOf(log, "--value", "nothing") to "expected one of",
            listOf(log, "--value", "probe", "--reference", "nothing") to "no such column",
            listOf(log, "--value", "probe", "--reference", "probe") to "another column",
            listOf(log, "--value", "probe", "--condition", "speed") to "expected NAME=COLUMN, found 'speed'",
            listOf(log, "--value", "probe", "--sensor", "nowhere.json") to "no such file",
            listOf(log, "--value", "probe", "--reference", "time_s") to "column time_s: expected another column than",
            listOf(log, "--value", "probe", "--condition", "speed=time_s") to "column time_s: expected another column",
            listOf(log, "--value", "time_s", "--reference", "sample") to "column time_s: expected one use of it",
            listOf(emptied(), "--value", "probe", "--reference", "sample") to
                "usable rows, with probe and sample, found 0; 400 rows left out: no number in the column sample",
            listOf(stopped(), "--value", "probe", "--reference", "sample", "--skip-bad-rows") to
                "usable rows, with probe and sample, found 1; 399 rows left out: duplicate times",
            listOf(huge(), "--value", "probe") to "found 1.0E90",
            listOf("nowhere.csv") to "no such file",
        )
        for ((arguments, message) in cases) {
            val out = directory.resolve("refused")
            val result = diagnose(*arguments.toTypedArray(), "--out", "$out")
            assertEquals(2, result.statusCode, result.output)
            assertContains(result.stderr, message)
            assertEquals(1, result.stderr.trim().lines().size, result.stderr)
            assertFalse(out.exists())
        }
    }
}
