package stillwater.cli

import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import org.junit.jupiter.params.ParameterizedTest
import org.junit.jupiter.params.provider.ValueSource
import java.nio.file.Path
import kotlin.io.path.readText
import kotlin.io.path.writeText
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** Settings that make no sense and are legal: a full set of finite numbers comes of each. */
class BenchmarkExtremesTest {
    @TempDir
    private lateinit var directory: Path
    private val out: Path get() = directory.out()

    private fun run(flags: String) =
        runSmallBenchmark(out, *flags.split(' ').filter { it.isNotEmpty() }.toTypedArray())

    private fun assertAllNumbersAreThere(environments: Int = 2) {
        val rows = results(out)
        assertTrue(rows.isNotEmpty())
        for (row in rows) {
            for (name in listOf("mean_abs_error", "standard_error", "p10", "p90")) {
                if (name == "standard_error" && environments == 1) {
                    assertEquals("", row[name], "one environment shows no spread")
                } else {
                    val number = row.getValue(name).toDoubleOrNull()
                    assertTrue(number != null && number.isFinite() && number >= 0, "$name in $row")
                }
            }
        }
        for (name in listOf("figure-6.svg", "figure-7.svg", "report.html")) {
            assertFalse(Regex("NaN|Infinity").containsMatchIn(out.resolve(name).readText()), name)
        }
    }

    @ParameterizedTest
    @ValueSource(
        strings = [
            "--grid 1x1 --pattern raster",
            "--grid 1x1 --pattern back-and-forth --walk diagonal",
            "--grid 1x1 --pattern rows-then-columns --neighbours edge-or-corner --choice last-polled",
            "--grid 1x7 --pattern rows-then-columns",
            "--grid 7x1 --pattern back-and-forth --walk diagonal",
            "--grid 1x2 --pattern raster --preset original",
            "--samples 1",
            "--median 999",
            "--slope 2 --median 1 --samples 1 --keep-windows",
            "--alpha 0.999999",
            "--alpha 1e-9",
            "--alpha 1e-299",
            "--epsilon 1e308",
            "--noise 1000000 --crossing plain",
            "--noise 1000000 --crossing reset --keep-windows",
            "--quantum 1e308",
            "--max-change 1e308 --horizon 1000",
            "--expansions 1 --horizon 1",
        ],
    )
    fun makeAFullSetOfNumbers(flags: String) {
        run(flags)
        assertAllNumbersAreThere()
    }

    @Test
    fun oneEnvironmentOfOneMove() {
        run("--environments 1 --moves 1")
        assertEquals(listOf("1"), results(out).map { it.getValue("move") }.distinct())
        assertAllNumbersAreThere(environments = 1)
    }

    @Test
    fun aBoatInASingleCellStaysAndLearnsItWithAveraging() {
        run("--grid 1x1 --pattern raster --moves 3")
        // The sensor has settled at the truth before the first reading: the mean of equal readings, up to rounding.
        val errors = results(out).filter {
            it["filter"] == "averaging"
        }.map { it.getValue("mean_abs_error").toDouble() }
        assertEquals(2 * 3 * 3, errors.size)
        assertTrue(errors.all { it < 1e-15 }, "$errors")
    }

    @Test
    fun aPerfectSensorLeavesAveragingWithoutError() {
        val spec = directory.resolve("perfect.json").apply { writeText("""{"name": "", "stages": []}""") }
        run("--sensor $spec --planner lawnmower --grid 2x2 --moves 4")
        assertAllNumbersAreThere()
        val last = results(out).filter { it["filter"] == "averaging" && it["move"] == "4" }
        // Means of ten equal numbers, up to rounding.
        assertTrue(last.all { it.getValue("mean_abs_error").toDouble() < 1e-15 }, "$last")
    }

    @Test
    fun aSensorOfTheLargestNumbersIsNoCrash() {
        val stages = """[{"type": "noise", "standard_deviation": 1e15}]"""
        val spec = directory.resolve("huge.json").apply { writeText("""{"name": "huge", "stages": $stages}""") }
        val result = run("--sensor $spec --json")
        assertFalse(
            Regex("NaN|Infinity").containsMatchIn(result.stdout.substringBefore("\"claims\"")),
            "no JSON numbers",
        )
    }
}
