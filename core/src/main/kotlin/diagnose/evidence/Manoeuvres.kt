package stillwater.diagnose.evidence

import stillwater.diagnose.Cause

/** What to do with the boat so that causes which this track cannot separate differ next time. */
internal object Manoeuvres {
    private val delays = setOf(
        Cause.DEAD_TIME,
        Cause.SECOND_ORDER_RESPONSE,
        Cause.TWO_PATH_RESPONSE,
        Cause.TIME_CONSTANT,
    )

    /** The manoeuvre that would separate the causes of [set]. */
    fun of(set: Set<Cause>): String {
        val parts = ArrayList<String>()
        if (Cause.POSITION_OFFSET in
            set
        ) {
            parts +=
                "run the same line at twice and at half the speed: a delay shifts by time, a place by distance"
        }
        if (set.count { it in delays } >
            1
        ) {
            parts +=
                "cross a sharp front, or move the probe between two samples, and stay until the reading has settled"
        }
        if (Cause.FLOW_DEPENDENT_RESPONSE in set) parts += "repeat a front at two speeds"
        if (Cause.TEMPERATURE_DEPENDENT_RESPONSE in set) parts += "repeat the same front in warm and in cold water"
        if (Cause.ASYMMETRIC_RESPONSE in
            set
        ) {
            parts += "run the same line in both directions, so that each rise is also a fall"
        }
        val ofZero = setOf(Cause.DRIFT, Cause.OFFSET_STEPS, Cause.CROSS_SENSITIVITY).intersect(set)
        if (Cause.TIME_VARYING_FIELD in set && ofZero.isNotEmpty()) {
            // However often a boat comes back, its sensor and the water have changed together.
            parts +=
                "measure a sample that stays as it is, or beside a second probe, at the start, in between and at the end"
        } else if (Cause.TIME_VARYING_FIELD in set || ofZero.any { it != Cause.CROSS_SENSITIVITY }) {
            parts += "come back to the same place every few minutes"
        }
        if (Cause.HYSTERESIS in set ||
            Cause.SLEW_LIMIT in set
        ) {
            parts += "stop for several time constants after a rise and after a fall"
        }
        if (Cause.CROSS_SENSITIVITY in set) parts += "hold the water still and change the other quantity alone"
        if (Cause.SATURATION in set) parts += "bring the probe into a sample beyond the suspected end"
        if (Cause.QUANTISATION in set) parts += "log with more digits, or stay in one place for a minute"
        if (parts.isEmpty()) parts += "stop for several time constants, then cross the same front at another speed"
        return parts.joinToString("; ")
    }
}
