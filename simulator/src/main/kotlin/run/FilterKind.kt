package stillwater.run

import stillwater.estimate.AveragingFilter
import stillwater.estimate.BayesianMap
import stillwater.estimate.BoundedExtendedFilter
import stillwater.estimate.BoundedExtendedSettings
import stillwater.estimate.BoundedFilter
import stillwater.estimate.BoundedFilterSettings
import stillwater.estimate.ExponentialFilter
import stillwater.estimate.FieldEstimator
import stillwater.estimate.IntervalFilter
import stillwater.estimate.MapFusion
import stillwater.estimate.SelfCalibratingEstimator
import stillwater.model.Grid
import stillwater.model.Interval

/**
 * The filters that can make a map out of readings, simulated or logged.
 *
 * @property label name on the command line and in files.
 * @property givesBounds whether its map has bounds that a planner can plan on.
 * @property valueIsMidpoint whether its value is no more than the midpoint of its bounds.
 * @property seesUnvisited whether it says something of cells the boat never entered.
 */
enum class FilterKind(
    val label: String,
    val givesBounds: Boolean,
    val valueIsMidpoint: Boolean = false,
    val seesUnvisited: Boolean = false,
) {
    /** The mean of a cell's readings. */
    AVERAGING("averaging", givesBounds = false),

    /** An exponential average of a cell's readings. */
    EXPONENTIAL("exponential", givesBounds = false),

    /** The report's bounded filter. */
    BOUNDED("bounded", givesBounds = true, valueIsMidpoint = true),

    /** Bounds from a limit of the response's slowness. */
    INTERVAL("interval", givesBounds = true, valueIsMidpoint = true),

    /** Learns the time constant on the way; its bounds are credible at 95 %. */
    SELF_CALIBRATING("self-calibrating", givesBounds = true),

    /** The bounded filter grown up: noise and distances per slope learned from the readings. */
    BOUNDED_EXTENDED("bounded-extended", givesBounds = true),

    /** A Gaussian process over the cells on top of the one before: unseen cells too have a value and bounds. */
    BAYESIAN("bayesian", givesBounds = true, seesUnvisited = true),
    ;

    /** Whether its bounds hold the truth with a probability of 95 %, and not for certain. */
    val areBoundsCredible: Boolean get() = givesBounds && !valueIsMidpoint

    /** Whether it reckons with a lag of the sensor, which readings must still have. */
    val undoesLag: Boolean get() = givesBounds

    /** Whether its bounds hold only where the water of a cell is the same all over; the others look for that themselves. */
    val needsEvenCells: Boolean get() = valueIsMidpoint || this == BOUNDED_EXTENDED

    /** How the maps of several boats become one: by what this filter's bounds mean. */
    val fusion: MapFusion
        get() = when {
            !givesBounds -> MapFusion.MEAN_OF_READINGS
            valueIsMidpoint -> MapFusion.INTERSECTION
            else -> MapFusion.INVERSE_VARIANCE
        }

    /** A filter of this kind over [grid]; [settings] count for the bounded one, [lag] for those after it. */
    fun estimator(
        grid: Grid,
        prior: Interval,
        settings: BoundedFilterSettings,
        lag: LagFilterSettings = LagFilterSettings(),
    ): FieldEstimator = when (this) {
        AVERAGING -> AveragingFilter(grid, prior)
        EXPONENTIAL -> ExponentialFilter(grid, prior)
        BOUNDED -> BoundedFilter(grid, prior, settings)
        INTERVAL -> IntervalFilter(grid, prior, lag.interval)
        SELF_CALIBRATING -> SelfCalibratingEstimator(grid, prior, lag.selfCalibrating)
        BOUNDED_EXTENDED -> BoundedExtendedFilter(
            grid,
            prior,
            BoundedExtendedSettings(settings.medianWindow, settings.slopeWindow, lag.learnsResponse),
        )
        BAYESIAN -> BayesianMap(grid, prior, SelfCalibratingEstimator(grid, prior, lag.selfCalibrating))
    }
}
