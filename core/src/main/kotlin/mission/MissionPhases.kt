package stillwater.mission

import stillwater.control.Danger
import stillwater.control.Failsafe
import stillwater.control.Ruling
import stillwater.wire.BoardState

/**
 * What the next state depends on.
 *
 * @property board what the board is known to be, active only where its motors obey; null where that is not known.
 */
internal class PhaseInput(
    val ruling: Ruling,
    val board: BoardState?,
    val isHome: Boolean,
    val rearms: Boolean,
)

/** Which state follows which. Stateless. */
internal object MissionPhases {
    /** The state after [state]. */
    fun next(state: MissionState, input: PhaseInput): MissionState {
        val danger = (input.ruling as? Ruling.Fall)?.danger
        if (state == MissionState.Idle || state is MissionState.Stopped) return state
        if (danger == Danger.OPERATOR_STOP) return MissionState.Stopped(StopReason.OPERATOR)
        return when (state) {
            is MissionState.Preflight -> preflight(danger)
            MissionState.Arming -> if (input.board == BoardState.ACTIVE) underWay(input) else state
            else -> if (input.board == null || input.board == BoardState.ACTIVE) underWay(input) else disarmed(input)
        }
    }

    /** What a person wants of an armed boat does not keep it from arming. */
    private fun preflight(danger: Danger?) =
        if (danger == null || danger in WISHES) MissionState.Arming else MissionState.Preflight(danger)

    private fun disarmed(input: PhaseInput) =
        if (input.rearms) MissionState.Arming else MissionState.Stopped(StopReason.DISARMED)

    private fun underWay(input: PhaseInput): MissionState {
        val fall = input.ruling as? Ruling.Fall ?: return MissionState.Surveying
        return when (fall.failsafe) {
            Failsafe.HOLD -> MissionState.Holding(fall.danger)
            Failsafe.RETURN_HOME -> {
                val reason = if (input.isHome) atHome(fall.danger) else null
                reason?.let { MissionState.Stopped(it) } ?: MissionState.Returning(fall.danger)
            }
            Failsafe.STOP -> final(fall.danger)?.let { MissionState.Stopped(it) } ?: MissionState.Holding(fall.danger)
        }
    }

    /** Why a boat that came home for [danger] stays there; null where it may go on once the danger has passed. */
    private fun atHome(danger: Danger) = final(danger).takeIf { danger != Danger.FENCE }

    /** Why a danger that rests the motors ends the mission; null for those that may pass. */
    private fun final(danger: Danger): StopReason? = when (danger) {
        Danger.MISSION_END -> StopReason.COMPLETED
        Danger.BATTERY_LOW -> StopReason.BATTERY
        Danger.PHONE_LOW -> StopReason.PHONE
        Danger.FENCE -> StopReason.FENCE
        Danger.STRANDED -> StopReason.STRANDED
        Danger.LOG_LOST -> StopReason.LOG_LOST
        Danger.OPERATOR_STOP, Danger.OPERATOR_RETURN -> StopReason.OPERATOR
        Danger.LINK_LOST,
        Danger.FIX_STALE,
        Danger.FIX_JUMPING,
        Danger.HELD_UP,
        Danger.BUDGET_SPENT,
        Danger.OPERATOR_WAIT,
        Danger.OPERATOR_HOLD,
        -> null
    }

    private val WISHES = Wish.entries.mapNotNull { it.danger }
}
