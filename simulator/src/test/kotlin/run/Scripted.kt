package stillwater.run

import stillwater.estimate.FieldEstimator
import stillwater.estimate.ReadingUse
import stillwater.field.FieldMap
import stillwater.model.BoatTime
import stillwater.model.Conditions
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.Plan
import stillwater.model.Position
import stillwater.plan.PlanOutcome
import stillwater.plan.Planner
import stillwater.plan.StopCondition

/** Hands out [plans], a list of cells each, in order; then and for an empty one there is nothing to gain. */
internal class ScriptedPlanner(private val grid: Grid, vararg plans: List<Int>) : Planner {
    private val left = ArrayDeque(plans.toList())

    /** What it was asked: the map, the boat's cell and the sensor's value. */
    val asked = ArrayList<Triple<FieldMap, Int, Double>>()

    override fun plan(
        map: FieldMap,
        from: Position,
        sensorValue: Double,
        stop: StopCondition,
        plan: Plan,
    ): PlanOutcome {
        asked += Triple(map, grid.cellAt(from), sensorValue)
        plan.clear()
        val cells = left.removeFirstOrNull().orEmpty()
        for (cell in cells) plan.add(grid.centerX(cell), grid.centerY(cell))
        return if (cells.isEmpty()) PlanOutcome.NothingToGain else PlanOutcome.Planned
    }
}

/** Remembers every reading; its map shows in each cell the last reading taken there, 0.5 before. */
internal class RecordingEstimator(private val grid: Grid) : FieldEstimator {
    class Record(val seconds: Double, val cell: Int, val value: Double)

    val records = ArrayList<Record>()
    override val map = FieldMap(grid, Interval.UNIT)

    override fun update(
        time: BoatTime,
        x: Double,
        y: Double,
        value: Double,
        conditions: Conditions,
    ): ReadingUse {
        records += Record(time.seconds, grid.cellAt(x, y), value)
        map.setValue(grid.cellAt(x, y), value)
        return ReadingUse.USED
    }
}
