package stillwater.cli

import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import org.junit.jupiter.params.ParameterizedTest
import org.junit.jupiter.params.provider.MethodSource
import java.nio.file.Files
import java.nio.file.Path
import kotlin.io.path.createDirectory
import kotlin.io.path.exists
import kotlin.io.path.readBytes
import kotlin.io.path.readText
import kotlin.io.path.writeBytes
import kotlin.io.path.writeText
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** Whatever is wrong with a flag or a sensor: one line that names it, what was expected and found; nothing written. */
class BenchmarkBadInputTest {
    @TempDir
    private lateinit var directory: Path

    /** @property message what the line must hold. @property flags `SPEC` stands for a file with the bytes [spec]. */
    class Case(val message: String, val flags: List<String>, val spec: ByteArray? = null) {
        override fun toString() = flags.joinToString(" ") + if (spec == null) "" else " ($message)"
    }

    @ParameterizedTest
    @MethodSource("badFlags", "badModelFlags", "badFleets", "badSensors", "unusedFlags")
    fun isRefusedInOneLineAndWritesNothing(case: Case) {
        assertEquals(case.message, refusal(case))
        val left = Files.list(directory).use { files -> files.map { it.fileName.toString() }.toList() }
        assertEquals(listOfNotNull(case.spec?.let { "spec.json" }), left)
    }

    @ParameterizedTest
    @MethodSource("badFlags", "badModelFlags", "badFleets", "badSensors", "unusedFlags")
    fun leavesEarlierResultsAsTheyWere(case: Case) {
        val out = directory.out().createDirectory()
        val earlier = out.resolve("results.csv").apply { writeText("earlier") }
        refusal(case)
        assertEquals("earlier", earlier.readText())
        assertEquals(listOf(earlier), Files.list(out).use { it.toList() })
    }

    /** What is wrong with the flags of [case], without the program's name before and the way to help after it. */
    private fun refusal(case: Case): String {
        val spec = directory.resolve("spec.json")
        case.spec?.let { spec.writeBytes(it) }
        val flags = case.flags.map { it.replace("SPEC", spec.toString()).replace("DIR", directory.toString()) }
        // Should one be let through by mistake, it ends soon.
        val small = listOf("--out", directory.out().toString(), "--environments", "1", "--moves", "12")
        val result = runBenchmark(*(small + flags).toTypedArray())
        assertEquals(BAD_INPUT, result.statusCode, result.output)
        assertEquals("", result.stdout)
        assertEquals(1, result.stderr.trimEnd().lines().size, result.stderr)
        val start = "stillwater benchmark: "
        val end = " (see stillwater benchmark --help)"
        assertTrue(result.stderr.startsWith(start) && result.stderr.trimEnd().endsWith(end), result.stderr)
        return result.stderr.trimEnd().removePrefix(start).removeSuffix(end).replace(directory.toString(), "DIR")
    }

    @Test
    fun anOutputThatIsAFileIsRefusedBeforeTheWork() {
        val file = directory.resolve("results").apply { writeText("mine") }
        val result = runBenchmark("--out", file.toString(), "--moves", "100000000", "--environments", "1000000")
        assertEquals(BAD_INPUT, result.statusCode)
        assertEquals("stillwater benchmark: output $file is a file; name a directory\n", result.stderr)
        assertEquals("mine", file.readText())
    }

    @Test
    fun anOutputUnderAFileIsRefused() {
        val file = directory.resolve("mine").apply { writeText("mine") }
        val result = runBenchmark("--out", file.resolve("results").toString(), "--moves", "1", "--environments", "1")
        assertEquals(BAD_INPUT, result.statusCode)
        assertEquals(1, result.stderr.trimEnd().lines().size, result.stderr)
        assertEquals("mine", file.readText())
    }

    @Test
    fun aSensorFileThatNeverEndsIsGivenUpOn() {
        val endless = Path.of("/dev/zero")
        if (!endless.exists()) return
        val result = runBenchmark("--out", directory.out().toString(), "--sensor", endless.toString())
        assertEquals(BAD_INPUT, result.statusCode)
        assertTrue("found a file of more than 1000000 bytes" in result.stderr, result.stderr)
        assertFalse(directory.out().exists())
    }

