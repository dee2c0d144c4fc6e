package stillwater.drive

import stillwater.control.Danger
import stillwater.mission.Mission
import stillwater.mission.MissionState
import stillwater.model.BoatTime
import stillwater.wire.BoardState

/** What a mission still waits for before its boat moves, in words for the person who waits with it. */
internal object Waiting {
    /** One phrase each, of [mission] at [time]; none once it is armed. */
    fun of(mission: Mission, time: BoatTime): List<String> = when (val state = mission.state) {
        MissionState.Idle -> listOfNotNull(link(mission, time), "no fix yet".takeIf { mission.position == null })
        is MissionState.Preflight ->
            listOfNotNull(link(mission, time), place(mission, state.missing), other(state.missing))
        MissionState.Arming -> listOfNotNull(link(mission, time), board(mission.board.state))
        else -> emptyList()
    }

    private fun link(mission: Mission, time: BoatTime): String? {
        val silence = mission.board.silence(time)
        return when {
            silence.isInfinite() && mission.board.unreadable > 0 ->
                "the board cannot be understood: is --baud right, is it a Platypus board?"
            silence.isInfinite() -> "nothing heard from the board: is it on, is --port right?"
            silence > LONGEST_SILENCE -> "the board has been silent for ${silence.toInt()} s"
            else -> null
        }
    }

    /** Without a link nothing else is looked at; whether there is a place at all can be told all the same. */
    private fun place(mission: Mission, missing: Danger?): String? = when {
        mission.position == null -> "no fix yet"
        missing == Danger.FIX_STALE -> "fixes have to agree for some 15 s, and a heading is needed"
        missing == Danger.FIX_JUMPING -> "fixes jump"
        else -> null
    }

    private fun other(missing: Danger?): String? = when (missing) {
        Danger.FENCE -> "the boat is outside the mission's area"
        Danger.BATTERY_LOW -> "the boat's battery is low"
        Danger.LOG_LOST -> "the log cannot be written"
        else -> null
    }

    private fun board(state: BoardState?) = "the board was told to arm, which takes 2 to 36 s, and " +
        if (state == null) "has not answered yet" else "says that it is ${state.name.lowercase()}"

    /** A board at rest is asked again after 1 s where an answer was lost; two lost ones are a silence. s. */
    private const val LONGEST_SILENCE = 2.0
}
