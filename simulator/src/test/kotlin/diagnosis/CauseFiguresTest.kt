package stillwater.diagnosis

import com.github.ajalt.clikt.core.subcommands
import com.github.ajalt.clikt.testing.test
import org.junit.jupiter.api.DynamicTest
import org.junit.jupiter.api.DynamicTest.dynamicTest
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.TestFactory
import org.junit.jupiter.api.io.TempDir
import stillwater.cli.DiagnoseCommand
import stillwater.cli.Stillwater
import stillwater.diagnose.Cause
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import java.nio.file.Path
import java.util.Locale
import kotlin.io.path.exists
import kotlin.io.path.readText
import kotlin.io.path.writeText
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** What was named is drawn against what it goes with. Seed fixed before the first run. */
class CauseFiguresTest {
    @TempDir
    private lateinit var directory: Path

    private val rows = 700

    private fun log(name: String, stages: List<SensorStage>): Path {
        val sensor = SensorSpec("probe", stages).build(8.0, Random(733))
        val lines = (0 until rows).map { row ->
            val water = 8 + sin(row / 9.0) + 0.6 * sin(row / 5.0 + 1) + 0.4 * sin(row / 31.0)
            val salinity = 30 + 2 * sin(row / 47.0)
            val temperature = 15 + 6 * sin(row / 83.0)
            val now = Conditions(mapOf("salinity" to salinity, Conditions.TEMPERATURE to temperature))
            val shown = sensor.step(water, 1.0, now)
            String.format(Locale.ROOT, "%d,%d,0,%.6f,%.6f,%.4f,%.4f", row, row, shown, water, salinity, temperature)
        }
        return directory.resolve("$name.csv").apply {
            writeText("time_s,x_m,y_m,do_mg_l,truth,psu,temp_c\n" + lines.joinToString("\n", postfix = "\n"))
        }
    }

    @TestFactory
    fun eachGoesWithItsOwnQuantity(): List<DynamicTest> {
        val lag = SensorStage.Lag(6.0)
        val noise = SensorStage.Noise(0.01)
        val step = "Share of the step yet to be shown"
        return listOf(
            Triple(Cause.DEAD_TIME, listOf(SensorStage.Delay(4.0), lag, noise), step),
            Triple(Cause.SECOND_ORDER_RESPONSE, listOf(lag, SensorStage.Lag(4.0), noise), step),
            Triple(Cause.CROSS_SENSITIVITY, listOf(lag, SensorStage.Cross("salinity", 30.0, 0.1), noise), "salinity"),
            Triple(
                Cause.TEMPERATURE_DEPENDENT_RESPONSE,
                listOf(SensorStage.TemperatureLag(6.0, 15.0, -0.06), noise),
                "Later than the base has it (s)",
            ),
            Triple(
                Cause.QUANTISATION,
                listOf(lag, noise, SensorStage.Quantum(0.1)),
                "Predicted value above the step below it",
            ),
            Triple(Cause.SATURATION, listOf(lag, noise, SensorStage.Range(null, 8.6)), "Predicted value of do_mg_l"),
        ).map { (cause, stages, label) -> dynamicTest(cause.label) { assertDrawn(cause, stages, label) } }
    }

    @Test
    fun theReadingsThemselvesAreNoCondition() {
        val file = log("itself", listOf(SensorStage.Lag(6.0), SensorStage.Noise(0.01)))
        val out = directory.resolve("none")
        val columns = listOf("--value", "do_mg_l", "--reference", "truth", "--condition", "v=do_mg_l")
        val result = Stillwater().subcommands(
            DiagnoseCommand(),
        ).test(listOf("diagnose", "$file", "--out", "$out") + columns)
        assertEquals(2, result.statusCode)
        assertContains(result.stderr, "expected another column than the readings', found 'v=do_mg_l'")
        assertFalse(out.exists())
    }

    private fun assertDrawn(cause: Cause, stages: List<SensorStage>, label: String) {
        val out = directory.resolve(cause.label)
        val conditions = listOf("--condition", "salinity=psu", "--condition", "temperature=temp_c")
        val columns = listOf("--value", "do_mg_l", "--reference", "truth") + conditions
        val result = Stillwater().subcommands(DiagnoseCommand())
            .test(listOf("diagnose", "${log(cause.label, stages)}", "--out", "$out") + columns)
        assertEquals(0, result.statusCode, result.output)
        val detail = out.resolve("cause-${cause.label}-detail.svg")
        assertTrue(detail.exists(), result.output)
        assertContains(detail.readText(), label)
        assertContains(out.resolve("report.html").readText(), label)
    }
}
