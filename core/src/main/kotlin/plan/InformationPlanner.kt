package stillwater.plan

import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Plan
import stillwater.model.Position
import kotlin.math.abs
import kotlin.math.exp
import kotlin.random.Random

/**
 * Settings of an [InformationPlanner].
 *
 * @property horizon cells on the paths that are compared, at least 1; also sets how much sooner is better than later.
 * @property moves how many moves of the best path are planned before the planner wants to be asked again, at least 1.
 * @property speed the boat's speed over ground, m/s, above 0 and finite.
 * @property settling time a reading of a cell takes once the boat is there, s, at least 0 and finite.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public data class InformationPlannerSettings(
    val horizon: Int = 10,
    val moves: Int = 1,
    val speed: Double = 1.0,
    val settling: Double = 10.0,
) {
    init {
        require(horizon >= 1) { "horizon ($horizon cells) must be at least 1" }
        require(moves >= 1) { "moves ($moves) must be at least 1" }
        require(speed > 0 && speed.isFinite()) { "speed ($speed m/s) must be above 0 and finite" }
        require(settling >= 0 && settling.isFinite()) { "settling ($settling s) must be at least 0 and finite" }
    }
}

/**
 * Goes where the map's uncertainty is expected to fall most per second, on any map with bounds.
 *
 * The width of a cell's bounds is its uncertainty u. A further visit of a cell with n visits leaves √(n/(n+1)) of it; a
 * first visit tells of the cells around, where the map has a correlation ρ: it leaves √(1 − ρ²) of theirs, see
 * core/docs/InformationPlanner.md. What a path takes away is discounted by exp(−t/T), t being the time until the cell is
 * read, travel and settling counted, and T the horizon's time.
 *
 * Compares all paths of one turn (straight ahead, then at right angles) of [InformationPlannerSettings.horizon] cells, and
 * the way to every cell farther off for that cell alone. Of equal paths one is drawn at random. Bounds that
 * crossed have no width. Plans for the cell grid of the map; no allocation once warm. O(horizon²) and a look at every
 * cell.
 *
 * @param random where ties are broken. Retained.
 * @property settings horizon and times.
 */
