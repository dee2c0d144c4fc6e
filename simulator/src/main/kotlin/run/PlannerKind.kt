package stillwater.run

import stillwater.model.WaterArea
import stillwater.plan.BoundedExtendedPlanner
import stillwater.plan.BoundedExtendedPlannerSettings
import stillwater.plan.BoundedPlanner
import stillwater.plan.BoundedPlannerSettings
import stillwater.plan.InformationPlanner
import stillwater.plan.InformationPlannerSettings
import stillwater.plan.Lawnmower
import stillwater.plan.LawnmowerPattern
import stillwater.plan.Planner
import stillwater.plan.PolygonRrt
import stillwater.plan.PolygonRrtSettings
import stillwater.plan.RandomWalk
import stillwater.plan.SettlingLawnmower
import stillwater.plan.WalkSteps
import kotlin.random.Random

/**
 * Settings of the planners under comparison.
 *
 * @property walk steps of the random walk.
 * @property pattern order of the lawnmower.
 * @property bounded horizon, expansions and choices of the bounded planner.
 * @property polygonRrt iterations, lengths and margin of the planner in the plane.
 * @property boundedExtended horizon and expansions of the extended bounded planner.
 * @property information horizon and times of the information planner.
 */
data class PlannerSettings(
    val walk: WalkSteps = WalkSteps.EDGE,
    val pattern: LawnmowerPattern = LawnmowerPattern.HAMILTONIAN_CYCLE,
    val bounded: BoundedPlannerSettings = BoundedPlannerSettings(),
    val polygonRrt: PolygonRrtSettings = PolygonRrtSettings(),
    val boundedExtended: BoundedExtendedPlannerSettings = BoundedExtendedPlannerSettings(),
    val information: InformationPlannerSettings = InformationPlannerSettings(),
)

/**
 * The ways to choose where to go.
 *
 * @property label name on the command line and in files.
 * @property usesMap whether what it plans depends on the map, so that each filter with bounds has a path of its own.
 * @property startsAtFirstCell whether it starts in cell 0 instead of a random one.
 * @property inPlane whether its waypoints lie anywhere on the water instead of in cells' centres.
 */
enum class PlannerKind(
    val label: String,
    val usesMap: Boolean,
    val startsAtFirstCell: Boolean,
    val inPlane: Boolean = false,
) {
    /** To a random neighbour. */
    RANDOM_WALK("random-walk", usesMap = false, startsAtFirstCell = false),

    /** In a fixed order. */
    LAWNMOWER("lawnmower", usesMap = false, startsAtFirstCell = true),

    /** The report's bounded planner. */
    BOUNDED("bounded", usesMap = true, startsAtFirstCell = false),

    /** A tree of paths in the plane that keeps to the water. */
    POLYGON_RRT("polygon-rrt", usesMap = true, startsAtFirstCell = false, inPlane = true),

    /** The bounded planner that remembers where it learned nothing. */
    BOUNDED_EXTENDED("bounded-extended", usesMap = true, startsAtFirstCell = false),

    /** To where the map's uncertainty falls most per second. */
    INFORMATION("information", usesMap = true, startsAtFirstCell = false),

    /** In a fixed order, staying in each cell until its bounds have closed. */
    SETTLING_LAWNMOWER("settling-lawnmower", usesMap = true, startsAtFirstCell = true),
    ;

    /**
     * A fresh planner of this kind that draws from [random] and is asked [asked] times a move at most; [area] is the
     * water, null where all of the map is.
     */
    fun planner(
        random: Random,
        settings: PlannerSettings,
        area: WaterArea? = null,
        asked: Int = 1,
    ): Planner = when (this) {
        RANDOM_WALK -> RandomWalk(random, settings.walk)
        LAWNMOWER -> Lawnmower(settings.pattern)
        BOUNDED -> BoundedPlanner(random, settings.bounded)
        POLYGON_RRT -> PolygonRrt(random, area, settings.polygonRrt)
        BOUNDED_EXTENDED -> BoundedExtendedPlanner(random, settings.boundedExtended)
        INFORMATION -> InformationPlanner(random, settings.information)
        SETTLING_LAWNMOWER -> SettlingLawnmower(settings.pattern, mostStays = MOST_STAYS * asked)
    }

    companion object {
        /** Those that the report compares. */
        val OF_THE_REPORT: List<PlannerKind> = listOf(RANDOM_WALK, LAWNMOWER, BOUNDED)

        /** Moves that the settling lawnmower stays in a cell at most. */
        private const val MOST_STAYS = 20
    }
}
