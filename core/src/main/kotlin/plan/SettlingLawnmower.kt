package stillwater.plan

import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Plan
import stillwater.model.Position

/**
 * Visits the cells in a fixed order and stays in each until it is known: until its bounds on the map are close enough.
 *
 * For sensors that need longer in one cell than in another, as one with a slew limit does. It needs an estimator whose
 * bounds close once the sensor has settled, and rests on them: where they are wrong it leaves too early, where they
 * never close it stays for [mostStays] moves.
 *
 * Source: own. Plans one move at a time; O(1). Confined to one thread.
 *
 * @property pattern the order, as in [Lawnmower].
 * @property known width of the bounds at which a cell is known, over the width of the prior, above 0.
 * @property mostStays moves to stay in a cell at most, one after the other, at least 1.
 * @throws IllegalArgumentException if a number is out of its range.
 */
public class SettlingLawnmower(
    public val pattern: LawnmowerPattern = LawnmowerPattern.HAMILTONIAN_CYCLE,
    public val known: Double = 0.02,
    public val mostStays: Int = 20,
) : Planner {
    init {
        require(known > 0) { "known ($known widths of the prior) must be above 0" }
        require(mostStays >= 1) { "mostStays ($mostStays moves) must be at least 1" }
    }

    private val lawnmower = Lawnmower(pattern)
    private var lastCell = Grid.OUTSIDE
    private var stays = 0

    override fun plan(
        map: FieldMap,
        from: Position,
        sensorValue: Double,
        stop: StopCondition,
        plan: Plan,
    ): PlanOutcome {
        plan.clear()
        val cell = map.grid.cellAt(from)
        if (cell == Grid.OUTSIDE) return PlanOutcome.OffMap
        if (cell != lastCell) stays = 0
        lastCell = cell
        val isKnown = map.upper(cell) - map.lower(cell) <= known * map.prior.width
        if (!isKnown && stays < mostStays) {
            stays++
            plan.add(map.grid.centerX(cell), map.grid.centerY(cell))
            return PlanOutcome.Planned
        }
        return lawnmower.plan(map, from, sensorValue, stop, plan)
    }
}
