package stillwater.diagnose.response

/** How the truth goes on over the step between two rows. */
internal enum class Steps {
    /** Evenly, as water does. */
    EVEN,

    /** As the row behind the step says, all over it: half a step sooner. So a simulation that steps its sensor once a row. */
    HELD,

    /**
     * As the row before the step says: half a step later. So a simulation in explicit steps, and readings that were taken
     * half a row before their time stamps.
     */
    UNTIL_NEXT,
    ;

    /** Whether the truth stands still over each step. */
    val isHeld: Boolean get() = this != EVEN

    /** Held where these are not, and the other way round. */
    val other: Steps get() = if (isHeld) EVEN else HELD

    /** By how much of a step the sensor has the truth sooner than where it goes on evenly. */
    val lead: Double get() = when (this) {
        EVEN -> 0.0
        HELD -> 0.5
        UNTIL_NEXT -> -0.5
    }
}
