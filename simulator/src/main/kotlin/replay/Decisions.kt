package stillwater.replay

import stillwater.mission.Mission
import stillwater.mission.MissionState
import stillwater.model.BoatTime
import stillwater.model.Drive
import stillwater.model.Position

/**
 * A change of a mission's state.
 *
 * @property time on the boat's clock, s. @property state one word. @property why one word more; empty where there is
 *   none.
 * @property position believed, m; null where not known.
 */
internal data class Decision(val time: Double, val state: String, val why: String, val position: Position?)

/** What a replayed mission decided. Confined to one thread. */
internal class Decisions {
    private val seconds = LinkedHashMap<String, Double>()
    private var last = Double.NaN
    private var before = ""

    /** Each change of state, in order. */
    val changes = ArrayList<Decision>()

    /** Time in each state, s; between steps that lie far apart there is none, only a gap. */
    val secondsIn: Map<String, Double> get() = seconds

    /** Steps taken. */
    var steps = 0L
        private set

    /** Steps in which the motors were to run. */
    var driven = 0L
        private set

    /** Takes note of a step of [mission] at [time]. */
    fun note(mission: Mission, time: BoatTime) {
        val state = mission.state
        val why = why(state)
        val words = "${state.word} $why"
        if (words != before) changes += Decision(time.seconds, state.word, why, mission.position)
        before = words
        val passed = time.seconds - last
        // Time goes back where a log was gone on with, or where two logs were put into one file.
        if (passed >= 0) seconds.merge(if (passed > LONGEST_STEP) GAP else state.word, passed, Double::plus)
        last = time.seconds
        steps++
        if (mission.drive != Drive.NONE) driven++
    }

    companion object {
        private const val LONGEST_STEP = 1.0
        private const val GAP = "gap"

        /** One word for why a mission is in [state]; empty where the state says all. */
        fun why(state: MissionState): String = when (state) {
            is MissionState.Holding -> state.danger.name
            is MissionState.Returning -> state.danger.name
            is MissionState.Stopped -> state.reason.name
            is MissionState.Preflight -> state.missing?.name.orEmpty()
            else -> ""
        }.lowercase()
    }
}
