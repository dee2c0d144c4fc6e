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
     * before its time. Readings that so come to lie before or after the leg are left out.
     */
    fun of(leg: Leg, lag: Double): DoubleArray {
        val sums = DoubleArray(bins)
        val counts = IntArray(bins)
        var cursor = leg.first
        // Readings shortly after the leg's end were taken from its water, hence the walk beyond it.
        var i = leg.first
        while (i < track.size) {
            val seconds = track.times[i] - lag
            if (seconds > track.times[leg.last]) break
            if (seconds >= track.times[leg.first]) {
                while (cursor < leg.last - 1 && track.times[cursor + 1] < seconds) cursor++
                count(place(cursor, seconds), track.values[i], sums, counts)
            }
            i++
        }
        if (lag < 0) before(leg, lag, sums, counts)
        return DoubleArray(bins) { if (counts[it] == 0) Double.NaN else sums[it] / counts[it] }
    }

    /** With a negative lag, readings from before the leg's first point belong to it as well. */
    private fun before(leg: Leg, lag: Double, sums: DoubleArray, counts: IntArray) {
        var i = leg.first - 1
        while (i >= 0) {
            val seconds = track.times[i] - lag
            if (seconds < track.times[leg.first]) break
            var cursor = leg.first
            while (cursor < leg.last - 1 && track.times[cursor + 1] < seconds) cursor++
            if (seconds <= track.times[leg.last]) count(place(cursor, seconds), track.values[i], sums, counts)
            i--
        }
    }

    private fun count(place: Double, value: Double, sums: DoubleArray, counts: IntArray) {
        val bin = floor((place - origin) / binWidth).toInt()
        if (bin !in 0 until bins) return
        sums[bin] += value
        counts[bin]++
    }

    private fun place(cursor: Int, seconds: Double): Double {
        val span = track.times[cursor + 1] - track.times[cursor]
        val share = if (span > 0) (seconds - track.times[cursor]) / span else 0.0
        return along[cursor] + (along[cursor + 1] - along[cursor]) * share
    }
}
