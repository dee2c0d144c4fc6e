package stillwater.run

import stillwater.estimate.BoundedFilterSettings
import stillwater.estimate.CrossingPolicy
import stillwater.model.Conditions
import stillwater.model.Interval
import stillwater.plan.BoundedPlannerSettings
import stillwater.plan.Execution
import stillwater.plan.LawnmowerPattern
import stillwater.plan.Neighbours
import stillwater.plan.PathChoice
import stillwater.plan.Priority
import stillwater.plan.WalkSteps
import stillwater.sensor.SensorStage
import stillwater.world.GaussianMixtureField
import stillwater.world.OriginalGaussianField
import stillwater.world.UniformField
import kotlin.math.exp
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals

/** The readings I1 to I10 of the report, and the settings of its authors' own code, as numbers. */
class PresetTest {
    private val report = Preset.REPORT.settings()
    private val original = Preset.ORIGINAL.settings()

    @Test
    fun theReportsSensorClosesATenthOfItsDistanceWithEachReading() {
        val sensor = report.sensor.build(0.0, Random(1))
        val first = sensor.step(1.0, report.period, Conditions.NONE)
        // Rounding of one exponential and one logarithm.
        assertEquals(0.1, first, 1e-16 * 4)
        val stage = report.sensor.stages.single() as SensorStage.Lag
        assertEquals(0.9, exp(-1 / stage.timeConstant), 1e-15, "1 - alpha, to the rounding of two functions")
    }

    @Test
    fun theReportsComparisonIsAsRead() {
        assertEquals(mapOf("uniform" to UniformField, "gaussian" to GaussianMixtureField), report.fields)
        assertEquals(setOf(FilterKind.BOUNDED, FilterKind.AVERAGING), report.filters.toSet())
        assertEquals(PlannerKind.OF_THE_REPORT, report.planners)
        assertEquals(listOf(10, 10), listOf(report.grid.columns, report.grid.rows))
        assertEquals(Interval(0.0, 1.0), report.prior)
        assertEquals(listOf(100, 2000, 10), listOf(report.environments, report.moves, report.samplesPerMove))
        assertEquals(Checkpoints.upTo(2000), report.checkpoints)
    }

    @Test
    fun theReportsFilterAndPlannerAreAsRead() {
        assertEquals(
            BoundedFilterSettings(
                epsilon = 5e-4,
                medianWindow = 3,
                slopeWindow = 5,
                clearOnEntry = true,
                crossing = CrossingPolicy.PLAIN,
            ),
            report.boundedFilter,
        )
        val planner = BoundedPlannerSettings(
            horizon = 10,
            expansions = 200,
            maxChange = 0.5,
            discountVisits = true,
            execution = Execution.WHOLE_PATH,
            choice = PathChoice.BEST,
            neighbours = Neighbours.EDGE,
            priority = Priority.VALUE_PER_MOVE,
        )
        assertEquals(
            PlannerSettings(WalkSteps.EDGE, LawnmowerPattern.HAMILTONIAN_CYCLE, planner),
            report.plannerSettings,
        )
    }

    @Test
    fun noisyDiffersInNoiseResolutionAndWhatFollowsFromThem() {
        val noisy = Preset.NOISY.settings()
        assertEquals(
            report.sensor.stages + SensorStage.Noise(0.002) + SensorStage.Quantum(0.005),
            noisy.sensor.stages,
        )
        assertEquals(2e-3, noisy.boundedFilter.epsilon)
        assertEquals(0.0105, noisy.lagFilters.interval.readingError)
        val same = noisy.copy(
            sensor = report.sensor,
            boundedFilter = noisy.boundedFilter.copy(epsilon = 5e-4),
            lagFilters = report.lagFilters,
        )
        assertEquals(report, same)
    }

    @Test
    fun theOriginalsSensorFilterAndFieldsAreThoseOfItsCode() {
        assertEquals(mapOf("uniform" to UniformField, "gaussian" to OriginalGaussianField), original.fields)
        assertEquals(listOf(SensorStage.Slew(0.01)), original.sensor.stages)
        assertEquals(setOf(FilterKind.BOUNDED, FilterKind.EXPONENTIAL), original.filters.toSet())
        assertEquals(
            BoundedFilterSettings(epsilon = 0.0, medianWindow = 1, slopeWindow = 2, clearOnEntry = false),
            original.boundedFilter,
        )
        assertEquals(listOf(500, 10, 100), listOf(original.moves, original.samplesPerMove, original.environments))
    }

    @Test
    fun theOriginalsPlannersAreThoseOfItsCode() {
        val planner = BoundedPlannerSettings(
            horizon = 5,
            expansions = 10_000,
            maxChange = 0.1,
            discountVisits = false,
            execution = Execution.WHOLE_PATH,
            choice = PathChoice.LAST_POLLED,
            neighbours = Neighbours.EDGE_OR_CORNER,
            priority = Priority.VALUE,
        )
        assertEquals(
            PlannerSettings(WalkSteps.DIAGONAL_CLAMPED, LawnmowerPattern.RASTER, planner),
            original.plannerSettings,
        )
    }

    @Test
    fun namesAreThoseOfTheCommandLine() {
        assertEquals(listOf("report", "noisy", "original"), Preset.entries.map { it.label })
        assertEquals(
            listOf(
                "averaging",
                "exponential",
                "bounded",
                "interval",
                "self-calibrating",
                "bounded-extended",
                "bayesian",
            ),
            FilterKind.entries.map { it.label },
        )
        assertEquals(
            listOf(
                "random-walk",
                "lawnmower",
                "bounded",
                "polygon-rrt",
                "bounded-extended",
                "information",
                "settling-lawnmower",
            ),
            PlannerKind.entries.map { it.label },
        )
    }
}
