package stillwater.correct

import com.github.ajalt.clikt.core.subcommands
import com.github.ajalt.clikt.testing.CliktCommandTestResult
import com.github.ajalt.clikt.testing.test
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import stillwater.cli.CorrectCommand
import stillwater.cli.Stillwater
import java.nio.file.Path
import kotlin.io.path.readLines
import kotlin.io.path.writeText
import kotlin.math.exp
import kotlin.math.sin
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** What `correct` does not know, it says. */
class CorrectHonestyTest {
    @TempDir
    private lateinit var directory: Path

    private fun correct(text: String, vararg flags: String): CliktCommandTestResult {
        val log = directory.resolve("log.csv").also { it.writeText(text) }
        val out = directory.resolve("results").toString()
        val arguments = listOf("correct", log.toString(), "--value", "slow", "--out", out) + flags
        return Stillwater().subcommands(CorrectCommand()).test(arguments)
    }

    private fun water(x: Double, y: Double) = sin(x / 6) + 0.7 * sin(y / 7 + x / 15)

    /** A boat that mows a pond of 60 m by 60 m at 1 m/s; a lag of 6 s; a reference in some rows. */
    private fun pond(
        rows: Int,
        referenceEvery: Int,
        said: (Int, Double) -> Double = { _, shown -> shown },
    ) = buildString {
        appendLine("time_s,x_m,y_m,slow,fast")
        var shown = water(0.0, 0.0)
        for (i in 0 until rows) {
            val along = Math.floorMod(i, 120).let { if (it < 60) it.toDouble() else 120.0 - it }
            val across = (i / 60 * 6 % 66).toDouble()
            val (x, y) = along to across
            shown += (1 - exp(-1.0 / 6)) * (water(x, y) - shown)
            val fast = if (i % referenceEvery == 0) "%.4f".format(java.util.Locale.ROOT, water(x, y)) else ""
            appendLine("$i,$x,$y,${"%.4f".format(java.util.Locale.ROOT, said(i, shown))},$fast")
        }
    }

    @Test
    fun thirtyRowsTeachNothing() {
        val rows = (0 until 30).joinToString("") {
            "$it,$it,0,${8 + 0.002 * it + 0.004 * (it * 7 % 5)},${8.05 + 0.002 * it + 0.004 * (it * 3 % 7)}\n"
        }
        val result = correct("time_s,x_m,y_m,slow,fast\n$rows", "--reference", "fast")
        assertEquals(0, result.statusCode, result.output)
        assertContains(result.stdout, "sensor: not learned")
        assertContains(result.stderr, "its 30 rows, 29 s long, fit any lag from ")
    }

    @Test
    fun aReferenceNowAndThenIsNotTakenForTheWaterBetween() {
        val result = correct(pond(600, referenceEvery = 15), "--reference", "fast")
        assertEquals(0, result.statusCode, result.output)
        assertContains(result.stderr, "it has a row every 15 s only")
        assertContains(result.stderr, "learned from passes through the same water instead")
        // Legs beside each other never cross.
        assertContains(result.stdout, "not checked, for the boat's track nowhere crosses itself")
    }

    @Test
    fun timesShorterThanRowsCanShowAreNone() {
        val result = correct(pond(500, referenceEvery = 1), "--reference", "fast")
        assertEquals(0, result.statusCode, result.output)
        val sensor = result.stdout.lines().first { it.startsWith("sensor:") }
        assertFalse(Regex("dead time in s 0\\.0").containsMatchIn(sensor), sensor)
        assertContains(result.stdout, "log: log.csv (survey CSV)")
    }

    private fun timeConstant(result: CliktCommandTestResult): Double {
        assertEquals(0, result.statusCode, result.output)
        val sensor = result.stdout.lines().first { it.startsWith("sensor:") }
        val found = Regex("first-order-lag: time constant in s ([0-9.]+)").find(sensor)
        return checkNotNull(found) { sensor }.groupValues[1].toDouble()
    }

    @Test
    fun wildReadingsAreAllLeftOutAndDoNotBearOnTheSensor() {
        val log = pond(600, referenceEvery = 1) { i, shown -> if (i % 37 == 20) shown + 4 - i % 2 * 8 else shown }
        val result = correct(log, "--reference", "fast")
        // As without them: rows of 1 s and the reference's straight lines allow a hundredth.
        assertEquals(6.0, timeConstant(result), 0.3)
        assertContains(result.stderr, "16 readings stand out from those around them")
    }

    @Test
    fun readingsAtAnEndOfTheRangeAreToldAndNotLearnedFrom() {
        val result = correct(pond(600, referenceEvery = 1) { _, shown -> minOf(shown, 0.6) }, "--reference", "fast")
        assertEquals(6.0, timeConstant(result), 0.3)
        assertContains(result.stderr, "readings are at the upper end of the sensor's range (0.6)")
        val rows = directory.resolve("results/corrected.csv").readLines().drop(1).map { it.split(',') }
        val atEnd = rows.filter { it[3] == "0.6000" }
        assertTrue(atEnd.size > 60, "${atEnd.size}")
        val inside = atEnd.count { it[4].toDouble() in it[6].toDouble()..it[7].toDouble() }
        // 95 % were nominal; a stretch at the end is one case, and there are about ten.
        assertTrue(inside > 0.8 * atEnd.size, "$inside of ${atEnd.size}")
    }
}
