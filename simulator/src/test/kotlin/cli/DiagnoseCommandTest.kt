package stillwater.cli

import com.github.ajalt.clikt.core.subcommands
import com.github.ajalt.clikt.testing.test
import kotlinx.serialization.json.Json
import kotlinx.serialization.json.jsonObject
import org.junit.jupiter.api.io.TempDir
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import java.nio.file.Files
import java.nio.file.Path
import kotlin.io.path.exists
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
        for (name in listOf("residuals.csv", "report.html", "predicted.svg", "cause-asymmetric-response.png")) {
            assertTrue(out.resolve(name).exists(), name)
        }
    }

    @Test
    fun withoutAReferenceAGivenSensorIsSaidToBeUnusedAndNothingIsHeldOut() {
        val spec = directory.resolve("spec.json")
        Files.writeString(spec, """{"name": "s", "stages": [{"type": "first-order-lag", "time_constant_s": 5.0}]}""")
        val out = directory.resolve("blind")
        val result = diagnose(bench(), "--value", "probe", "--sensor", "$spec", "--numbers-only", "--out", "$out")
        assertEquals(0, result.statusCode, result.output)
        assertContains(result.stderr, "The sensor given was not used")
        assertFalse("–" in result.stdout, result.stdout)
        assertFalse("held-out" in result.stdout, result.stdout)
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
