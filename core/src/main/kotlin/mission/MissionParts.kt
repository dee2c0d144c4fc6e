package stillwater.mission

import kotlinx.serialization.SerialName
import kotlinx.serialization.Serializable
import stillwater.estimate.AveragingFilter
import stillwater.estimate.BayesianMap
import stillwater.estimate.BoundedExtendedFilter
import stillwater.estimate.BoundedFilter
import stillwater.estimate.BoundedFilterSettings
import stillwater.estimate.ExponentialFilter
import stillwater.estimate.FieldEstimator
import stillwater.estimate.IntervalFilter
import stillwater.estimate.IntervalFilterSettings
import stillwater.estimate.ReadingUse
import stillwater.estimate.SelfCalibratingEstimator
import stillwater.estimate.SelfCalibratingSettings
import stillwater.estimate.SensorBelief
import stillwater.field.FieldMap
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.WaterArea
import stillwater.plan.BoundedExtendedPlanner
import stillwater.plan.BoundedPlanner
import stillwater.plan.BoundedPlannerSettings
import stillwater.plan.ClosedCells
import stillwater.plan.DetourWays
import stillwater.plan.InformationPlanner
import stillwater.plan.InformationPlannerSettings
import stillwater.plan.Lawnmower
import stillwater.plan.LawnmowerPattern
import stillwater.plan.Planner
import stillwater.plan.PolygonRrt
import stillwater.plan.PolygonRrtSettings
import stillwater.plan.RandomWalk
import stillwater.plan.SettlingLawnmower
import stillwater.plan.WaterRoutes
import kotlin.random.Random

/** The estimators a mission can name; the names are the command line's. */
@Serializable
public enum class EstimatorName {
    /** The mean of a cell's readings. */
    @SerialName("averaging")
    AVERAGING,

    /** An exponential average of a cell's readings. */
    @SerialName("exponential")
    EXPONENTIAL,

    /** The report's bounded filter: bounds from the direction of the readings. */
    @SerialName("bounded")
    BOUNDED,

    /** Bounds from a limit of the response's slowness. */
    @SerialName("interval")
    INTERVAL,

    /** Learns the time constant on the way. */
    @SerialName("self-calibrating")
    SELF_CALIBRATING,

    /** Bounds from directions and learned distances. */
    @SerialName("bounded-extended")
    BOUNDED_EXTENDED,

    /** A Gaussian process on top of the self-calibrating one: cells unseen have a value too. */
    @SerialName("bayesian")
    BAYESIAN,
    ;

    /** A fresh estimator over [grid] for [probe]. */
    public fun build(grid: Grid, probe: ProbeSpec): FieldEstimator = when (this) {
        AVERAGING -> AveragingFilter(grid, probe.range)
        EXPONENTIAL -> ExponentialFilter(grid, probe.range)
        BOUNDED -> BoundedFilter(
            grid,
            probe.range,
            BoundedFilterSettings(probe.smallestSlope ?: (probe.range.width * ProbeSpec.DEFAULT_SLOPE)),
        )
        INTERVAL -> IntervalFilter(
            grid,
            probe.range,
            IntervalFilterSettings(
                probe.longestTimeConstant,
                probe.readingError ?: (probe.range.width * ProbeSpec.DEFAULT_ERROR),
            ),
        )
        SELF_CALIBRATING -> selfCalibrating(grid, probe)
        BOUNDED_EXTENDED -> BoundedExtendedFilter(grid, probe.range)
        BAYESIAN -> UpToDate(BayesianMap(grid, probe.range, selfCalibrating(grid, probe), BayesianMap.AFLOAT))
    }

    private fun selfCalibrating(grid: Grid, probe: ProbeSpec) =
        SelfCalibratingEstimator(
            grid,
            probe.range,
            SelfCalibratingSettings(probe.longestTimeConstant),
            SelfCalibratingEstimator.AFLOAT,
        )
}

/**
 * A Bayesian map that is worked on once at each reading, however often it is looked at, so that the same readings
 * give the same map when a log is read back.
 */
private class UpToDate(val bayesian: BayesianMap) : FieldEstimator {
    override val map: FieldMap = bayesian.map

    override fun update(
        time: BoatTime,
        x: Double,
        y: Double,
        value: Double,
        conditions: Conditions,
    ): ReadingUse = bayesian.update(time, x, y, value, conditions).also { bayesian.map }
}

