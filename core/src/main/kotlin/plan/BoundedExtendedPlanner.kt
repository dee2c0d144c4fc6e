package stillwater.plan

import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Plan
import stillwater.model.Position
import kotlin.math.abs
import kotlin.random.Random

/**
 * Settings of a [BoundedExtendedPlanner].
 *
 * @property horizon moves in the longest path of the search, at least 1.
 * @property expansions nodes expanded for one plan, at least 1.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public data class BoundedExtendedPlannerSettings(val horizon: Int = 10, val expansions: Int = 200) {
    init {
        require(horizon >= 1) { "horizon ($horizon moves) must be at least 1" }
        require(expansions >= 1) { "expansions ($expansions) must be at least 1" }
    }
}

/**
 * The bounded planner that does not stall: it remembers where visits taught less than expected.
 *
 * As the report's it searches paths on which the sensor should tighten bounds. What differs:
 *
 * - *What a visit is worth* is how far the sensor is expected to push the bound of the side it comes from, at the share of
 *   the way to a cell's value that it was seen to go in a move; times what visits from that side were worth so far.
 * - *No-progress memory*: that factor is realised over expected tightening, kept for each cell and side. A cell that is
 *   always entered from the side that is tight already is worth nothing soon.
 * - *Visit memory*: a cell is worth its width over twice the number of its visits and one at the least, so that cells are
 *   not forgotten.
 * - *Fall-back goal*: where a cell farther away is worth more for each move than the best path, or no path has any
 *   value, the boat goes there; where nothing has any value, or a cell was visited less than a sixteenth of the
 *   mean, to the cell visited least.
 * - *Commitment*: paths and ways to a goal are planned whole.
 *
 * Never stalls: on a grid of two cells or more every plan holds at least one move, and every cell is
 * visited again and again as long as visits are counted in the map, core/docs/BoundedExtendedPlanner.md. Works
 * on the bounds of any map; bounds that crossed are as wide as they are apart. Source: the report, section 6, and own result. O(cells + expansions), no
 * allocation once warm. One planner plans for one boat on one map.
 *
 * @param random where the order of neighbours comes from. Retained.
 * @property settings horizon and expansions.
 */
