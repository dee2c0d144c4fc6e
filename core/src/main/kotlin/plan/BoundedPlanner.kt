package stillwater.plan

import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Plan
import stillwater.model.Position
import kotlin.random.Random

/** How much of the chosen path the boat runs before it plans again. */
public enum class Execution {
    /** The whole path. */
    WHOLE_PATH,

    /** Its first move only. */
    SINGLE_STEP,
}

/** Which of the paths in the tree is run. */
public enum class PathChoice {
    /** The one with the highest value. */
    BEST,

    /**
     * The last polled one that has any value: what the report's original code did, by comparing each polled node with
     * the root instead of the best so far.
     */
    LAST_POLLED,
}

/** Which cells the boat can reach in one move. */
public enum class Neighbours {
    /** The up to four that share an edge. */
    EDGE,

    /** The up to eight that share an edge or a corner: the original. */
    EDGE_OR_CORNER,
}

/** Which open node of the tree is expanded first. */
public enum class Priority {
    /** The one whose path has the highest value per move: the report's "rate that value has accumulated". */
    VALUE_PER_MOVE,

    /** The one whose path has the highest value: the original. */
    VALUE,
}

/**
 * Settings of a [BoundedPlanner]; the defaults reproduce the report's Figures 6 and 7.
 *
 * @property horizon moves in the longest path, at least 1.
 * @property expansions nodes polled from the queue for one plan, at least 1. Each is expanded but those at the horizon,
 *   which only [PathChoice.LAST_POLLED] polls.
 * @property maxChange largest change of the sensor expected within one cell, sensor units, above 0.
 * @property discountVisits whether a cell's value is divided by 1 + its visits earlier on the path.
 * @property execution how much of the path is run.
 * @property choice which path is run.
 * @property neighbours which cells can be reached in one move.
 * @property priority which node is expanded first.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public data class BoundedPlannerSettings(
    val horizon: Int = 10,
    val expansions: Int = 200,
    val maxChange: Double = 0.5,
    val discountVisits: Boolean = true,
    val execution: Execution = Execution.WHOLE_PATH,
    val choice: PathChoice = PathChoice.BEST,
    val neighbours: Neighbours = Neighbours.EDGE,
    val priority: Priority = Priority.VALUE_PER_MOVE,
) {
    init {
        require(horizon >= 1) { "horizon ($horizon moves) must be at least 1" }
        require(expansions >= 1) { "expansions ($expansions) must be at least 1" }
        require(maxChange > 0 && maxChange.isFinite()) { "maxChange ($maxChange) must be above 0 and finite" }
    }
}

/**
 * Seeks the path on which the sensor is expected to tighten the bounds most.
 *
 * A best-first tree of moves between neighbouring cells. A cell with bounds [L, U] and midpoint m is worth
 * max(0, (U − L) − |m − s|) to a sensor that enters it at s, and the sensor is expected to leave it at
 * s + clamp(m − s, ±maxChange). The queue polls the node with the highest value per move, or as
 * [BoundedPlannerSettings.priority] says.
 *
 * Source: the report, section 6, Algorithm 2. Differs: the printed value lacks the absolute value, the printed change
 * its lower clip; the visit discount 1 / (1 + visits on the path) and the heuristic value / depth are readings of
 * "the number of times that cell has been previously visited on the path" and "the current expansion depth and the
 * rate that value has accumulated". Before anything is measured all cells are alike: neighbours enter the tree in a
 * random order, so that no direction is preferred. Bounds that crossed count as having no width. Plans for the cell grid
 * of the map; no allocation once warm.
 *
 * @param random where the order of neighbours comes from. Retained.
 * @property settings horizon, expansions and choices.
 */
public class BoundedPlanner(
    random: Random,
    public val settings: BoundedPlannerSettings = BoundedPlannerSettings(),
) : Planner {
    private val tree = BoundedTree(
        settings,
        NeighbourOrder(random, if (settings.neighbours == Neighbours.EDGE) EDGES else NeighbourOrder.ALL),
    )

    override fun plan(
        map: FieldMap,
        from: Position,
        sensorValue: Double,
        stop: StopCondition,
        plan: Plan,
    ): PlanOutcome {
        plan.clear()
        val start = map.grid.cellAt(from)
        if (start == Grid.OUTSIDE) return PlanOutcome.OffMap
        val sensor = if (sensorValue.isFinite()) sensorValue else midpoint(map, start)
        tree.begin(map, start, sensor)
        var polls = 0
        var stopped = false
        while (polls < settings.expansions && !tree.exhausted) {
            stopped = stop.stop()
            if (stopped) break
            tree.advance()
            polls++
        }
        if (!tree.hasChoice) return if (stopped) PlanOutcome.Stopped else PlanOutcome.NothingToGain
        tree.write(plan)
        if (settings.execution == Execution.SINGLE_STEP) plan.truncate(1)
        return PlanOutcome.Planned
    }

    private fun midpoint(map: FieldMap, cell: Int) = map.lower(cell) / 2 + map.upper(cell) / 2

    private companion object {
        const val EDGES = 4
    }
}