/** What [estimator] believes of its sensor; null where it has no model of one. Allocates. */
internal fun sensorBelief(estimator: FieldEstimator): SensorBelief? = when (estimator) {
    is SelfCalibratingEstimator -> estimator.sensor()
    is UpToDate -> sensorBelief(estimator.bayesian.cells)
    else -> null
}

/** Readings near borders that told of the sensor but of no cell; see [SelfCalibratingEstimator.unplaced]. */
internal fun unplacedReadings(estimator: FieldEstimator): Long = when (estimator) {
    is SelfCalibratingEstimator -> estimator.unplaced
    is UpToDate -> unplacedReadings(estimator.bayesian.cells)
    else -> 0
}

/** Longest stay of the settling lawnmower in a cell, over the longest time constant. */
private const val SETTLING = 2.0

/** Of a mission, about. */
private const val STEPS_PER_SECOND = 10.0

/**
 * The planners a mission can name; the names are the command line's.
 *
 * @property keepsToWater whether its ways keep to the water whatever its shape, rather than go from cell to cell.
 */
@Serializable
public enum class PlannerName(public val keepsToWater: Boolean = false) {
    /** To a random neighbour. */
    @SerialName("random-walk")
    RANDOM_WALK,

    /** In a fixed order. */
    @SerialName("lawnmower")
    LAWNMOWER,

    /** The report's bounded planner. */
    @SerialName("bounded")
    BOUNDED,

    /** The bounded planner that does not stall. */
    @SerialName("bounded-extended")
    BOUNDED_EXTENDED,

    /** To where the map's uncertainty falls most per second. */
    @SerialName("information")
    INFORMATION,

    /** In a fixed order, staying in each cell until its bounds close, for two longest time constants at most. */
    @SerialName("settling-lawnmower")
    SETTLING_LAWNMOWER,

    /** A tree of paths in the plane that keeps to the water. */
    @SerialName("polygon-rrt")
    POLYGON_RRT(keepsToWater = true),
    ;

    /** A fresh planner that draws from [random], for [spec]'s boat on [water]. */
    public fun build(spec: MissionSpec, water: WaterArea, random: Random): Planner = when (this) {
        RANDOM_WALK -> RandomWalk(random)
        LAWNMOWER -> Lawnmower(LawnmowerPattern.HAMILTONIAN_CYCLE)
        BOUNDED -> BoundedPlanner(random, BoundedPlannerSettings(maxChange = spec.probe.range.width / 2))
        BOUNDED_EXTENDED -> BoundedExtendedPlanner(random)
        INFORMATION -> InformationPlanner(
            random,
            InformationPlannerSettings(speed = spec.boat.cruise, settling = spec.probe.longestTimeConstant / 2),
        )
        // Afloat it is asked at every step for as long as it stays, about ten times a second.
        SETTLING_LAWNMOWER -> SettlingLawnmower(
            mostStays = (SETTLING * spec.probe.longestTimeConstant * STEPS_PER_SECOND).toInt().coerceAtLeast(1),
        )
        POLYGON_RRT -> PolygonRrt(
            random,
            water,
            PolygonRrtSettings(
                margin = spec.boat.arrival,
                resolution = WaterRoutes.resolution(water, spec.grid.cell / 2),
            ),
        )
    }
}

/** Whether nothing is in the way of any straight line over a mission's water. */
internal val AreaSpec.isOpen: Boolean get() = shore == null && keepOuts.isEmpty()

/** What ways keep from land on the mission's water, m. */
internal val BoatSpec.wayMargin: Double get() = arrival / 2

/** Where no land is in the way, points beyond which ways round closed cells become coarser: one look at all is a step's. */
private const val OPEN_POINTS = 20_000

/** The ways over [water] that [spec]'s boat may take, round [closed] cells. */
internal fun ways(spec: MissionSpec, water: WaterArea, closed: ClosedCells) = DetourWays(
    water,
    spec.boat.wayMargin,
    WaterRoutes.resolution(water, spec.grid.cell / 2, if (spec.area.isOpen) OPEN_POINTS else WaterRoutes.MAX_POINTS),
    spec.area.isOpen,
    closed,
    spec.home.position,
)

/** Readings that the map has: those taken since the mission began, or was taken up again, and those of before. */
public val Mission.readingsTaken: Long get() = readingsBefore + readings.passed
