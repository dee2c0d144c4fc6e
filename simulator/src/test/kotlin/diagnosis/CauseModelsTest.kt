package stillwater.diagnosis

import kotlinx.coroutines.runBlocking
import org.junit.jupiter.api.DynamicTest
import org.junit.jupiter.api.DynamicTest.dynamicTest
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.TestFactory
import org.junit.jupiter.api.io.TempDir
import stillwater.cli.SensorFile
import stillwater.diagnose.Cause
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.DiagnosisSettings
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import stillwater.model.Conditions
import stillwater.run.Experiment
import stillwater.run.FilterKind
import stillwater.run.PlannerKind
import stillwater.run.Preset
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import java.nio.file.Files
import java.nio.file.Path
import kotlin.math.cos
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertNotNull
import kotlin.test.assertTrue

/**
 * Each cause of the list is a model that the simulator runs, a term that the diagnosis finds in what that model shows,
 * and an extended sensor that a benchmark runs, read as `benchmark --sensor` reads it.
 */
class CauseModelsTest {
    @TempDir
    private lateinit var directory: Path

    private val n = 500

    /** A boat on growing loops that cross each other, at a speed that changes, in water warm here and cold there. */
    private fun x(time: Double) = 12 * sin(time / 11) + 6 * sin(time / 37)
    private fun y(time: Double) = 12 * cos(time / 13) + 6 * sin(time / 29)
    private fun temperature(time: Double) = 15 + 5 * sin(time / 43)

    /** The water at ([x], [y]), and what it has risen by after [time] s where it changes by [trend] a second. */
    private fun water(x: Double, y: Double, time: Double, trend: Double) =
        5 + sin(x / 9) + 0.6 * cos(y / 7 + 1) + 0.4 * sin((x + y) / 12) + trend * time

    /** When the boat was [way] m less far than at [time]. */
    private fun earlier(time: Double, way: Double): Double {
        var left = way
        var at = time
        while (left > 0 && at > 0) {
            left -= kotlin.math.hypot(x(at) - x(at - FINE), y(at) - y(at - FINE))
            at -= FINE
        }
        return at
    }

    /** A log of a sensor of [stages] and noise of 0.01, whose probe is [behind] m behind the boat. */
    private fun log(stages: List<SensorStage>, behind: Double = 0.0, trend: Double = 0.0): MeasuredSeries {
        val times = DoubleArray(n) { it.toDouble() }
        fun at(time: Double) = water(x(time), y(time), time, trend)
        val noise = SensorStage.Noise(0.01)
        val rounded = stages.filterIsInstance<SensorStage.Quantum>()
        val sensor = SensorSpec("hidden", stages - rounded.toSet() + noise + rounded).build(at(0.0), Random(11))
        val pace = DoubleArray(n) { kotlin.math.hypot(x(it + 0.5) - x(it - 0.5), y(it + 0.5) - y(it - 0.5)) }
        val conditions = mapOf(
            Conditions.SPEED to pace,
            Conditions.TEMPERATURE to DoubleArray(n) { temperature(times[it]) },
        )
        val values = DoubleArray(n) { i ->
            val now = Conditions(conditions.mapValues { it.value[i] })
            sensor.step(at(earlier(times[i], behind)), 1.0, now)
        }
        return MeasuredSeries(
            times,
            DoubleArray(n) { x(times[it]) },
            DoubleArray(n) { y(times[it]) },
            values,
            DoubleArray(n) { at(times[it]) },
            conditions,
        )
    }

    private val lag = SensorStage.Lag(5.0)
    private val models: Map<Cause, () -> MeasuredSeries> = mapOf(
        Cause.TIME_CONSTANT to { log(listOf(SensorStage.Lag(7.0))) },
        Cause.GAIN_OFFSET to { log(listOf(lag, SensorStage.Calibration(0.9, 0.3))) },
        Cause.ASYMMETRIC_RESPONSE to { log(listOf(SensorStage.Asymmetric(6.0, 4.5))) },
        Cause.SECOND_ORDER_RESPONSE to { log(listOf(lag, SensorStage.Lag(3.0))) },
        Cause.TWO_PATH_RESPONSE to { log(listOf(SensorStage.TwoPath(3.0, 25.0, 0.3))) },
        Cause.DEAD_TIME to { log(listOf(SensorStage.Delay(3.0), lag)) },
        Cause.SLEW_LIMIT to { log(listOf(lag, SensorStage.Slew(0.08))) },
        Cause.FLOW_DEPENDENT_RESPONSE to { log(listOf(SensorStage.FlowLag(5.0, 1.0, 0.5))) },
        Cause.TEMPERATURE_DEPENDENT_RESPONSE to { log(listOf(SensorStage.TemperatureLag(5.0, 15.0, 0.05))) },
        Cause.CROSS_SENSITIVITY to { log(listOf(lag, SensorStage.Cross(Conditions.TEMPERATURE, 15.0, 0.03))) },
        Cause.DRIFT to { log(listOf(lag, SensorStage.Drifting(2e-4))) },
        Cause.OFFSET_STEPS to { log(listOf(lag, SensorStage.Jumps(listOf(120.3, 340.3), listOf(0.3, -0.2)))) },
        Cause.HYSTERESIS to { log(listOf(lag, SensorStage.Backlash(0.2))) },
        Cause.QUANTISATION to { log(listOf(lag, SensorStage.Quantum(0.1))) },
        Cause.SATURATION to { log(listOf(lag, SensorStage.Range(null, 5.9))) },
        Cause.OUTLIERS to { log(listOf(lag, SensorStage.Outlying(0.03, 0.5))) },
        Cause.TIME_VARYING_FIELD to { log(listOf(lag), trend = 3e-3) },
        Cause.POSITION_OFFSET to { log(listOf(lag), behind = 2.0) },
    )

    @Test
    fun everyCauseHasAModel() = assertEquals(Cause.entries.toSet(), models.keys)

    @TestFactory
    fun whatTheSimulatorShowsIsFoundAndTheExtendedSensorRuns(): List<DynamicTest> = models.map { (cause, simulated) ->
        dynamicTest(cause.label) {
            val base = SensorSpec("believed", listOf(lag)).takeIf { cause in GIVEN }
            val result = Diagnosis(simulated(), DiagnosisSettings(base = base)).run()
            val sets = when (val verdict = result.verdict) {
                is Verdict.Named -> verdict.causes.map { listOf(it) }
                is Verdict.Ambiguous -> verdict.sets
                else -> emptyList()
            }
            assertTrue(
                sets.any { cause in it && it.size <= 2 },
                "${result.verdict}",
            )
            val file = directory.resolve("${cause.label}.json")
            Files.writeString(file, assertNotNull(result.extendedSensor).toJson())
            runsInABenchmark(SensorFile.read("$file"))
        }
    }

    /** One environment of what `benchmark --sensor` does. */
    private fun runsInABenchmark(sensor: SensorSpec) {
        val settings = Preset.NOISY.settings()
        val run = settings.copy(
            fields = settings.fields.filterKeys { it == Preset.GAUSSIAN },
            filters = listOf(FilterKind.AVERAGING),
            planners = listOf(PlannerKind.RANDOM_WALK),
            sensor = sensor,
            environments = 1,
            moves = 20,
            checkpoints = listOf(20),
        )
        assertTrue(runBlocking { Experiment(run).run(1) }.curves.single().at(20).mean.isFinite())
    }

    private companion object {
        const val FINE = 0.02
        val GIVEN = setOf(Cause.TIME_CONSTANT, Cause.GAIN_OFFSET)
    }
}
