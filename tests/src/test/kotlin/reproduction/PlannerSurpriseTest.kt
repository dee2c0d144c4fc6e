package stillwater.reproduction

import kotlinx.coroutines.runBlocking
import stillwater.plan.Execution
import stillwater.plan.PathChoice
import stillwater.run.Curve
import stillwater.run.Experiment
import stillwater.run.ExperimentSettings
import stillwater.run.FilterKind
import stillwater.run.PlannerKind
import stillwater.run.Preset
import kotlin.math.hypot
import kotlin.test.Test
import kotlin.test.assertTrue

/** What docs/the-planner-surprise.md says, on fewer environments and another seed than its tables. */
class PlannerSurpriseTest {
    @Test
    fun inTheOriginalSettingsTheLastPolledPathLosesToTheWalkAndTheBestOneWins() {
        val original = Preset.ORIGINAL.settings()
        val walk = run(original, PlannerKind.RANDOM_WALK, PathChoice.LAST_POLLED)
        val lastPolled = run(original, PlannerKind.BOUNDED, PathChoice.LAST_POLLED)
        val best = run(original, PlannerKind.BOUNDED, PathChoice.BEST)
        assertClearlyBelow(walk, lastPolled)
        assertClearlyBelow(best, walk)
    }

    @Test
    fun planningAgainInEveryCellStallsWhereWholePathsDoNot() {
        val report = Preset.REPORT.settings().copy(moves = 500, checkpoints = listOf(500))
        val whole = run(report, PlannerKind.BOUNDED, PathChoice.BEST, Execution.WHOLE_PATH)
        val single = run(report, PlannerKind.BOUNDED, PathChoice.BEST, Execution.SINGLE_STEP)
        assertClearlyBelow(whole, single)
    }

    private fun run(
        base: ExperimentSettings,
        planner: PlannerKind,
        choice: PathChoice,
        execution: Execution = base.plannerSettings.bounded.execution,
    ): Curve {
        val settings = base.copy(
            fields = base.fields.filterKeys { it == Preset.UNIFORM },
            filters = listOf(FilterKind.BOUNDED),
            planners = listOf(planner),
            plannerSettings = base.plannerSettings.copy(
                bounded = base.plannerSettings.bounded.copy(choice = choice, execution = execution),
            ),
            environments = 20,
            checkpoints = listOf(base.moves),
            seed = 20_261_120L,
        )
        return runBlocking { Experiment(settings).run(threads = 2) }.curves.single()
    }

    /** By 3 standard errors of the difference at the last move. */
    private fun assertClearlyBelow(low: Curve, high: Curve) {
        val a = low.summaries.last()
        val b = high.summaries.last()
        assertTrue(b.mean - a.mean > 3 * hypot(a.standardError, b.standardError), "$a against $b")
    }
}
