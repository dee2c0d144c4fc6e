package stillwater.diagnosis

import com.github.ajalt.clikt.core.subcommands
import com.github.ajalt.clikt.testing.test
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import stillwater.cli.DiagnoseCommand
import stillwater.cli.Stillwater
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import java.nio.file.Path
import java.util.Locale
import kotlin.io.path.exists
import kotlin.io.path.readText
import kotlin.io.path.writeText
import kotlin.math.abs
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse

/** Figures of a log that has one coordinate only, such as the pressure of a profile. Seed fixed before the first run. */
class TransectFiguresTest {
    @TempDir
    private lateinit var directory: Path

    /** Down to 100 dbar and up again, a row every 2 s. */
    private fun casts(): Path {
        val sensor = SensorSpec("probe", listOf(SensorStage.Lag(8.0), SensorStage.Noise(0.02)))
        val probe = sensor.build(8.0, Random(621))
        val rows = (0 until 600).map { row ->
            val depth = 100 - abs(100 - row % 200)
            val water = 8 + sin(depth / 9.0) + sin(row / 31.0) / 5
            val shown = probe.step(water, 2.0, Conditions.NONE)
            String.format(Locale.ROOT, "%d,%d,%.3f,%.4f", 2 * row, depth, shown, water)
        }
        return directory.resolve("casts.csv").apply {
            writeText("time_s,pres_dbar,do_mg_l,truth\n" + rows.joinToString("\n", postfix = "\n"))
        }
    }

    @Test
    fun theyNameTheCoordinateAndHaveNoHeading() {
        val out = directory.resolve("out")
        val columns = listOf("--x", "pres_dbar", "--value", "do_mg_l", "--reference", "truth")
        val result = Stillwater().subcommands(DiagnoseCommand())
            .test(listOf("diagnose", "${casts()}", "--out", "$out", "--quiet") + columns)
        assertEquals(0, result.statusCode, result.output)
        val position = out.resolve("residuals-position.svg").readText()
        assertContains(position, "pres_dbar")
        assertFalse("North" in position || "East" in position, "a map of one coordinate")
        assertContains(out.resolve("residuals-speed.svg").readText(), "Speed (units of pres_dbar per s)")
        assertFalse(out.resolve("residuals-heading.svg").exists(), "a heading along one coordinate")
        assertContains(out.resolve("correlation.svg").readText(), "Lag (rows of 2 s)")
        assertContains(out.resolve("checks.svg").readText(), "correlation with rounding to 0.001, base")
        assertContains(out.resolve("residuals-time.svg").readText(), ResidualMeans.BAND)
    }

    @Test
    fun waterThatChangesIsTriedWithoutAReferenceAndHasNoFigureOfAModelItIsNotIn() {
        val out = directory.resolve("blind")
        val columns = listOf("--x", "pres_dbar", "--value", "do_mg_l")
        val result = Stillwater().subcommands(DiagnoseCommand())
            .test(listOf("diagnose", "${casts()}", "--out", "$out", "--quiet") + columns)
        assertEquals(0, result.statusCode, result.output)
        assertContains(out.resolve("diagnosis.json").readText(), "\"cause\": \"time-varying-field\"")
        assertFalse(out.resolve("cause-time-varying-field.svg").exists())
    }
}
