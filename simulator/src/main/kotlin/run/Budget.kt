package stillwater.run

import stillwater.plan.TravelCost

/**
 * What a boat may use before it has to be home again.
 *
 * @property label name on the command line and in files, with its unit.
 * @property unit the unit's name.
 */
enum class BudgetKind(val label: String, val unit: String) {
    /** Moves; the stay at the start is the first. */
    MOVES("moves", "moves"),

    /** Way, m. */
    DISTANCE("distance", "m"),

    /** Time, s. */
    TIME("time", "s"),
    ;

    /** What [odometer] says of this. */
    fun used(odometer: Odometer): Double = when (this) {
        MOVES -> odometer.moves
        DISTANCE -> odometer.metres
        TIME -> odometer.seconds
    }

    /** What travelling as [travel] says costs of this. */
    fun cost(travel: Travel): TravelCost {
        val speed = travel.speed
        val move = travel.samplesPerMove * travel.period
        return when {
            this == DISTANCE -> TravelCost(perMetre = 1.0, perWaypoint = 0.0)
            speed == null -> TravelCost(perMetre = 0.0, perWaypoint = if (this == MOVES) 1.0 else move)
            // A boat that reaches the end of its plan between two samples waits there for the next.
            this == MOVES -> TravelCost(1 / (speed * move), 1.0 / travel.samplesPerMove)
            else -> TravelCost(1 / speed, travel.period)
        }
    }
}

/**
 * A boat's budget.
 *
 * @property limit how much there is of it, above 0.
 * @throws IllegalArgumentException if [limit] is out of its range.
 */
data class Budget(val kind: BudgetKind, val limit: Double) {
    init {
        require(limit > 0 && limit.isFinite()) { "budget ($limit ${kind.unit}) must be above 0 and finite" }
    }
}

/**
 * What boats used of their budget in one trial.
 *
 * @property used largest use of a boat, in the budget's unit.
 * @property home boats that were home in the end.
 */
class BudgetUse(val used: Double, val home: Int)
