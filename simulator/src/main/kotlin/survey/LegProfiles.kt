package stillwater.survey

import kotlin.math.cos
import kotlin.math.floor
import kotlin.math.sin

/**
 * Means of the readings along a leg, in bins along the main axis that all legs share.
 *
 * @param track the track. Retained, not modified.
 * @param axis direction of the main axis, rad.
 * @property binWidth width of a bin, m, above 0.
 */
internal class LegProfiles(private val track: Track, axis: Double, val binWidth: Double, from: Double, to: Double) {
    private val origin = floor(from / binWidth) * binWidth
    private val along = DoubleArray(track.size) { track.xs[it] * cos(axis) + track.ys[it] * sin(axis) }

    /** Number of bins. */
    val bins: Int = floor((to - origin) / binWidth).toInt() + 1

    /**
     * Mean reading of [leg] in each bin, NaN where it has none, if every reading is put where the boat was [lag] s
     * before its time. Readings from shortly after the leg (before it, for a negative lag) so come to lie on it, and
     * some of its own no longer do.
     */
    fun of(leg: Leg, lag: Double): DoubleArray {
        val sums = DoubleArray(bins)
        val counts = IntArray(bins)
        // Asked for once: the first compiler, that of the launcher, asks each time.
        val times = track.times
        val values = track.values
        val size = track.size
        val begin = times[leg.first]
        val end = times[leg.last]
        val last = leg.last
        var i = leg.first
        while (i > 0 && times[i - 1] - lag >= begin) i--
        var cursor = leg.first
        while (i < size) {
            val seconds = times[i] - lag
            if (seconds > end) break
            if (seconds >= begin) {
                while (cursor < last - 1 && times[cursor + 1] < seconds) cursor++
                val share = (place(times, cursor, seconds) - origin) / binWidth
                // From 0 on cutting off is the floor, which that compiler has no instruction for.
                val bin = if (share < 0) bins else share.toInt()
                if (bin < bins) {
                    sums[bin] += values[i]
                    counts[bin]++
                }
            }
            i++
        }
        return DoubleArray(bins) { if (counts[it] == 0) Double.NaN else sums[it] / counts[it] }
    }

    private fun place(times: DoubleArray, cursor: Int, seconds: Double): Double {
        val span = times[cursor + 1] - times[cursor]
        val share = if (span > 0) (seconds - times[cursor]) / span else 0.0
        return along[cursor] + (along[cursor + 1] - along[cursor]) * share
    }
}