public class BoundedExtendedPlanner(
    random: Random,
    public val settings: BoundedExtendedPlannerSettings = BoundedExtendedPlannerSettings(),
) : Planner {
    private val tree = SearchTree(minOf(DIRECTIONS.toLong() * settings.expansions + 1, MAX_INITIAL_NODES).toInt())
    private val path = IntArray(minOf(settings.horizon, settings.expansions))
    private val neighbours = NeighbourOrder(random, DIRECTIONS)
    private var progress = ProgressMemory(0)
    private var grid: Grid? = null

    override fun plan(
        map: FieldMap,
        from: Position,
        sensorValue: Double,
        stop: StopCondition,
        plan: Plan,
    ): PlanOutcome {
        plan.clear()
        if (map.grid != grid) {
            progress = ProgressMemory(map.grid.size)
            grid = map.grid
        }
        val start = map.grid.cellAt(from)
        if (start == Grid.OUTSIDE) return PlanOutcome.OffMap
        if (map.grid.size == 1) return PlanOutcome.NothingToGain
        progress.learn(map, start, sensorValue)
        val sensor = if (sensorValue.isFinite()) sensorValue else map.value(start)
        val stopped = search(map, start, sensor, stop)
        val best = best()
        val rate = if (best == ROOT) 0.0 else tree.value(best) / tree.depth(best)
        if (stopped && best == ROOT) return PlanOutcome.Stopped
        val goal = if (stopped) start else progress.goal(map, start, rate)
        if (goal == start) write(map, best, sensor, plan) else walk(map, start, goal, sensor, plan)
        return PlanOutcome.Planned
    }

    /** Grows the tree; whether it was stopped. */
    private fun search(map: FieldMap, start: Int, sensor: Double, stop: StopCondition): Boolean {
        tree.clear(map.grid.size)
        tree.add(start, parent = -1, value = 0.0, sensor = sensor, priority = 0.0, queued = true)
        var polls = 0
        while (polls < settings.expansions && !tree.exhausted) {
            if (stop.stop()) return true
            expand(map, tree.poll())
            polls++
        }
        return false
    }

    private fun expand(map: FieldMap, node: Int) {
        tree.walk(node)
        neighbours.forEach(map.grid, tree.cell(node)) { cell -> enter(map, node, cell) }
    }

    private fun enter(map: FieldMap, from: Int, cell: Int) {
        val sensor = tree.sensor(from)
        // What a visit of this path has taken from a cell, the next cannot take again.
        val earlier = tree.visitsOnPath(cell)
        val gain = progress.worth(map, cell, sensor) / (1 + earlier) / (1 + earlier)
        val value = tree.value(from) + gain
        val depth = tree.depth(from) + 1
        tree.add(cell, from, value, progress.after(map, cell, sensor), value / depth, depth < settings.horizon)
    }

    /** The node with the highest value, of equal ones the first; [ROOT] when none has any. */
    private fun best(): Int {
        var best = ROOT
        for (node in 1 until tree.size) if (tree.value(node) > tree.value(best)) best = node
        return best
    }

    private fun write(map: FieldMap, node: Int, sensor: Double, plan: Plan) {
        val length = tree.depth(node)
        var at = node
        for (place in length - 1 downTo 0) {
            path[place] = tree.cell(at)
            at = tree.parent(at)
        }
        var expected = sensor
        for (place in 0 until length) expected = go(map, path[place], expected, plan)
    }

    /** The way from [start] to [goal]: of the two next cells on a shortest way always the one that is worth more. */
    private fun walk(map: FieldMap, start: Int, goal: Int, sensor: Double, plan: Plan) {
        val columns = map.grid.columns
        var at = start
        var expected = sensor
        while (at != goal) {
            val byColumn = at + (goal % columns).compareTo(at % columns)
            val byRow = at + columns * (goal / columns).compareTo(at / columns)
            at = when {
                byColumn == at -> byRow
                byRow == at -> byColumn
                progress.worth(map, byColumn, expected) >= progress.worth(map, byRow, expected) -> byColumn
                else -> byRow
            }
            expected = go(map, at, expected, plan)
        }
    }

    private fun go(map: FieldMap, cell: Int, sensor: Double, plan: Plan): Double {
        progress.expect(map, cell, sensor)
        plan.add(map.grid.centerX(cell), map.grid.centerY(cell))
        return progress.after(map, cell, sensor)
    }

    private companion object {
        const val ROOT = 0
        const val DIRECTIONS = 4
        const val MAX_INITIAL_NODES = 1L shl 16
    }
}

/**
 * What visits of each cell were worth, by the side from which the sensor came, and how far the sensor goes in a move.
 *
 * @param cells number of cells.
 */
internal class ProgressMemory(cells: Int) {
    /** Realised over expected tightening, for sensors that come from below and from above. */
    private val below = FloatArray(cells) { 1f }
    private val above = FloatArray(cells) { 1f }

    // What the plan before expects of each cell, once for each cell.
    private val planned = IntArray(cells)
    private var plannedCount = 0
    private val expected = DoubleArray(cells)
    private val widths = DoubleArray(cells)
    private val visits = IntArray(cells)
    private val fromBelow = BooleanArray(cells)
    private val waiting = BooleanArray(cells)

    // The last cell of that plan, and the reading with which the boat set out.
    private var last = Grid.OUTSIDE
    private var lastSensor = 0.0
    private var lastValue = 0.0
    private var gone = FIRST_SHARE * FIRST_WEIGHT
    private var ways = FIRST_WEIGHT

    /** Share of the way to a cell's value that the sensor goes while the boat is there, dimensionless. */
    val share: Double get() = (gone / ways).coerceIn(SMALLEST_SHARE, 1.0)

    /** What a visit of [cell] by a sensor at [sensor] should take off its width, sensor units, at least 0. */
    fun worth(map: FieldMap, cell: Int, sensor: Double): Double {
        val width = width(map, cell)
        val trust = if (sensor < map.value(cell)) below[cell] else above[cell]
        return maxOf(minOf(width, trust * reach(map, cell, sensor)), width / (2.0 * (1 + map.visits(cell))))
    }

