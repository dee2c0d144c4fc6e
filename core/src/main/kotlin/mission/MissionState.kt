package stillwater.mission

import stillwater.control.Danger

/** What a mission is about. */
public sealed interface MissionState {
    /** Nothing was started. The board is kept disarmed: a process that died may have left it armed. */
    public data object Idle : MissionState

    /**
     * Started by a person; waits until nothing stands against arming.
     *
     * @property missing what stood against it at the last step; null before the first.
     */
    public data class Preflight(val missing: Danger?) : MissionState

    /** The board was told to arm and has not said that it has. Motors rest. */
    public data object Arming : MissionState

    /** Goes where the planner says. */
    public data object Surveying : MissionState

    /** Waits for [danger] to pass, on the spot under power or with its motors at rest. */
    public data class Holding(val danger: Danger) : MissionState

    /** On its way home because of [danger], which may be that the budget allows no more. */
    public data class Returning(val danger: Danger) : MissionState

    /** Over, and disarmed. */
    public data class Stopped(val reason: StopReason) : MissionState

    /** One word, for logs and screens. */
    public val word: String
        get() = when (this) {
            Idle -> "idle"
            is Preflight -> "preflight"
            Arming -> "arming"
            Surveying -> "surveying"
            is Holding -> "holding"
            is Returning -> "returning"
            is Stopped -> "stopped"
        }
}

/** Why a mission is over. */
public enum class StopReason {
    /** It did what it was to do. */
    COMPLETED,

    /** A person stopped it. */
    OPERATOR,

    /** The boat's battery was low. */
    BATTERY,

    /** The phone's battery was low. */
    PHONE,

    /** The log could not be written. */
    LOG_LOST,

    /** The boat was beyond the fence, and the policy is to stop. */
    FENCE,

    /** The boat was held up on every way home, again and again for hours: its motors rest where it is. */
    STRANDED,

    /** The board disarmed itself, and the policy is not to arm it again without a person. */
    DISARMED,
}