    @Test
    fun earlierFilesOfTheSameRunAreReplacedByAGoodOneOnly() {
        val out = directory.out()
        runSmallBenchmark(out, "--planner", "lawnmower")
        val before = Files.list(out).use { it.toList() }.associateWith { it.readBytes().toList() }
        val result = runBenchmark("--out", out.toString(), "--grid", "3x3")
        assertEquals(BAD_INPUT, result.statusCode)
        assertEquals(before, Files.list(out).use { it.toList() }.associateWith { it.readBytes().toList() })
    }

    private companion object {
        private fun flag(message: String, vararg flags: String) = Case(message, flags.toList())

        private fun sensor(said: String, json: String) =
            Case(
                "--sensor: DIR/spec.json$said",
                listOf("--sensor", "SPEC"),
                json.toByteArray(),
            )

        private const val PRESETS = "--preset: expected one of report, noisy, original"
        private const val FIELDS = "--field: expected some of uniform, gaussian, separated by commas"
        private const val FILTERS =
            "--filter: expected some of averaging, exponential, bounded, interval, self-calibrating, " +
                "bounded-extended, bayesian, separated by commas"
        private const val PLANNERS =
            "--planner: expected some of random-walk, lawnmower, bounded, polygon-rrt, " +
                "bounded-extended, information, settling-lawnmower, separated by commas"
        private const val MOVES = "--checkpoints: expected ascending moves above 0 such as 50,100,200"
        private const val GRID =
            "--grid: expected COLSxROWS such as 10x10, whole numbers above 0, 1000000 cells at most"
        private const val CYCLE =
            "--grid: expected an even number of rows or columns and two of each at least for the " +
                "lawnmower's hamiltonian-cycle, or another --pattern"

        @JvmStatic
        fun badFlags() = listOf(
            flag("$PRESETS, found 'loud'", "--preset", "loud"),
            flag("$FIELDS, found 'lake'", "--field", "lake"),
            flag("$FIELDS, found ''", "--field", ""),
            flag("$FIELDS, each once, found 'uniform,uniform'", "--field", "uniform,uniform"),
            flag("$FILTERS, found 'kalman'", "--filter", "kalman"),
            flag("$FILTERS, each once, found 'bounded, bounded'", "--filter", "bounded, bounded"),
            flag("$PLANNERS, found 'lawnmower,'", "--planner", "lawnmower,"),
            flag("$PLANNERS, each once, found 'bounded,bounded'", "--planner", "bounded,bounded"),
            flag("--environments: expected a whole number within 1..1000000, found '0'", "--environments", "0"),
            flag("--environments: expected a whole number within 1..1000000, found '1.5'", "--environments", "1.5"),
            flag("--moves: expected a whole number within 1..100000000, found '0'", "--moves", "0"),
            flag("--moves: expected a whole number within 1..100000000, found '1e9'", "--moves", "1e9"),
            flag("$MOVES, found '50;100'", "--checkpoints", "50;100"),
            flag("$MOVES, found ''", "--checkpoints", ""),
            flag("$MOVES, found '1,,3'", "--checkpoints", "1,,3"),
            flag("$MOVES, found '0,5'", "--checkpoints", "0,5"),
            flag("$MOVES, found '-1'", "--checkpoints", "-1"),
            flag("$MOVES, found '5,5'", "--checkpoints", "5,5"),
            flag("$MOVES, found '7,5'", "--checkpoints", "7,5"),
            flag("$MOVES, found '100000001'", "--checkpoints", "100000001"),
            flag("$MOVES, found '99999999999'", "--checkpoints", "99999999999"),
            flag("--checkpoints: expected moves within 1..12, found 13", "--checkpoints", "5,13"),
            flag("$GRID, found '10'", "--grid", "10"),
            flag("$GRID, found '0x5'", "--grid", "0x5"),
            flag("$GRID, found '1.5x2'", "--grid", "1.5x2"),
            flag("$GRID, found '-2x-2'", "--grid", "-2x-2"),
            flag("$GRID, found '2x2x2'", "--grid", "2x2x2"),
            flag("$GRID, found '1000000x2'", "--grid", "1000000x2"),
            flag("$CYCLE, found 3x3", "--grid", "3x3"),
            flag("$CYCLE, found 1x1", "--grid", "1x1"),
            flag("$CYCLE, found 1x8", "--grid", "1x8", "--planner", "bounded,lawnmower"),
            flag("$CYCLE, found 5x5", "--grid", "5x5", "--preset", "original", "--pattern", "hamiltonian-cycle"),
            flag("--samples: expected a whole number within 1..1000000, found '0'", "--samples", "0"),
            flag("--epsilon: expected a number of at least 0, found '-1'", "--epsilon", "-1"),
            flag("--epsilon: expected a number of at least 0, found 'NaN'", "--epsilon", "NaN"),
            flag("--epsilon: expected a number of at least 0, found 'auto'", "--epsilon", "auto"),
        )

        @JvmStatic
        fun badModelFlags() = listOf(
            flag("--alpha: expected a number above 1e-300 and below 1, found '1'", "--alpha", "1"),
            flag("--alpha: expected a number above 1e-300 and below 1, found '0'", "--alpha", "0"),
            flag("--alpha: expected a number above 1e-300 and below 1, found '5e-324'", "--alpha", "5e-324"),
            flag("--noise: expected a number within 0..1000000, found '-0.1'", "--noise", "-0.1"),
            flag("--noise: expected a number within 0..1000000, found '1e308'", "--noise", "1e308"),
            flag("--quantum: expected a number of at least 0, found '-1'", "--quantum", "-1"),
            flag("--quantum: expected a number of at least 0, found '1e999'", "--quantum", "1e999"),
            flag("--median: expected an odd number within 1..999, found '4'", "--median", "4"),
            flag("--slope: expected a whole number within 2..999, found '1'", "--slope", "1"),
            flag("--crossing: expected one of plain, soft, reset, found 'hard'", "--crossing", "hard"),
            flag("--walk: expected one of edge, diagonal, found 'king'", "--walk", "king"),
            flag(
                "--pattern: expected one of hamiltonian-cycle, back-and-forth, rows-then-columns, " +
                    "four-directions, raster, found 'spiral'",
                "--pattern",
                "spiral",
            ),
            flag("--horizon: expected a whole number within 1..1000, found '0'", "--horizon", "0"),
            flag("--expansions: expected a whole number within 1..1000000, found '0'", "--expansions", "0"),
            flag("--max-change: expected a number above 0, found '0'", "--max-change", "0"),
            flag("--execution: expected one of whole-path, single-step, found 'half'", "--execution", "half"),
            flag("--choice: expected one of best, last-polled, found 'worst'", "--choice", "worst"),
            flag("--neighbours: expected one of edge, edge-or-corner, found 'all'", "--neighbours", "all"),
            flag("--priority: expected one of value-per-move, value, found 'depth'", "--priority", "depth"),
            flag("--seed: expected a whole number, found '0x10'", "--seed", "0x10"),
            flag("--seed: expected a whole number, found '9223372036854775808'", "--seed", "9223372036854775808"),
            flag("--threads: expected a whole number within 1..1024, found '0'", "--threads", "0"),
            flag(
                "--sensor: expected either --sensor or --alpha, --noise and --quantum, found both",
                "--sensor",
                "SPEC",
                "--noise",
                "1",
            ),
            flag(
                "--sensor: DIR/none.json: expected a sensor spec (JSON), found no such file",
                "--sensor",
                "DIR/none.json",
            ),
            flag("--sensor: DIR: expected a sensor spec (JSON), found a directory", "--sensor", "DIR"),
        )

        private const val SQUARE = "[[0,0],[9,0],[9,9],[0,9],[0,0]]"

        /** Water of [rings] that is water, and no place for what the flags ask for. */
        private fun unfit(said: String, rings: String, vararg flags: String) = Case(
            "--area: expected water on which boats find ways with this --cell, --margin and --resolution, found that $said",
            listOf("--area", "SPEC", "--area-units", "metres", *flags),
            """{"type": "Polygon", "coordinates": [$rings]}""".toByteArray(),
        )

        private fun area(said: String, json: String) =
            Case("--area: DIR/spec.json:$said", listOf("--area", "SPEC"), json.toByteArray())

        private const val BOATS = "--boats: expected different numbers of boats within 1..10000 such as 1,2,4,8"

        @JvmStatic
        fun badFleets() = listOf(
            flag("$BOATS, found '0'", "--boats", "0"),
            flag("$BOATS, found '1,,2'", "--boats", "1,,2"),
            flag("$BOATS, found '2,2'", "--boats", "2,2"),
            flag("--boats: expected at most 100, one a cell, found 101", "--boats", "4,101"),
            flag("--budget-moves: expected a whole number above 0, found '0'", "--budget-moves", "0"),
            flag("--budget-time: expected a number of seconds above 0, found '-1'", "--budget-time", "-1"),
            flag(
                "--budget-distance: expected one budget, found --budget-moves too",
                "--budget-moves",
                "5",
                "--budget-distance",
                "5",
            ),
            flag("--cell: expected --area to go with it, found none", "--cell", "5"),
            flag("--area: DIR/none.json: expected GeoJSON, found no such file", "--area", "DIR/none.json"),
            flag("--speed: expected a number above 0, found '0'", "--speed", "0"),
            flag("--margin: expected a number of metres of at least 0, found '-1'", "--margin", "-1"),
            area("1:1: expected $WATER, found 0 of them", """{"type": "FeatureCollection", "features": []}"""),
            area("1:10: type: expected Polygon or MultiPolygon, found 'LineString'", """{"type": "LineString"}"""),
            area(
                "1:24: expected each field once, found 'type' again, which 1:2 has already",
                """{"type": "LineString", "type": 1}""",
            ),
            area(
                "1:38: coordinates[0][0]: expected longitude and latitude in degrees, or --area-units metres, " +
                    "found (500.0, 0.0)",
                """{"type": "Polygon", "coordinates": [[[500, 0], [501, 0], [501, 1]]]}""",
            ),
            area(
                "1:46: coordinates[0][1]: expected two numbers, found [1,\"a\"]",
                """{"type": "Polygon", "coordinates": [[[0, 0], [1, "a"], [1, 1]]]}""",
            ),
            Case(
                "--area: DIR/spec.json:1:37: coordinates[0]: the shore crosses or touches " +
                    "itself: edge 1 (0.0 m, 0.0 m) to (4.0 m, 4.0 m) meets edge 3 (4.0 m, 0.0 m) to (0.0 m, 3.0 m)",
                listOf("--area", "SPEC", "--area-units", "metres"),
                """{"type": "Polygon", "coordinates": [[[0, 0], [4, 4], [4, 0], [0, 3]]]}""".toByteArray(),
            ),
            unfit(
                "no water is left 1000.0 m away from land; take a smaller margin or a finer resolution",
                SQUARE,
                "--margin",
                "1000",
            ),
            unfit(
                "a resolution of 0.001 m makes 9000 x 9000 points; 250000 are allowed",
                SQUARE,
                "--resolution",
                "0.001",
            ),
            unfit("no centre of the 10 x 10 cells is on the water; take more cells", "$SQUARE, $SQUARE"),
            Case(
                "--grid: expected --cell with --area, found --grid",
                listOf("--area", "SPEC", "--area-units", "metres", "--planner", "polygon-rrt", "--grid", "4x4"),
                """{"type": "Polygon", "coordinates": [[[0, 0], [4, 0], [4, 4], [0, 4]]]}""".toByteArray(),
            ),
        )

        private const val BOUNDED_ONLY =
            "expected --planner bounded to go with it, found --planner random-walk,information"

        /** What the runs that are asked for would not look at. */
        @JvmStatic
        fun unusedFlags() = listOf(
            flag(
                "--median: expected --filter bounded or bounded-extended to go with it, found --filter averaging,interval",
                "--filter",
                "averaging,interval",
                "--planner",
                "lawnmower",
                "--median",
                "5",
            ),
            flag(
                "--epsilon: expected --filter bounded to go with it, found --filter interval",
                "--filter",
                "interval",
                "--epsilon",
                "0.1",
            ),
            flag(
                "--clear-windows: expected --filter bounded to go with it, found --filter interval",
                "--filter",
                "interval",
                "--clear-windows",
            ),
            flag(
                "--slowest: expected --filter interval to go with it, found the usual --filter bounded,averaging",
                "--slowest",
                "9",
            ),
            flag(
                "--factor: expected --filter self-calibrating or bayesian to go with it, found the usual --filter bounded,averaging",
                "--factor",
                "2",
            ),
            flag(
                "--rrt-iterations: expected --planner polygon-rrt to go with it, found the usual --planner " +
                    "random-walk,lawnmower,bounded",
                "--rrt-iterations",
                "9",
            ),
            flag("--choice: $BOUNDED_ONLY", "--planner", "random-walk,information", "--choice", "best"),
            flag("--discount-visits: $BOUNDED_ONLY", "--planner", "random-walk,information", "--discount-visits"),
            flag("--no-discount-visits: $BOUNDED_ONLY", "--planner", "random-walk,information", "--no-discount-visits"),
            flag(
                "--walk: expected --planner random-walk to go with it, found --planner bounded",
                "--planner",
                "bounded",
                "--walk",
                "edge",
            ),
            flag(
                "--pattern: expected --planner lawnmower or settling-lawnmower to go with it, found --planner bounded",
                "--planner",
                "bounded",
                "--lawnmower",
                "raster",
            ),
            flag("--margin: expected --area to go with it, found none", "--planner", "polygon-rrt", "--margin", "3"),
            flag(
                "--speed: expected --area or --planner polygon-rrt to go with it, found --planner bounded",
                "--planner",
                "bounded",
                "--speed",
                "3",
            ),
        )

        private const val WATER = "one Polygon of water without \"keep-out\": true"

        @JvmStatic
        fun badSensors() = listOf(
            sensor(":1:1: expected an object in braces with name, stages, found the end", ""),
            sensor(":1:1: expected the field stages, found none", """{"name": "x"}"""),
            sensor(
                ":1:35: stages[0].type: expected one of asymmetric-lag, combined-lag, correlated-noise, " +
                    "cross-sensitivity, dead-time, drift, first-order-lag, flow-dependent-lag, gain-offset, " +
                    "hysteresis, noise, offset-steps, outliers, quantisation, rate-limited-lag, saturation, " +
                    "slew-limit, temperature-dependent-lag, two-path-lag, found 'magic'",
                """{"name": "x", "stages": [{"type": "magic"}]}""",
            ),
            sensor(
                ":1:73: stages[0]: time_constant_s (-1.0 s) must be above 0 and finite",
                """{"name": "x", "stages": [{"type": "first-order-lag", "time_constant_s": -1}]}""",
            ),
            sensor(
                ":1:63: stages[0]: rate (0.0 sensor units/s) must be above 0 and finite",
                """{"name": "x", "stages": [{"type": "slew-limit", "rate_per_s": 0}]}""",
            ),
            sensor(
                ":1:73: stages[0].time_constant_s: expected a number, found '1e999'",
                """{"name": "x", "stages": [{"type": "first-order-lag", "time_constant_s": 1e999}]}""",
            ),
            sensor(
                ":1:75: stages[0]: expected each field once, found 'time_constant_s' again, which 1:54 has already",
                """{"name": "x", "stages": [{"type": "first-order-lag", "time_constant_s": 1,"time_constant_s": 9}]}""",
            ),
            sensor(": expected a sensor spec (JSON), found a file of more than 1000000 bytes", " ".repeat(1_000_001)),
            Case(
                "--sensor: DIR/spec.json: expected a sensor spec (JSON), found bytes that are no UTF-8 text",
                listOf("--sensor", "SPEC"),
                byteArrayOf(0x7b, 0xff.toByte(), 0x7d),
            ),
        )
    }
}
