package stillwater.survey

import kotlin.math.hypot

/**
 * A silence in a log.
 *
 * @property start time of the last reading before it, s after the first reading of the log.
 * @property seconds how long it lasted, s. @property jump way between the readings on either side, m.
 */
data class Gap(val start: Double, val seconds: Double, val jump: Double)

/**
 * Finds silences longer than a limit. Confined to one thread; keeps the times of the first [MOST_KEPT] of them.
 *
 * @property limit silence that counts as a gap, s.
 */
class Gaps(val limit: Double) {
    private var ends = DoubleArray(16)
    private var kept = 0
    private var first = Double.NaN
    private var last = Double.NaN
    private var lastX = 0.0
    private var lastY = 0.0

    /** Number of gaps. */
    var count = 0L
        private set

    /** The longest gap; null without any. */
    var longest: Gap? = null
        private set

    /** Takes a reading of the time [seconds], s, growing, at ([x], [y]), m. */
    fun add(seconds: Double, x: Double, y: Double) {
        if (first.isNaN()) first = seconds
        val silence = seconds - last
        if (silence > limit) {
            count++
            if (silence > (longest?.seconds ?: 0.0)) {
                longest = Gap(last - first, silence, hypot(x - lastX, y - lastY))
            }
            if (kept < MOST_KEPT) {
                if (kept == ends.size) ends = ends.copyOf(2 * kept)
                ends[kept++] = seconds
            }
        }
        last = seconds
        lastX = x
        lastY = y
    }

    /** Whether a gap lies between readings of the times [before] and [after], s. */
    fun between(before: Double, after: Double): Boolean {
        // The first gap that ends after [before].
        val found = ends.binarySearch(before, 0, kept)
        val next = if (found >= 0) found + 1 else -found - 1
        return next < kept && ends[next] <= after
    }

    private companion object {
        const val MOST_KEPT = 1 shl 16
    }
}
