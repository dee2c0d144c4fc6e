package stillwater.simulation

import stillwater.mission.MissionState

/**
 * A time spent in one state.
 *
 * @property state which. @property from when it began, s. @property until when it ended, s.
 */
data class StateSpan(val state: MissionState, val from: Double, val until: Double) {
    /** One word, and why where there is a reason. */
    val label: String get() = reason?.let { "${state.word} ($it)" } ?: state.word

    /** Why the mission was in this state; null where there is nothing to say. */
    val reason: String?
        get() = when (val state = state) {
            is MissionState.Preflight -> state.missing?.name
            is MissionState.Holding -> state.danger.name
            is MissionState.Returning -> state.danger.name
            is MissionState.Stopped -> state.reason.name
            MissionState.Idle, MissionState.Arming, MissionState.Surveying -> null
        }?.lowercase()?.replace('_', '-')
}

/** Whether the boat may move in this state: it is between the start and the end of its way. */
internal val MissionState.isUnderWay: Boolean
    get() = this == MissionState.Surveying || this is MissionState.Holding || this is MissionState.Returning

/** The states of a mission, one after the other. */
class StateHistory {
    private val ended = ArrayList<StateSpan>()
    private var current: StateSpan? = null

    /** All of them, in order. */
    val spans: List<StateSpan> get() = ended + listOfNotNull(current)

    /** The mission is in [state] at [time], s. */
    fun add(time: Double, state: MissionState) {
        val before = current
        if (before != null && before.state == state) {
            current = before.copy(until = time)
            return
        }
        if (before != null) ended += before.copy(until = time)
        current = StateSpan(state, time, time)
    }
}