public class InformationPlanner(
    private val random: Random,
    public val settings: InformationPlannerSettings = InformationPlannerSettings(),
) : Planner {
    private val gains = PathGains()
    private val discounts = DoubleArray(2)
    private var bestValue = 0.0
    private var bestFirst = 0
    private var bestSecond = 0
    private var bestRowsFirst = false
    private var ties = 0

    override fun plan(
        map: FieldMap,
        from: Position,
        sensorValue: Double,
        stop: StopCondition,
        plan: Plan,
    ): PlanOutcome {
        plan.clear()
        val grid = map.grid
        val start = grid.cellAt(from)
        if (start == Grid.OUTSIDE) return PlanOutcome.OffMap
        gains.begin(map)
        bestValue = 0.0
        ties = 0
        val acrossTime = grid.cellWidth / settings.speed + settings.settling
        val alongTime = grid.cellHeight / settings.speed + settings.settling
        val horizonTime = settings.horizon * (acrossTime + alongTime) / 2
        discounts[0] = exp(-acrossTime / horizonTime)
        discounts[1] = exp(-alongTime / horizonTime)
        var stopped = false
        for (direction in 0 until DIRECTIONS) {
            stopped = stop.stop()
            if (stopped) break
            comb(grid, start, rowsFirst = direction >= 2, sign = if (direction % 2 == 0) 1 else -1)
        }
        if (!stopped) farther(grid, start)
        if (bestValue <= 0) return if (stopped) PlanOutcome.Stopped else PlanOutcome.NothingToGain
        write(grid, start, plan)
        return PlanOutcome.Planned
    }

    /** All paths whose first leg goes [sign] along the rows' or the columns' axis. */
    private fun comb(grid: Grid, start: Int, rowsFirst: Boolean, sign: Int) {
        val first = if (rowsFirst) sign * grid.columns else sign
        val second = if (rowsFirst) 1 else grid.columns
        val ahead = room(grid, start, rowsFirst, sign)
        val beside = room(grid, start, !rowsFirst, 1)
        val behind = room(grid, start, !rowsFirst, -1)
        val discount = discounts[if (rowsFirst) 1 else 0]
        var cell = start
        var value = 0.0
        var factor = 1.0
        val mark = gains.mark()
        for (leg in 1..minOf(ahead, settings.horizon)) {
            cell += first
            factor *= discount
            value += factor * gains.visit(cell)
            val rest = settings.horizon - leg
            if (rest == 0 || leg == ahead) offer(value, sign * leg, 0, rowsFirst)
            tooth(cell, second, minOf(rest, beside), value, factor, sign * leg, rowsFirst)
            tooth(cell, -second, minOf(rest, behind), value, factor, sign * leg, rowsFirst)
        }
        gains.undo(mark)
    }

    /** The path that goes on from [cell] by [length] steps of [step]. */
    private fun tooth(
        cell: Int,
        step: Int,
        length: Int,
        before: Double,
        already: Double,
        firstLeg: Int,
        rowsFirst: Boolean,
    ) {
        if (length == 0) return
        val mark = gains.mark()
        val discount = discounts[if (rowsFirst) 0 else 1]
        var at = cell
        var value = before
        var factor = already
        repeat(length) {
            at += step
            factor *= discount
            value += factor * gains.visit(at)
        }
        gains.undo(mark)
        offer(value, firstLeg, if (step > 0) length else -length, rowsFirst)
    }

    /** Cells between [start] and the grid's edge. */
    private fun room(grid: Grid, start: Int, byRows: Boolean, sign: Int): Int {
        val at = if (byRows) start / grid.columns else start % grid.columns
        val count = if (byRows) grid.rows else grid.columns
        return if (sign > 0) count - 1 - at else at
    }

    /** The ways to the cells beyond the horizon, for what each of them has itself. */
    private fun farther(grid: Grid, start: Int) {
        val row = start / grid.columns
        val column = start % grid.columns
        for (r in 0 until grid.rows) {
            val rows = r - row
            val byRows = power(discounts[1], abs(rows))
            // No cell of the row can be better than this.
            if (gains.widest * byRows <= bestValue) continue
            for (c in 0 until grid.columns) {
                val columns = c - column
                if (abs(rows) + abs(columns) <= settings.horizon) continue
                val most = gains.width(r * grid.columns + c) * byRows
                if (most <= bestValue) continue
                offer(most * power(discounts[0], abs(columns)), columns, rows, rowsFirst = false)
            }
        }
    }

    private fun power(base: Double, exponent: Int): Double {
        var result = 1.0
        var square = base
        var left = exponent
        while (left > 0) {
            if (left % 2 == 1) result *= square
            square *= square
            left /= 2
        }
        return result
    }

    private fun offer(value: Double, first: Int, second: Int, rowsFirst: Boolean) {
        if (!(value >= bestValue * ALIKE) || value <= 0) return
        if (value > bestValue / ALIKE) {
            ties = 1
        } else {
            ties++
            if (random.nextInt(ties) != 0) return
        }
        bestValue = value
        bestFirst = first
        bestSecond = second
        bestRowsFirst = rowsFirst
    }

    private fun write(grid: Grid, start: Int, plan: Plan) {
        val first = if (bestRowsFirst) grid.columns else 1
        val second = if (bestRowsFirst) 1 else grid.columns
        var at = start
        repeat(abs(bestFirst)) {
            at += if (bestFirst > 0) first else -first
            if (plan.size < settings.moves) plan.add(grid.centerX(at), grid.centerY(at))
        }
        repeat(abs(bestSecond)) {
            at += if (bestSecond > 0) second else -second
            if (plan.size < settings.moves) plan.add(grid.centerX(at), grid.centerY(at))
        }
    }

    private companion object {
        const val DIRECTIONS = 4

        /** Values as near to each other as this are equal but for rounding. */
        const val ALIKE = 1 - 1e-9
    }
}
