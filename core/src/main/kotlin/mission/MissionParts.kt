package stillwater.mission

import kotlinx.serialization.SerialName
import kotlinx.serialization.Serializable
import stillwater.estimate.AveragingFilter
import stillwater.estimate.BoundedExtendedFilter
import stillwater.estimate.FieldEstimator
import stillwater.estimate.IntervalFilter
import stillwater.estimate.IntervalFilterSettings
import stillwater.estimate.SelfCalibratingEstimator
import stillwater.estimate.SelfCalibratingSettings
import stillwater.model.Grid
import stillwater.model.WaterArea
import stillwater.plan.BoundedExtendedPlanner
import stillwater.plan.BoundedPlanner
import stillwater.plan.BoundedPlannerSettings
import stillwater.plan.Lawnmower
import stillwater.plan.LawnmowerPattern
import stillwater.plan.Planner
import stillwater.plan.PolygonRrt
import stillwater.plan.PolygonRrtSettings
import stillwater.plan.RandomWalk
import stillwater.plan.StraightHome
import stillwater.plan.WaterHome
import stillwater.plan.WaterRoutes
import stillwater.plan.WayHome
import kotlin.random.Random

/** The estimators a mission can name. */
@Serializable
public enum class EstimatorName {
    /** The mean of a cell's readings. */
    @SerialName("averaging")
    AVERAGING,

    /** Bounds from a limit of the response's slowness. */
    @SerialName("interval")
    INTERVAL,

    /** Learns the time constant on the way. */
    @SerialName("self-calibrating")
    SELF_CALIBRATING,

    /** Bounds from directions and learned distances. */
    @SerialName("bounded-extended")
    BOUNDED_EXTENDED,
    ;

    /** A fresh estimator over [grid] for [probe]. */
    public fun build(grid: Grid, probe: ProbeSpec): FieldEstimator = when (this) {
        AVERAGING -> AveragingFilter(grid, probe.range)
        INTERVAL -> IntervalFilter(grid, probe.range, IntervalFilterSettings(probe.longestTimeConstant))
        SELF_CALIBRATING ->
            SelfCalibratingEstimator(grid, probe.range, SelfCalibratingSettings(probe.longestTimeConstant))
        BOUNDED_EXTENDED -> BoundedExtendedFilter(grid, probe.range)
    }
}

/**
 * The planners a mission can name.
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
        POLYGON_RRT -> PolygonRrt(random, water, PolygonRrtSettings(margin = spec.boat.arrival))
    }
}

/** The way home over [water]: straight in a rectangle, else round what is in the way. */
internal fun wayHome(spec: MissionSpec, water: WaterArea): WayHome {
    val home = spec.home.position
    if (spec.area.shore == null && spec.area.keepOuts.isEmpty()) return StraightHome(home)
    return WaterHome(WaterRoutes(water, spec.boat.arrival / 2, spec.grid.cell / 2), home)
}
