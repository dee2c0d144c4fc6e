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

    private val courses = HashMap<Leg, LegCourse>()

    /** Prepares for [of] of [legs]. */
    fun follow(legs: List<Leg>) {
        for (leg in legs) courses[leg] = LegCourse(track, leg, bins, ::bin)
    }

    /**
     * Mean reading of [leg], one of those [follow]ed, in each bin, NaN where it has none, if every reading is put where
     * the boat was [lag] s before its time. Readings from shortly after the leg (before it, for a negative lag) so come
     * to lie on it, and some of its own no longer do.
     */
    fun of(leg: Leg, lag: Double): DoubleArray {
        // The last takes what lies in no bin.
        val sums = DoubleArray(bins + 1)
        val counts = IntArray(bins + 1)
        courses.getValue(leg).add(lag, sums, counts)
        return DoubleArray(bins) { if (counts[it] == 0) Double.NaN else sums[it] / counts[it] }
    }

    /** The bin in which the boat was at [seconds], between [point] and the next; below 0 and from [bins] on is none. */
    private fun bin(point: Int, seconds: Double): Int {
        val times = track.times
        val span = times[point + 1] - times[point]
        val share = if (span > 0) (seconds - times[point]) / span else 0.0
        val place = along[point] + (along[point + 1] - along[point]) * share
        val bin = (place - origin) / binWidth
        // From 0 on cutting off is the floor.
        return if (bin < 0) -1 else bin.toInt()
    }
}
