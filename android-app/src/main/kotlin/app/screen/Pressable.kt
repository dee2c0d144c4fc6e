package stillwater.app.screen

import stillwater.app.service.BoatSnapshot
import stillwater.mission.MissionState
import stillwater.mission.Wish

/**
 * Which of the big buttons may be pressed now; STOP always may.
 *
 * @property arm has the board armed and the boat wait.
 * @property start begins the survey, or goes on with it.
 * @property hold stays on the spot.
 * @property goHome comes back.
 * @property another forgets the mission that is loaded.
 */
internal data class Pressable(
    val arm: Boolean = false,
    val start: Boolean = false,
    val hold: Boolean = false,
    val goHome: Boolean = false,
    val another: Boolean = false,
) {
    companion object {
        /** What [snapshot] lets. */
        fun of(snapshot: BoatSnapshot): Pressable {
            val mission = snapshot.mission ?: return Pressable()
            val isReady = snapshot.preflight.isNotEmpty() && snapshot.preflight.all { it.ready }
            val isUnderWay = !mission.isOver && isUnderWay(mission.state)
            val isWaiting = !mission.isOver && mission.state == MissionState.Idle
            return Pressable(
                arm = isWaiting && isReady,
                start = (isWaiting && isReady) || (isUnderWay && mission.wish != Wish.GO_ON),
                hold = isUnderWay && mission.wish != Wish.HOLD,
                goHome = isUnderWay && mission.wish != Wish.RETURN,
                another = !isUnderWay,
            )
        }

        private fun isUnderWay(state: MissionState) = state != MissionState.Idle && state !is MissionState.Stopped
    }
}
