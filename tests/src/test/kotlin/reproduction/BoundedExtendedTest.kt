package stillwater.reproduction

import kotlinx.coroutines.runBlocking
import org.junit.jupiter.api.DynamicTest
import org.junit.jupiter.api.DynamicTest.dynamicTest
import org.junit.jupiter.api.TestFactory
import org.junit.jupiter.api.TestInstance
import stillwater.run.Checkpoints
import stillwater.run.Experiment
import stillwater.run.FilterKind
import stillwater.run.PlannerKind
import stillwater.run.Preset
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.test.Test
import kotlin.test.assertTrue

/**
 * The bars of the extended bounded filter and planner, without any sensor model, and what their bounds are worth with
 * sensors of several kinds: on a seed that they were not worked out on.
 */
@TestInstance(TestInstance.Lifecycle.PER_CLASS)
class BoundedExtendedTest {
    private val noisy = Preset.NOISY.settings().copy(environments = 20, seed = SEED)
    private val fields = listOf(Preset.UNIFORM, Preset.GAUSSIAN)
    private val extended = FilterKind.BOUNDED_EXTENDED
    private val extendedPlanner = PlannerKind.BOUNDED_EXTENDED

    private val result by lazy {
        val all = noisy.copy(
            filters = listOf(FilterKind.BOUNDED, FilterKind.AVERAGING, extended),
            planners = noisy.planners + extendedPlanner,
            checkpoints = Checkpoints.upTo(2000),
        )
        runBlocking { Experiment(all).run(threads = 2) }
    }

    private fun error(field: String, planner: PlannerKind, filter: FilterKind, move: Int) =
        checkNotNull(result.curve(field, planner, filter)).at(move).mean

    @Test
    fun isFarBelowTheBestOfTheReportsSix() {
        for (field in fields) {
            for (move in listOf(200, 500, 1000, 2000)) {
                val six = noisy.planners.flatMap { planner ->
                    listOf(FilterKind.BOUNDED, FilterKind.AVERAGING).map { error(field, planner, it, move) }
                }
                // The bars are 1.5 (uniform) and 3 (Gaussian); 17 to 38 were found.
                val own = error(field, extendedPlanner, extended, move)
                assertTrue(6 * own <= six.min(), "$field, $move: $own of $six")
            }
        }
    }

    @Test
    fun thePlannerIsNeverAboveTheRandomWalk() {
        for (field in fields) {
            val planner = checkNotNull(result.curve(field, extendedPlanner, extended))
            val walk = checkNotNull(result.curve(field, PlannerKind.RANDOM_WALK, extended))
            for (move in planner.checkpoints) {
                val excess = planner.excessOver(walk, move)
                // At moves 1 and 2 both know one and two cells: they differ by the noise of some readings.
                assertTrue(!excess.clearlyPositive || excess.mean < 1e-4, "$field, $move: $excess")
                if (move >= 20) assertTrue(excess.mean < 0, "$field, $move: $excess")
            }
        }
    }

    @Test
    fun theReportsPlannerIsBetterWithTheExtendedFilterToo() {
        for (field in fields) {
            for (move in listOf(200, 500, 1000, 2000)) {
                val plain = error(field, PlannerKind.BOUNDED, FilterKind.BOUNDED, move)
                assertTrue(3 * error(field, PlannerKind.BOUNDED, extended, move) < plain, "$field, $move")
            }
        }
    }

    private class Sensor(val name: String, val stages: List<SensorStage>, val least: Double)

    private val noise = listOf(SensorStage.Noise(0.002), SensorStage.Quantum(0.005))
    private val lag = noisy.sensor.stages.filterIsInstance<SensorStage.Lag>().single()

    @TestFactory
    fun boundsHoldTheTruthAsOftenAsTheyShould(): List<DynamicTest> = listOf(
        // Credible at 95 %; 0.02 is four standard errors of 20 environments, 0.94 to 0.98 were found.
        Sensor("first order", listOf(lag) + noise, least = 0.93),
        Sensor(
            "asymmetric",
            listOf(SensorStage.Asymmetric(1.3 * lag.timeConstant, 0.7 * lag.timeConstant)) + noise,
            0.93,
        ),
        Sensor("dead time", listOf(SensorStage.Delay(2.0), lag) + noise, 0.92),
        Sensor("outliers", listOf(lag, SensorStage.Noise(0.002), SensorStage.Outlying(0.01, 0.3)) + noise.last(), 0.93),
        // Not what they should: a second-order sensor misleads them, core/docs/BoundedExtendedFilter.md.
        Sensor("second order", listOf(lag, lag).map { SensorStage.Lag(it.timeConstant / 2) } + noise, 0.60),
    ).map { sensor -> dynamicTest(sensor.name) { assertCovered(sensor) } }

    private fun assertCovered(sensor: Sensor) {
        val settings = noisy.copy(
            sensor = SensorSpec(sensor.name, sensor.stages),
            filters = listOf(extended),
            planners = listOf(extendedPlanner),
            moves = 500,
            checkpoints = listOf(200, 500),
        )
        for (curve in runBlocking { Experiment(settings).run(threads = 2) }.curves) {
            for (summary in curve.summaries) {
                val coverage = checkNotNull(summary.bounds).coverage
                assertTrue(coverage >= sensor.least, "${sensor.name}, ${curve.field}: $coverage")
            }
        }
    }

    @Test
    fun directionsAloneAreSoundWithNoise() {
        val settings = noisy.copy(
            lagFilters = noisy.lagFilters.copy(learnsResponse = false),
            filters = listOf(extended),
            planners = listOf(extendedPlanner, PlannerKind.RANDOM_WALK),
            checkpoints = listOf(500, 2000),
        )
        for (curve in runBlocking { Experiment(settings).run(threads = 2) }.curves) {
            for (summary in curve.summaries) {
                // Credible at 95 % by a union bound; the plain filter's fall to 0.97 here.
                assertTrue(checkNotNull(summary.bounds).coverage >= 0.995, "${curve.field} ${curve.planner} $summary")
            }
        }
    }

    private companion object {
        /** Fixed before anything was run on it. */
        const val SEED = 20_261_208L
    }
}
