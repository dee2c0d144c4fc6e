package stillwater.run

import stillwater.estimate.BoundedFilterSettings
import stillwater.estimate.IntervalFilterSettings
import stillwater.plan.BoundedPlannerSettings
import stillwater.plan.LawnmowerPattern
import stillwater.plan.Neighbours
import stillwater.plan.PathChoice
import stillwater.plan.Priority
import stillwater.plan.WalkSteps
import stillwater.sensor.FirstOrderLag
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import stillwater.world.GaussianMixtureField
import stillwater.world.OriginalGaussianField
import stillwater.world.UniformField

/**
 * Ready-made comparisons.
 *
 * @property label name on the command line.
 * @property describes one sentence for help and reports.
 */
enum class Preset(val label: String, val describes: String) {
    /** The report's Figures 6 and 7. */
    REPORT("report", "the report's Figures 6 and 7: first-order lag of 0.1 a sample, no noise"),

    /** The same with noise and resolution. */
    NOISY("noisy", "the same sensor with noise of 0.002 and a resolution of 0.005"),

    /** The original experiment's settings. */
    ORIGINAL("original", "the original code: slew-limited sensor, 500 moves, diagonal walk, jumping raster"),
    ;

    /** The comparison itself. */
    fun settings(): ExperimentSettings = when (this) {
        REPORT -> report(SensorSpec("first-order-lag", listOf(LAG)), epsilon = 5e-4, readingError = 0.0)
        // Half a quantum, and four standard deviations of the noise: one reading in 16 000 is farther off.
        NOISY -> report(SensorSpec("noisy-lag", listOf(LAG, NOISE, QUANTUM)), epsilon = 2e-3, readingError = 0.0105)
        ORIGINAL -> original()
    }

    private fun report(sensor: SensorSpec, epsilon: Double, readingError: Double) = ExperimentSettings(
        fields = mapOf(UNIFORM to UniformField, GAUSSIAN to GaussianMixtureField),
        filters = listOf(FilterKind.BOUNDED, FilterKind.AVERAGING),
        planners = PlannerKind.OF_THE_REPORT,
        sensor = sensor,
        boundedFilter = BoundedFilterSettings(epsilon),
        // Three times the sensor's time constant, about.
        lagFilters = LagFilterSettings(IntervalFilterSettings(longestTimeConstant = 30.0, readingError)),
    )

    /** The gradient is the sensor's last change, whatever cell it comes from; the average is exponential. */
    private fun original() = ExperimentSettings(
        fields = mapOf(UNIFORM to UniformField, GAUSSIAN to OriginalGaussianField),
        filters = listOf(FilterKind.BOUNDED, FilterKind.EXPONENTIAL),
        planners = PlannerKind.OF_THE_REPORT,
        sensor = SensorSpec("slew-limit", listOf(SensorStage.Slew(rate = 0.01))),
        boundedFilter = BoundedFilterSettings(epsilon = 0.0, medianWindow = 1, slopeWindow = 2, clearOnEntry = false),
        // 0.01 a second and at most 1 to go: never slower than a lag of 100 s.
        lagFilters = LagFilterSettings(IntervalFilterSettings(longestTimeConstant = 100.0)),
        plannerSettings = PlannerSettings(
            walk = WalkSteps.DIAGONAL_CLAMPED,
            pattern = LawnmowerPattern.RASTER,
            bounded = BoundedPlannerSettings(
                // The original's horizon of 6 counts the start: its longest path has 5 moves.
                horizon = 5,
                expansions = 10_000,
                maxChange = 0.1,
                discountVisits = false,
                choice = PathChoice.LAST_POLLED,
                neighbours = Neighbours.EDGE_OR_CORNER,
                priority = Priority.VALUE,
            ),
        ),
        moves = 500,
    )

    companion object {
        /** Name of the field whose cells are independent. */
        const val UNIFORM = "uniform"

        /** Name of the field that is a mixture of Gaussians. */
        const val GAUSSIAN = "gaussian"

        private val LAG = SensorStage.Lag(FirstOrderLag.timeConstant(alpha = 0.1, period = 1.0))
        private val NOISE = SensorStage.Noise(standardDeviation = 0.002)
        private val QUANTUM = SensorStage.Quantum(step = 0.005)
    }
}
