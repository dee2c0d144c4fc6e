package stillwater.run

import stillwater.field.FieldMap
import stillwater.model.Plan
import stillwater.model.Position
import stillwater.plan.PlanOutcome
import stillwater.plan.Planner
import stillwater.plan.PolygonRrt
import stillwater.plan.StopCondition

/**
 * Where the boats of one trial went, for a figure.
 *
 * @property field kind of field.
 * @property planner the planner.
 * @property tracks places where each boat took its samples.
 * @property tree legs of the first boat's first tree.
 */
class Voyage(
    val field: String,
    val planner: PlannerKind,
    val tracks: List<List<Position>>,
    val tree: List<Pair<Position, Position>>,
)

/** Keeps the first tree that [planner] grows. */
internal class TreeKeeper(private val planner: PolygonRrt) : Planner {
    var tree: List<Pair<Position, Position>> = emptyList()
        private set

    override fun plan(
        map: FieldMap,
        from: Position,
        sensorValue: Double,
        stop: StopCondition,
        plan: Plan,
    ): PlanOutcome = planner.plan(map, from, sensorValue, stop, plan).also { if (tree.isEmpty()) tree = planner.tree() }
}
