package stillwater.run

import stillwater.plan.BoundedExtendedPlanner
import stillwater.plan.BoundedExtendedPlannerSettings
import stillwater.plan.BoundedPlanner
import stillwater.plan.BoundedPlannerSettings
import stillwater.plan.Lawnmower
import stillwater.plan.LawnmowerPattern
import stillwater.plan.Planner
import stillwater.plan.RandomWalk
import stillwater.plan.WalkSteps
import kotlin.random.Random

/**
 * Settings of the planners under comparison.
 *
 * @property walk steps of the random walk.
 * @property pattern order of the lawnmower.
 * @property bounded horizon, expansions and choices of the bounded planner.
 * @property boundedExtended horizon and expansions of the extended bounded planner.
 */
data class PlannerSettings(
    val walk: WalkSteps = WalkSteps.EDGE,
    val pattern: LawnmowerPattern = LawnmowerPattern.HAMILTONIAN_CYCLE,
    val bounded: BoundedPlannerSettings = BoundedPlannerSettings(),
    val boundedExtended: BoundedExtendedPlannerSettings = BoundedExtendedPlannerSettings(),
)

/**
 * The ways to choose where to go.
 *
 * @property label name on the command line and in files.
 * @property usesMap whether what it plans depends on the map, so that each filter with bounds has a path of its own.
 * @property startsAtFirstCell whether it starts in cell 0 instead of a random one.
 */
enum class PlannerKind(val label: String, val usesMap: Boolean, val startsAtFirstCell: Boolean) {
    /** To a random neighbour. */
    RANDOM_WALK("random-walk", usesMap = false, startsAtFirstCell = false),

    /** In a fixed order. */
    LAWNMOWER("lawnmower", usesMap = false, startsAtFirstCell = true),

    /** The report's bounded planner. */
    BOUNDED("bounded", usesMap = true, startsAtFirstCell = false),

    /** The bounded planner that remembers where it learned nothing. */
    BOUNDED_EXTENDED("bounded-extended", usesMap = true, startsAtFirstCell = false),
    ;

    /** A fresh planner of this kind that draws from [random]. */
    fun planner(random: Random, settings: PlannerSettings): Planner = when (this) {
        RANDOM_WALK -> RandomWalk(random, settings.walk)
        LAWNMOWER -> Lawnmower(settings.pattern)
        BOUNDED -> BoundedPlanner(random, settings.bounded)
        BOUNDED_EXTENDED -> BoundedExtendedPlanner(random, settings.boundedExtended)
    }
}
