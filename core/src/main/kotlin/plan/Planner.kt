package stillwater.plan

import stillwater.field.FieldMap
import stillwater.model.Plan
import stillwater.model.Position

/** What came of planning. */
public sealed interface PlanOutcome {
    /** The plan holds the waypoints to go to. */
    public data object Planned : PlanOutcome

    /** No path is expected to teach anything; the plan is empty. */
    public data object NothingToGain : PlanOutcome

    /** The stop condition held before any path was found; the plan is empty. */
    public data object Stopped : PlanOutcome

    /** The boat is not on the map; the plan is empty. */
    public data object OffMap : PlanOutcome

    /** The boat is on the map but not on the water, or no way leads it out of the margin; the plan is empty. */
    public data object OffWater : PlanOutcome

    /** The budget allows no more; the plan is empty. The boat is home, unless home could never be reached. */
    public data object BudgetSpent : PlanOutcome
}

/** Tells a planner to make do with what it has: time is up, or the boat needs an answer. */
public fun interface StopCondition {
    /** Whether to stop now. Asked before each expansion. */
    public fun stop(): Boolean

    public companion object {
        /** Lets the planner come to its own end. */
        public val NEVER: StopCondition = StopCondition { false }
    }
}

/** Decides where the boat goes next. Confined to one thread; may remember earlier calls. Never throws on data. */
public fun interface Planner {
    /**
     * Fills [plan] with the next waypoints.
     *
     * @param map what is believed about the field. Not modified.
     * @param from where the boat is, local frame, m.
     * @param sensorValue what the sensor says now, sensor units.
     * @param stop when to make do with the best found so far.
     * @param plan where the waypoints are written. Modified: cleared, then filled.
     */
    public fun plan(
        map: FieldMap,
        from: Position,
        sensorValue: Double,
        stop: StopCondition,
        plan: Plan,
    ): PlanOutcome
}
