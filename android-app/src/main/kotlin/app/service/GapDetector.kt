package stillwater.app.service

/** Notices when the phone slept although it was to work. Confined to the boat's thread. */
internal class GapDetector {
    private var last = Double.NaN

    /** What was noticed so far. */
    var gaps = Gaps()
        private set

    /** The loop comes round at [seconds], on a clock that goes on while the phone sleeps. */
    fun tick(seconds: Double) {
        val gap = seconds - last
        last = seconds
        if (gap > SHORTEST) gaps = Gaps(gaps.count + 1, maxOf(gaps.longestSeconds, gap))
    }

    /** The loop rests, and is not to come round. */
    fun rest() {
        last = Double.NaN
    }

    private companion object {
        /** The board's watchdog has rested the motors by then, s. */
        const val SHORTEST = 0.5
    }
}
