package stillwater.io

/**
 * Turns the stamps of a Platypus log into one time that keeps growing over logs joined in one file.
 *
 * The counter restarts with the app. In version 4.2.0 a start line says when, in Unix time; in the others the time of
 * day does, which is trusted up to half a day. Stamps may go back by up to [JITTER] s, because threads write them. A mission
 * that went on after a restart has start lines too, and its steps the boat's own time: where that went on and the start
 * goes back, as with a virtual boat faster than the wall's clock, the boat's time counts.
 */
internal class PlatypusClock {
    private var offset = 0.0
    private var latest = Double.NEGATIVE_INFINITY
    private var clockOfLatest = Double.NaN

    /** The last step of a mission on the boat's clock, s, and its time here; NaN before there was one. */
    private var step = Double.NaN
    private var timeOfStep = Double.NaN

    /** What the start line of a mission that went on made of [offset], where that goes back; NaN elsewhere. */
    private var wallOffset = Double.NaN

    /** Logs that were joined to the first one. */
    var joined = 0
        private set

    /** Takes a start line: the counter's [millis] stands for [epochMillis] of Unix time from here on. */
    fun start(epochMillis: Double, millis: Long) {
        if (latest > Double.NEGATIVE_INFINITY) joined++
        offset = (epochMillis - millis) / MILLIS
        wallOffset = Double.NaN
        if (step.isNaN() || epochMillis / MILLIS >= latest - JITTER) return
        wallOffset = offset
        offset = latest - millis / MILLIS
    }

    /** The first step of a mission that went on, at [next] on the boat's clock, says how long it had been away. */
    private fun goOn(millis: Long, next: Double) {
        if (!wallOffset.isNaN()) {
            offset = if (next < step) wallOffset else timeOfStep + (next - step) - millis / MILLIS
            wallOffset = Double.NaN
        }
        step = next
        timeOfStep = offset + millis / MILLIS
    }

    /**
     * Whether a line's [millis] jump ahead while the line after it, with [next], goes on from the line before: a single
     * wrong stamp, which would make all lines after it go back.
     */
    fun isAhead(millis: Long, next: Long): Boolean {
        val seconds = offset + millis / MILLIS
        val following = offset + next / MILLIS
        return seconds > latest + JITTER && following < seconds - JITTER && following >= latest - JITTER
    }

    /** Whether [millis] are so far ahead that the line after them is worth a look. */
    fun isJump(millis: Long): Boolean = offset + millis / MILLIS > latest + LONG_JUMP

    /**
     * The time of a line, s, or NaN where it went back.
     *
     * @param millis the log's counter.
     * @param clock time of day, s, or NaN where the version has none.
     * @param boatSeconds time of a mission's step on the boat's clock, s, or NaN where the line tells of none.
     */
    fun secondsAt(millis: Long, clock: Double, boatSeconds: Double = Double.NaN): Double {
        if (!boatSeconds.isNaN()) goOn(millis, boatSeconds)
        var seconds = offset + millis / MILLIS
        if (seconds < latest - JITTER) {
            val elapsed = (clock - clockOfLatest).mod(DAY)
            if (!(elapsed < DAY / 2)) return Double.NaN
            joined++
            offset += latest + elapsed - seconds
            seconds = latest + elapsed
        }
        if (seconds > latest) {
            latest = seconds
            clockOfLatest = clock
        }
        return seconds
    }

    private companion object {
        const val MILLIS = 1000.0
        const val JITTER = 1.0
        const val LONG_JUMP = 5.0
        const val DAY = 86_400.0
    }
}
