package stillwater.cli

import com.github.ajalt.clikt.core.subcommands
import com.github.ajalt.clikt.testing.CliktCommandTestResult
import com.github.ajalt.clikt.testing.test
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import java.nio.file.Path
import kotlin.io.path.readText
import kotlin.io.path.writeText
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertNotEquals

/** Sensors that follow how fast the boat goes, and those that follow what no simulation has. Seeds fixed before the first run. */
class SimulatedConditionsTest {
    @TempDir
    private lateinit var directory: Path

    private fun sensor(name: String, stage: String): Path =
        directory.resolve("$name.json").apply { writeText("""{"name": "$name", "stages": [$stage]}""") }

    private fun flow(exponent: Double) = sensor(
        "flow-$exponent",
        """{"type": "flow-dependent-lag", "time_constant_s": 8, "reference_speed_m_per_s": 0.5,
            "exponent": $exponent}""",
    )

    private fun benchmark(sensor: Path): Pair<CliktCommandTestResult, Path> {
        val out = directory.resolve("benchmark-${sensor.fileName}")
        return runSmallBenchmark(out, "--planner", "lawnmower", "--sensor", "$sensor", "--seed", "601") to out
    }

    private fun simulate(sensor: Path): Pair<CliktCommandTestResult, Path> {
        val out = directory.resolve("simulate-${sensor.fileName}")
        val mission = directory.resolve("pond.json").apply { writeText(POND.replace(":300", ":60")) }
        val flags = listOf("--headless", "--seed", "602", "--probe-period", "1", "--sensor", "$sensor", "--out", "$out")
        val result = Stillwater().subcommands(SimulateCommand()).test(listOf("simulate", "$mission") + flags)
        assertEquals(0, result.statusCode, result.output)
        return result to out
    }

    @Test
    fun aLagThatFollowsTheSpeedFollowsTheBoats() {
        val (slow, fast) = listOf(0.1, 2.0).map { simulate(flow(it)) }
        assertNotEquals(slow.second.resolve("mission.txt").readText(), fast.second.resolve("mission.txt").readText())
        assertFalse("the simulation has no" in slow.first.stderr + fast.first.stderr, fast.first.stderr)
        val errors = listOf(0.1, 2.0).map { exponent ->
            val (result, out) = benchmark(flow(exponent))
            assertEquals("", result.stderr)
            results(out).map { it.getValue("mean_abs_error") }
        }
        assertNotEquals(errors[0], errors[1])
    }

    @Test
    fun whatTheSimulationDoesNotHaveIsSaid() {
        val warm = sensor(
            "warm",
            """{"type": "temperature-dependent-lag", "time_constant_s": 8, "reference_temperature_deg_c": 20,
                "relative_change_per_deg_c": 0.03},
               {"type": "cross-sensitivity", "condition": "salinity", "reference": 30, "coefficient": 0.02}""",
        )
        val said = "the simulation has no temperature and no salinity: what in the sensor depends on these has no " +
            "effect here"
        for ((result, out) in listOf(simulate(warm), benchmark(warm))) {
            assertContains(result.stderr, "warning: $said\n")
            assertContains(out.resolve("report.html").readText(), said)
        }
        assertContains(directory.resolve("simulate-warm.json/summary.json").readText(), said)
    }

    @Test
    fun aPartThatDependsOnNothingIsNotSaidToDoSo() {
        val even = sensor(
            "even",
            """{"type": "combined-lag", "time_constant_s": 8, "rising_over_falling": 2},
               {"type": "cross-sensitivity", "condition": "salinity", "reference": 30, "coefficient": 0}""",
        )
        assertEquals("", benchmark(even).first.stderr)
    }
}
