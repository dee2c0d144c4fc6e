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
        val begin = track.times[leg.first]
        val end = track.times[leg.last]
        var i = leg.first
        while (i > 0 && track.times[i - 1] - lag >= begin) i--
        var cursor = leg.first
        while (i < track.size) {
            val seconds = track.times[i] - lag
            if (seconds > end) break
            if (seconds >= begin) {
                while (cursor < leg.last - 1 && track.times[cursor + 1] < seconds) cursor++
                count(place(cursor, seconds), track.values[i], sums, counts)
            }
            i++
        }
        return DoubleArray(bins) { if (counts[it] == 0) Double.NaN else sums[it] / counts[it] }
    }

    private fun count(place: Double, value: Double, sums: DoubleArray, counts: IntArray) {
        val share = (place - origin) / binWidth
        // From 0 on cutting off is the floor, which the first compiler, that of the launcher, has no instruction for.
        if (share < 0) return
        val bin = share.toInt()
        if (bin >= bins) return
        sums[bin] += value
        counts[bin]++
    }

    private fun place(cursor: Int, seconds: Double): Double {
        val span = track.times[cursor + 1] - track.times[cursor]
        val share = if (span > 0) (seconds - track.times[cursor]) / span else 0.0
        return along[cursor] + (along[cursor + 1] - along[cursor]) * share
    }
}