    /** The sensor's expected reading on leaving [cell], entered at [sensor]. */
    fun after(map: FieldMap, cell: Int, sensor: Double): Double {
        val there = sensor + share * (map.value(cell) - sensor)
        return if (there.isFinite()) there else sensor
    }

    /** How far the bound on the side the sensor comes from would move, if the cell's value were right. */
    private fun reach(map: FieldMap, cell: Int, sensor: Double): Double {
        val left = after(map, cell, sensor)
        val reach = if (sensor < map.value(cell)) left - map.lower(cell) else map.upper(cell) - left
        return if (reach > 0) reach else 0.0
    }

    private fun width(map: FieldMap, cell: Int): Double {
        // Bounds that crossed are as far from the truth as they are apart, at the least.
        val width = abs(map.upper(cell) - map.lower(cell))
        return if (width.isFinite()) width else 0.0
    }

    /** Notes that the plan goes through [cell], entered at [sensor]. */
    fun expect(map: FieldMap, cell: Int, sensor: Double) {
        last = cell
        lastSensor = sensor
        lastValue = map.value(cell)
        if (waiting[cell]) return
        waiting[cell] = true
        planned[plannedCount++] = cell
        expected[cell] = reach(map, cell, sensor)
        widths[cell] = width(map, cell)
        visits[cell] = map.visits(cell)
        fromBelow[cell] = sensor < map.value(cell)
    }

    /** Compares what the plan before expected with what [map] says now; the boat is in [start] and reads [sensor]. */
    fun learn(map: FieldMap, start: Int, sensor: Double) {
        for (i in 0 until plannedCount) {
            val cell = planned[i]
            waiting[cell] = false
            if (map.visits(cell) == visits[cell]) continue
            val realised = maxOf(0.0, widths[cell] - width(map, cell))
            val ratio = if (expected[cell] > 0) realised / expected[cell] else 0.0
            val memory = if (fromBelow[cell]) below else above
            memory[cell] += RATE * (minOf(ratio, MOST_TRUST).toFloat() - memory[cell])
        }
        plannedCount = 0
        // Only a cell whose value was known to a part of the way tells how much of the way the sensor went.
        if (last == start && sensor.isFinite() && width(map, start) < abs(map.value(start) - lastSensor) / 2) {
            val way = map.value(start) - lastSensor
            val scale = way * way
            if (scale > 0 && scale.isFinite()) {
                gone += ((sensor - lastSensor) / way).coerceIn(0.0, 1.0)
                ways += 1
            }
        }
        last = Grid.OUTSIDE
    }

    /**
     * The cell worth more for each move of the way there than [rate], the most of all; [start] where there is none. Where
     * nothing at all has any worth, or a cell was visited less than one [FORGOTTEN]th of the mean, the cell other than
     * [start] that was visited least, of those the nearest.
     */
    fun goal(map: FieldMap, start: Int, rate: Double): Int {
        var goal = start
        var best = rate
        var least = start
        var all = map.visits(start).toLong()
        for (cell in 0 until map.grid.size) {
            if (cell == start) continue
            all += map.visits(cell)
            val far = distance(map.grid, start, cell)
            // What it is worth to come from there with the sensor where it is most wanted is not known: half its width.
            val worth = width(map, cell) / (2.0 * (1 + map.visits(cell))) / far
            if (worth > best) {
                best = worth
                goal = cell
            }
            val fewer = least == start || map.visits(cell) < map.visits(least)
            val nearer = map.visits(cell) == map.visits(least) && far < distance(map.grid, start, least)
            if (fewer || nearer) least = cell
        }
        val forgotten = (map.visits(least) + 1.0) * FORGOTTEN * map.grid.size < all
        return if (forgotten || (goal == start && !(rate > 0))) least else goal
    }

    private fun distance(grid: Grid, one: Int, other: Int): Int =
        abs(one % grid.columns - other % grid.columns) + abs(one / grid.columns - other / grid.columns)

    private companion object {
        const val FIRST_SHARE = 0.5
        const val FIRST_WEIGHT = 4.0
        const val SMALLEST_SHARE = 0.05
        const val RATE = 0.5f
        const val MOST_TRUST = 2.0
        const val FORGOTTEN = 16
    }
}
