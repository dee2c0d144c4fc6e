package stillwater.mission

/** Tells for how long a boat under way has come no nearer to where it goes; [least] in m is what counts as nearer. */
internal class ProgressWatch(private val least: Double) {
    private var nearest = Double.POSITIVE_INFINITY
    private var last = Double.NaN
    private var at = Double.NaN
    private var idle = 0.0
    private var steps = 0

    /** Whether the boat came nearer [RECENT] s ago at the most, not counting how far it was at first. */
    val isGettingOn: Boolean get() = steps > 1 && idle < RECENT

    /** Another place is gone for. */
    fun begin() {
        nearest = Double.POSITIVE_INFINITY
        last = Double.NaN
        idle = 0.0
        steps = 0
    }

    /** The same place is gone for again, now [distance] m off: after a drift, or by another way. */
    fun resume(distance: Double) {
        if (!last.isNaN()) nearest += distance - last
        last = distance
    }

    /** Seconds under way, by [now] in s, since the boat, [distance] m from there now, last came nearer. */
    fun idle(now: Double, distance: Double): Double {
        val passed = now - at
        if (passed > 0 && passed <= LONGEST_STEP) idle += passed
        at = now
        last = distance
        if (distance < nearest - least) {
            nearest = distance
            idle = 0.0
            steps++
        }
        return idle
    }

    private companion object {
        /** Farther apart looks are not of one way, s. */
        const val LONGEST_STEP = 1.0

        /** s. */
        const val RECENT = 5.0
    }
}
