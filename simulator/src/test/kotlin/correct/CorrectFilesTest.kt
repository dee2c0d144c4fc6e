package stillwater.correct

import com.github.ajalt.clikt.core.subcommands
import com.github.ajalt.clikt.testing.test
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import stillwater.cli.CorrectCommand
import stillwater.cli.Stillwater
import java.nio.file.Path
import kotlin.io.path.readLines
import kotlin.io.path.writeText
import kotlin.math.abs
import kotlin.math.sin
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class CorrectFilesTest {
    @TempDir
    private lateinit var directory: Path

    @Test
    fun directoriesOfSeveralColumnsDiffer() {
        assertEquals(listOf(""), CorrectFiles.places(listOf("DO (mg/L)")))
        val columns = listOf("DO (mg/L)", "DO [mg/L]", "do (mg/L)", "DO__mg_L__2", "pH")
        val expected = listOf("DO__mg_L_/", "DO__mg_L__2/", "do__mg_L__3/", "DO__mg_L__2_2/", "pH/")
        assertEquals(expected, CorrectFiles.places(columns))
    }

    @Test
    fun readingsWithALargeOffsetKeepTheirLastDigits() {
        val log = directory.resolve("pressure.csv")
        val rows = (0 until 60).map { "$it,$it,0,${"%.2f".format(java.util.Locale.ROOT, 101_325 + sin(it / 9.0))}" }
        log.writeText("time_s,x_m,y_m,pa\n" + rows.joinToString("\n"))
        val out = directory.resolve("results")
        val result = Stillwater().subcommands(CorrectCommand())
            .test(listOf("correct", "$log", "--value", "pa", "--out", "$out"))
        assertEquals(0, result.statusCode, result.output)
        val cells = out.resolve("corrected.csv").readLines().drop(1).map { it.split(',').takeLast(3) }
        // The curve bends by 0.012 a second squared: smoothed readings stay within a few of their steps of 0.01.
        for ((row, added) in rows.zip(cells)) {
            val reading = row.substringAfterLast(',').toDouble()
            assertTrue(abs(added[0].toDouble() - reading) < 0.03, "$row: $added")
        }
    }
}
