package stillwater.reproduction

import org.junit.jupiter.api.TestInstance
import stillwater.estimate.BayesianMap
import stillwater.estimate.SelfCalibratingEstimator
import stillwater.estimate.SelfCalibratingSettings
import stillwater.run.PlannerKind
import stillwater.run.Preset
import stillwater.run.Trial
import stillwater.sensor.SensorStage
import stillwater.world.Seeds
import kotlin.test.Test
import kotlin.test.assertTrue

/**
 * What a map of the whole field is worth through a slow, noisy sensor whose time constant nobody told: issue 3's bars, on
 * other seeds than those it was worked out on.
 */
@TestInstance(TestInstance.Lifecycle.PER_CLASS)
class BayesianMapTest {
    private val settings = Preset.NOISY.settings()
    private val seeds = Seeds(SEED)
    private val timeConstant = settings.sensor.stages.filterIsInstance<SensorStage.Lag>().single().timeConstant

    /** Mean error over environments, and the part of all cells, seen or not, whose truth lies within the bounds. */
    private data class Outcome(val error: Double, val covered: Double)

    private fun run(
        kind: String,
        planner: PlannerKind,
        moves: Int,
        environments: Int = 50,
        lag: SelfCalibratingSettings = SelfCalibratingSettings(),
    ): Outcome {
        var error = 0.0
        var covered = 0
        for (environment in 0 until environments) {
            val field = settings.fields.getValue(kind).draw(settings.grid, seeds.random("field $kind", environment))
            val start = if (planner.startsAtFirstCell) {
                0
            } else {
                seeds.random(
                    "start",
                    environment,
                ).nextInt(field.grid.size)
            }
            val cells = SelfCalibratingEstimator(settings.grid, settings.prior, lag)
            val estimator = BayesianMap(settings.grid, settings.prior, cells)
            error += Trial(
                field,
                settings.sensor.build(field.truth(start), seeds.random("noise", environment)),
                planner.planner(seeds.random("planner", environment), settings.plannerSettings),
                listOf(estimator),
                settings.samplesPerMove,
                settings.period,
                usesMap = planner.usesMap,
            ).run(start, intArrayOf(moves)).single().mean.single()
            val map = estimator.map
            covered += (0 until map.grid.size).count { field.truth(it) in map.lower(it)..map.upper(it) }
        }
        return Outcome(error / environments, covered / (environments.toDouble() * settings.grid.size))
    }

    private val gaussian50 by lazy { run(Preset.GAUSSIAN, PlannerKind.INFORMATION, moves = 50) }
    private val gaussian100 by lazy { run(Preset.GAUSSIAN, PlannerKind.INFORMATION, moves = 100) }
    private val mown100 by lazy { run(Preset.GAUSSIAN, PlannerKind.LAWNMOWER, moves = 100) }
    private val uniform50 by lazy { run(Preset.UNIFORM, PlannerKind.INFORMATION, moves = 50) }
    private val uniform100 by lazy { run(Preset.UNIFORM, PlannerKind.LAWNMOWER, moves = 100) }
    private val uniform2000 by lazy { run(Preset.UNIFORM, PlannerKind.LAWNMOWER, moves = 2000, environments = 20) }
    private val gaussian2000 by lazy { run(Preset.GAUSSIAN, PlannerKind.LAWNMOWER, moves = 2000, environments = 20) }

    @Test
    fun halfOfTheCellsTellOfASmoothField() {
        // Issue 3's bar is 0.022. A cell-by-cell estimator has 0.125 at best: half of the cells are unseen.
        assertTrue(gaussian50.error <= 0.022, "$gaussian50")
    }

    @Test
    fun readsEitherFieldInOneRound() {
        assertTrue(gaussian100.error <= 0.0022, "$gaussian100")
        assertTrue(mown100.error <= 0.0022, "$mown100")
        assertTrue(uniform100.error <= 0.0030, "$uniform100")
    }

    @Test
    fun comesWithinThreeTimesASensorWithoutLag() {
        // That one's mean over readings of one cell has the error σ √(2/π) / √(readings): docs/results.md has 0.00014.
        assertTrue(uniform2000.error <= 3 * WITHOUT_LAG, "$uniform2000")
        assertTrue(gaussian2000.error <= 3 * WITHOUT_LAG, "$gaussian2000")
    }

    @Test
    fun intervalsAreHonestInCellsSeenAndUnseen() {
        for (outcome in listOf(gaussian50, gaussian100, mown100, uniform50, uniform100, uniform2000, gaussian2000)) {
            assertTrue(outcome.covered in 0.93..0.97, "$outcome")
        }
    }

    @Test
    fun aPriorWrongByThreeTimesLosesLessThanATenth() {
        val short = SelfCalibratingSettings(timeConstant / 3, factor = 3.0)
        val long = SelfCalibratingSettings(timeConstant * 3, factor = 3.0)
        for (kind in listOf(Preset.GAUSSIAN, Preset.UNIFORM)) {
            val (right, wrongShort, wrongLong) = listOf(SelfCalibratingSettings(), short, long).map {
                run(kind, PlannerKind.LAWNMOWER, moves = 100, environments = 25, lag = it)
            }
            assertTrue(wrongShort.error <= 1.1 * right.error, "$wrongShort, $right")
            assertTrue(wrongLong.error <= 1.1 * right.error, "$wrongLong, $right")
        }
    }

    private companion object {
        /** Fixed before anything was run on it. */
        const val SEED = 20_261_124L

        /** Mean error of a sensor without lag after 2000 moves, either field. */
        const val WITHOUT_LAG = 0.00014
    }
}
