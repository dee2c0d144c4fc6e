package stillwater.cli

import kotlinx.serialization.json.Json
import kotlinx.serialization.json.jsonArray
import kotlinx.serialization.json.jsonObject
import kotlinx.serialization.json.jsonPrimitive
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import stillwater.run.Checkpoints
import stillwater.sensor.FirstOrderLag
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import java.nio.file.Path
import java.util.Locale
import kotlin.io.path.listDirectoryEntries
import kotlin.io.path.name
import kotlin.io.path.readBytes
import kotlin.io.path.readText
import kotlin.io.path.writeText
import kotlin.test.assertContains
import kotlin.test.assertContentEquals
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class BenchmarkCommandTest {
    @TempDir
    private lateinit var directory: Path
    private val out: Path get() = directory.out()

    private fun column(name: String) = results(out).map { it.getValue(name) }.distinct()

    private fun sensor() = SensorSpec.fromJson(out.resolve("sensor.json").readText())

    @Test
    fun withoutFlagsOfItsOwnItComparesWhatTheReportCompares() {
        val result = runSmallBenchmark(out)
        assertEquals(listOf("uniform", "gaussian"), column("field"))
        assertEquals(setOf("bounded", "averaging"), column("filter").toSet())
        assertEquals(setOf("random-walk", "lawnmower", "bounded"), column("planner").toSet())
        assertEquals(Checkpoints.upTo(12).map { "$it" }, column("move"))
        assertEquals(listOf("2"), column("environments"))
        assertEquals(2 * 3 * 2 * Checkpoints.upTo(12).size, results(out).size)
        assertContains(result.stdout, "Mean absolute error, field gaussian, by moves")
        assertContains(result.stdout, "Share of cells whose bounds hold the truth, field gaussian, by moves")
        assertContains(result.stdout, "wrote 9 files into $out, see ${out.resolve("report.html")}")
        assertEquals("", result.stderr)
        assertEquals(9, out.listDirectoryEntries().size)
    }

    @Test
    fun errorsBeyondAllNumbersAreCounted() {
        val file = directory.resolve("loud.json")
        // One gain may be 1e15 at most; of so many in a row no number is left.
        val gains = List(22) { """{"type": "gain-offset", "gain": 1e15, "offset": 0}""" }
        file.writeText("""{"name": "loud", "stages": $gains}""")
        val flags = arrayOf("--field", "uniform", "--planner", "lawnmower", "--sensor", "$file")
        val result = runSmallBenchmark(out, *flags)
        val empty = results(out).count { it.getValue("mean_abs_error").isEmpty() }
        assertTrue(empty > 0)
        val told = "warning: $empty of ${results(out).size} mean errors are larger than any number and left empty"
        assertContains(result.stderr, told)
    }

    @Test
    fun subsetsAreRunInTheOrderAskedFor() {
        val flags = arrayOf("--field", "gaussian", "--filter", "exponential,bounded", "--planner", "lawnmower, bounded")
        runSmallBenchmark(out, *flags)
        assertEquals(listOf("gaussian"), column("field"))
        assertEquals(listOf("exponential", "bounded"), column("filter"))
        assertEquals(listOf("lawnmower", "bounded"), column("planner"))
        assertEquals(
            listOf(
                "bounds.csv",
                "extremes.csv",
                "figure-7.png",
                "figure-7.svg",
                "report.html",
                "results.csv",
                "sensor.json",
            ),
            out.listDirectoryEntries().map { it.name }.sorted(),
        )
    }

    @Test
    fun aSubsetHasTheNumbersOfTheWholeRun() {
        runSmallBenchmark(out, "--preset", "noisy")
        val asked = mapOf("field" to "uniform", "planner" to "bounded", "filter" to "averaging")
        val whole = results(out).filter { row -> asked.all { (name, value) -> row[name] == value } }
        runSmallBenchmark(
            out, "--preset", "noisy", "--planner", "bounded", "--filter", "averaging", "--field", "uniform",
        )
        assertEquals(whole, results(out))
    }

    @Test
    fun presetsBringTheirSensors() {
        val sensors = listOf("report", "noisy", "original").map { preset ->
            runSmallBenchmark(out, "--preset", preset, "--quiet")
            assertEquals(listOf(sensor().name), column("sensor"))
            sensor().stages.map { it::class.simpleName }
        }
        assertEquals(listOf(listOf("Lag"), listOf("Lag", "Noise", "Quantum"), listOf("Slew")), sensors)
        assertEquals(setOf("bounded", "exponential"), column("filter").toSet())
    }

    @Test
    fun sensorJsonOfARunGivesTheSameRunAgain() {
        runSmallBenchmark(out, "--preset", "noisy", "--noise", "0.01", "--planner", "random-walk")
        val first = out.resolve("results.csv").readText()
        val spec = out.resolve("sensor.json")
        val again = directory.resolve("again")
        runSmallBenchmark(again, "--preset", "noisy", "--sensor", spec.toString(), "--planner", "random-walk")
        assertEquals(first, again.resolve("results.csv").readText())
        assertEquals(spec.readText(), again.resolve("sensor.json").readText())
    }

    @Test
    fun aSensorSpecIsTakenAsWritten() {
        val spec = SensorSpec("my probe", listOf(SensorStage.Slew(0.5), SensorStage.Lag(3.0)))
        val file = directory.resolve("my-probe.json").apply { writeText(spec.toJson()) }
        runSmallBenchmark(out, "--sensor", file.toString(), "--planner", "random-walk")
        assertEquals(spec, sensor())
        assertEquals(listOf("my probe"), column("sensor"))
    }

    @Test
    fun alphaNoiseAndQuantumTakeThePlaceOfThePresets() {
        runSmallBenchmark(out, "--preset", "noisy", "--alpha", "0.5", "--noise", "0", "--planner", "random-walk")
        assertEquals(
            listOf(SensorStage.Lag(FirstOrderLag.timeConstant(0.5, 1.0)), SensorStage.Quantum(0.005)),
            sensor().stages,
        )
        runSmallBenchmark(out, "--preset", "original", "--noise", "0.25", "--quantum", "0.125")
        assertEquals(
            listOf(SensorStage.Slew(0.01), SensorStage.Noise(0.25), SensorStage.Quantum(0.125)),
            sensor().stages,
        )
        assertEquals("slew-limit noise 0.25 quantum 0.125", sensor().name)
    }

    @Test
    fun checkpointsAreThoseAskedForAndTheLastEndsTheRun() {
        runBenchmark("--out", "$out", "--environments", "2", "--checkpoints", "3, 7,15", "--field", "uniform")
        assertEquals(listOf("3", "7", "15"), column("move"))
        assertContains(out.resolve("report.html").readText(), "15, 10 readings each")
    }

    @Test
    fun whatIsAskedForReachesTheReport() {
        val flags = arrayOf(
            "--median", "5", "--slope", "7", "--crossing", "soft", "--keep-windows", "--epsilon", "0.25", "--walk",
            "diagonal", "--pattern", "raster", "--horizon", "3", "--expansions", "44", "--max-change", "0.75",
            "--no-discount-visits", "--choice", "last-polled", "--neighbours", "edge-or-corner", "--priority", "value",
            "--execution", "single-step", "--grid", "4x3", "--samples", "6", "--seed", "-5",
        )
        runSmallBenchmark(out, *flags)
        val page = out.resolve("report.html").readText()
        for (words in listOf(
            "4 x 3 cells",
            "12, 6 readings each",
            "median of 5, slope over 7 medians, epsilon 0.25 /s, crossing bounds soft, windows kept over cell borders",
            "diagonal clamped",
            "horizon 3, 44 expansions, largest change 0.75, visits on the path not discounted, moves over edge or " +
                "corner, expands by value, runs the last polled path, single step before planning again",
        )) {
            assertContains(page, words)
        }
        val typed = page.substringAfter("Command: <code>").substringBefore("</code>")
        assertEquals(
            "stillwater benchmark --preset report --out $out --environments 2 --moves 12 --grid 4x3 --samples 6 " +
                "--epsilon 0.25 --seed -5 --median 5 --slope 7 --crossing soft --keep-windows --walk diagonal " +
                "--pattern raster --horizon 3 --expansions 44 --max-change 0.75 --no-discount-visits " +
                "--execution single-step --choice last-polled --neighbours edge-or-corner --priority value",
            typed,
        )
    }

    @Test
    fun jsonIsAllThatIsPrinted() {
        val result = runSmallBenchmark(out, "--json", "--environments", "1", "--planner", "random-walk")
        val json = Json.parseToJsonElement(result.stdout).jsonObject
        assertEquals(
            results(out).map { it.getValue("mean_abs_error") },
            json.getValue("results").jsonArray.map { it.jsonObject.getValue("mean_abs_error").jsonPrimitive.content },
        )
        assertEquals(9, json.getValue("files").jsonArray.size)
        assertEquals("", result.stderr)
    }

    @Test
    fun quietPrintsNothing() {
        assertEquals("", runSmallBenchmark(out, "--quiet").output)
    }

    @Test
    fun claimsAreShownWithTheTables() {
        val shown = runSmallBenchmark(out).stdout
        assertEquals(7, Regex("(?m)^(holds|fails|cannot be told): ").findAll(shown).count(), shown)
    }

    @Test
    fun theSameSeedGivesTheSameBytesOnAnyNumberOfThreadsInAnyLanguage() {
        val names = listOf("results.csv", "extremes.csv", "bounds.csv", "figure-6.svg", "figure-7.svg", "report.html")
        fun bytes(vararg flags: String): List<ByteArray> {
            runSmallBenchmark(out, "--preset", "noisy", "--environments", "4", *flags)
            return names.map { out.resolve(it).readBytes() }
        }
        val once = bytes("--threads", "1")
        val before = Locale.getDefault()
        val again = try {
            Locale.setDefault(Locale.GERMANY)
            bytes("--threads", "2")
        } finally {
            Locale.setDefault(before)
        }
        for (i in names.indices) assertContentEquals(once[i], again[i], names[i])
        assertFalse(once[0].contentEquals(bytes("--seed", "2")[0]), "another seed")
    }

    @Test
    fun helpShowsEveryFlagGroupAndExamples() {
        val help = runBenchmark("--help")
        assertEquals(0, help.statusCode)
        assertContains(help.stdout, "stillwater benchmark --preset noisy --out noisy")
        for (flag in listOf("--preset", "--sensor", "--alpha", "--median", "--walk", "--choice", "--seed", "--json")) {
            assertContains(help.stdout, flag)
        }
    }

    @Test
    fun theExamplesOfTheHelpAreUnderstood() {
        val examples = runBenchmark("--help").stdout.lines().map { it.trim() }
            .filter { it.startsWith("stillwater benchmark") && "my-" !in it }
        assertTrue(examples.size >= 4, "$examples")
        for (example in examples) {
            val typed = example.removePrefix("stillwater benchmark").split(' ').filter { it.isNotEmpty() }
            runSmallBenchmark(out, *typed.toTypedArray(), "--out", "$out", "--moves", "2", "--quiet")
        }
    }
}
