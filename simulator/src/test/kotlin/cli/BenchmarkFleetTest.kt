package stillwater.cli

import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import java.nio.file.Path
import kotlin.io.path.exists
import kotlin.io.path.readLines
import kotlin.io.path.readText
import kotlin.io.path.writeText
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** `benchmark` with several boats, budgets and an area, as a user runs it. */
class BenchmarkFleetTest {
    @TempDir
    private lateinit var out: Path

    private val lake = """{"type": "Polygon", "coordinates": [
        [[0,0],[10,0],[10,8],[0,8],[0,0]], [[4,3],[6,3],[6,5],[4,5],[4,3]]]}"""

    private fun rows(name: String): List<Map<String, String>> {
        val lines = out.resolve(name).readLines().map { it.split(',') }
        return lines.drop(1).map { row -> lines.first().zip(row).toMap() }
    }

    @Test
    fun severalNumbersOfBoatsAreComparedInFilesFigureAndTable() {
        val flags = arrayOf("--field", "uniform", "--planner", "lawnmower,random-walk", "--filter", "averaging")
        val result = runSmallBenchmark(out, *flags, "--boats", "1,3")
        assertEquals(setOf("1", "3"), results(out).map { it.getValue("boats") }.toSet())
        assertTrue(out.resolve("boats-uniform.svg").exists())
        assertContains(result.stdout, "What more boats gain, field uniform")
        assertContains(out.resolve("report.html").readText(), "Error against boats at equal time")
        runSmallBenchmark(out, *flags)
        assertFalse(out.resolve("boats-uniform.svg").exists(), "no figure of an earlier run stands beside the results")
    }

    @Test
    fun aBudgetIsKeptAndItsUseWrittenDown() {
        for ((flag, limit) in listOf("--budget-moves" to "20", "--budget-distance" to "30", "--budget-time" to "150")) {
            val flags = arrayOf("--planner", "random-walk,bounded,lawnmower,polygon-rrt", "--rrt-iterations", "30")
            val result = runSmallBenchmark(out, "--field", "uniform", "--moves", "60", *flags, flag, limit)
            val rows = rows("budget.csv")
            assertEquals(8, rows.size)
            for (row in rows) {
                assertEquals(flag.removePrefix("--budget-"), row.getValue("budget"))
                // Sums of the same numbers in another order.
                assertTrue(row.getValue("most_used").toDouble() <= limit.toDouble() * (1 + 1e-9), "$row")
                assertEquals("1.0", row.getValue("share_home"), "$row")
            }
            assertContains(result.stdout, "Used of the budget")
        }
        runSmallBenchmark(out)
        assertFalse(out.resolve("budget.csv").exists())
    }

    @Test
    fun aTrialThatEndsBeforeTheBoatsAreHomeIsWarnedOf() {
        val result = runSmallBenchmark(out, "--field", "uniform", "--planner", "lawnmower", "--budget-moves", "50")
        assertContains(result.stderr, "warning: as few as 0 % of the boats were home after 12 moves")
    }

    @Test
    fun everyPlannerSurveysALakeRoundItsIsland() {
        val file = out.resolve("lake.geojson").apply { writeText(lake) }
        val flags = arrayOf("--area", "$file", "--area-units", "metres", "--cell", "1", "--margin", "0.2")
        val names = "random-walk,lawnmower,bounded,bounded-extended,information,settling-lawnmower"
        val more = arrayOf("--filter", "self-calibrating", "--field", "gaussian", "--moves", "150")
        runSmallBenchmark(out, *flags, "--planner", names, *more, "--lawnmower", "back-and-forth")
        for (name in names.split(',')) {
            assertTrue(out.resolve("voyage-gaussian-$name.svg").exists(), name)
            val last = results(out).last { it.getValue("planner") == name }
            val error = last.getValue("mean_abs_error").toDouble()
            // A round takes all but the random walk a little more than its 76 cells; settling waits in each.
            assertTrue(error < if (name == "random-walk" || name.startsWith("settling")) 0.3 else 0.02, "$name: $error")
        }
    }

    @Test
    fun boatsOnALakeAreDrawnAndLandDoesNotCount() {
        val file = out.resolve("lake.geojson").apply { writeText(lake) }
        val flags = arrayOf("--area", "$file", "--area-units", "metres", "--margin", "0.2")
        val fleet = arrayOf("--boats", "2", "--moves", "120", "--filter", "self-calibrating")
        runSmallBenchmark(out, *flags, *fleet, "--field", "gaussian")
        val svg = out.resolve("voyage-gaussian.svg").readText()
        assertContains(svg, "boat 2")
        // Were the island's cells counted, with their prior of 0.5, they alone would leave a larger error.
        val last = results(out).last()
        assertEquals("120", last.getValue("move"))
        assertTrue(last.getValue("mean_abs_error").toDouble() < 0.01, "$last")
    }
}
