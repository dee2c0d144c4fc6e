package stillwater.mission

import kotlinx.serialization.SerialName
import kotlinx.serialization.Serializable

/**
 * What the mission may use, in one of [metres] over ground and [seconds], each at most [MOST]; [reserve] is the share of
 * the way home kept.
 */
@Serializable
public data class BudgetSpec(
    @SerialName("metres") val metres: Double? = null,
    @SerialName("seconds") val seconds: Double? = null,
    val reserve: Double = 0.2,
) {
    init {
        require((metres == null) != (seconds == null)) { "a budget needs either metres or seconds" }
        require(metres == null || isUsable(metres)) { "metres ($metres m) must be above 0 and at most $MOST" }
        require(seconds == null || isUsable(seconds)) { "seconds ($seconds s) must be above 0 and at most $MOST" }
        require(reserve >= 0 && reserve.isFinite()) { "reserve ($reserve) must be at least 0 and finite" }
    }

    public companion object {
        /**
         * Largest budget, m or s: 1000 km or eleven days and a half. No boat's battery lasts as long, so that a larger
         * one is a slip of the pen; and a simulation of it comes to an end.
         */
        public const val MOST: Double = 1e6

        private fun isUsable(limit: Double) = limit > 0 && limit <= MOST
    }
}
