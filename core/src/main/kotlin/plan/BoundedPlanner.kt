package stillwater.plan

import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Plan
import stillwater.model.Position
import kotlin.math.abs
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

/**
 * Settings of a [BoundedPlanner]; the defaults reproduce the report's Figures 6 and 7.
 *
 * @property horizon moves in the longest path, at least 1.
 * @property expansions nodes expanded for one plan, at least 1.
 * @property maxChange largest change of the sensor expected within one cell, sensor units, above 0.
 * @property discountVisits whether a cell's value is divided by 1 + its visits earlier on the path.
 * @property execution how much of the path is run.
 * @property choice which path is run.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public data class BoundedPlannerSettings(
    val horizon: Int = 10,
    val expansions: Int = 200,
    val maxChange: Double = 0.5,
    val discountVisits: Boolean = true,
    val execution: Execution = Execution.WHOLE_PATH,
    val choice: PathChoice = PathChoice.BEST,
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
 * A best-first tree of moves between cells that share an edge. A cell with bounds [L, U] and midpoint m is worth
 * max(0, (U − L) − |m − s|) to a sensor that enters it at s, and the sensor is expected to leave it at
 * s + clamp(m − s, ±maxChange). The queue polls the node with the highest value per move.
 *
 * Source: the report, section 6, Algorithm 2. Differs: the printed value lacks the absolute value, the printed change
 * its lower clip; the visit discount 1 / (1 + visits on the path) and the heuristic value / depth are readings of
 * "the number of times that cell has been previously visited on the path" and "the current expansion depth and the
 * rate that value has accumulated". Bounds that crossed count as having no width. Plans for the cell grid of the map;
 * no allocation once warm.
 *
 * @property settings horizon, expansions and choices.
 */
public class BoundedPlanner(
    private val random: Random,
    public val settings: BoundedPlannerSettings = BoundedPlannerSettings(),
) : Planner {
    private val tree =
        SearchTree(capacity = minOf(MOST_CHILDREN.toLong() * settings.expansions + 1, MAX_INITIAL_NODES).toInt())
    private val path = IntArray(minOf(settings.horizon, settings.expansions))
    private val directions = IntArray(MOST_CHILDREN) { it }

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
        tree.clear()
        tree.add(start, parent = -1, value = 0.0, sensor = sensor, priority = 0.0, queued = true)
        var lastPolled = ROOT
        var expansions = 0
        var stopped = false
        while (expansions < settings.expansions && !tree.exhausted) {
            stopped = stop.stop()
            if (stopped) break
            val node = tree.poll()
            if (tree.value(node) > 0) lastPolled = node
            if (tree.depth(node) == settings.horizon) continue
            expand(map, node)
            expansions++
        }
        val chosen = if (settings.choice == PathChoice.BEST) best() else lastPolled
        if (chosen == ROOT) return if (stopped) PlanOutcome.Stopped else PlanOutcome.NothingToGain
        write(map.grid, chosen, plan)
        if (settings.execution == Execution.SINGLE_STEP) plan.truncate(1)
        return PlanOutcome.Planned
    }

    private fun expand(map: FieldMap, node: Int) {
        val grid = map.grid
        val cell = tree.cell(node)
        val column = cell % grid.columns
        val row = cell / grid.columns
        shuffleDirections()
        for (direction in directions) {
            when (direction) {
                WEST -> if (column > 0) enter(map, node, cell - 1)
                EAST -> if (column < grid.columns - 1) enter(map, node, cell + 1)
                SOUTH -> if (row > 0) enter(map, node, cell - grid.columns)
                NORTH -> if (row < grid.rows - 1) enter(map, node, cell + grid.columns)
            }
        }
    }

    /** Fisher and Yates: every order is as likely. */
    private fun shuffleDirections() {
        for (last in directions.lastIndex downTo 1) {
            val other = random.nextInt(last + 1)
            val direction = directions[last]
            directions[last] = directions[other]
            directions[other] = direction
        }
    }

    private fun enter(map: FieldMap, from: Int, cell: Int) {
        val sensor = tree.sensor(from)
        val middle = midpoint(map, cell)
        var gain = maxOf(0.0, map.upper(cell) - map.lower(cell) - abs(middle - sensor))
        if (settings.discountVisits) gain /= 1 + tree.visitsOnPath(from, cell)
        val value = tree.value(from) + gain
        val change = (middle - sensor).coerceIn(-settings.maxChange, settings.maxChange)
        val depth = tree.depth(from) + 1
        // A node at the horizon can't be expanded; polling it matters only to the original's choice.
        val queued = depth < settings.horizon || settings.choice == PathChoice.LAST_POLLED
        tree.add(cell, from, value, sensor + change, value / depth, queued)
    }

    /** The node with the highest value, of equal ones the first; [ROOT] when none has any. */
    private fun best(): Int {
        var best = ROOT
        for (node in 1 until tree.size) if (tree.value(node) > tree.value(best)) best = node
        return best
    }

    private fun write(grid: Grid, node: Int, plan: Plan) {
        val length = tree.depth(node)
        var at = node
        for (place in length - 1 downTo 0) {
            path[place] = tree.cell(at)
            at = tree.parent(at)
        }
        for (place in 0 until length) plan.add(grid.centerX(path[place]), grid.centerY(path[place]))
    }

    private fun midpoint(map: FieldMap, cell: Int) = map.lower(cell) / 2 + map.upper(cell) / 2

    private companion object {
        const val ROOT = 0
        const val WEST = 0
        const val EAST = 1
        const val SOUTH = 2
        const val NORTH = 3
        const val MOST_CHILDREN = 4
        const val MAX_INITIAL_NODES = 1L shl 16
    }
}
