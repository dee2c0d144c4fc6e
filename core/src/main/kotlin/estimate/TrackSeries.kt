package stillwater.estimate

/**
 * What one sensor said along a track, whole, for estimators that look back as well as ahead.
 *
 * @property times s, strictly growing, length n. Retained, not modified.
 * @property xs metres east, length n; or the only coordinate of a transect, in any unit. Retained, not modified.
 * @property ys metres north, length n. Retained, not modified.
 * @property values readings, sensor units, length n. Retained, not modified.
 * @throws IllegalArgumentException if the lengths differ, a number is not finite, or times do not grow.
 */
public class TrackSeries(
    public val times: DoubleArray,
    public val xs: DoubleArray,
    public val ys: DoubleArray,
    public val values: DoubleArray,
) {
    init {
        val lengths = listOf(times.size, xs.size, ys.size, values.size)
        require(lengths.distinct().size == 1) { "times, xs, ys and values ($lengths) must be of one length" }
        for (i in times.indices) {
            require(times[i].isFinite() && xs[i].isFinite() && ys[i].isFinite() && values[i].isFinite()) {
                "row $i (${times[i]} s, ${xs[i]}, ${ys[i]}, ${values[i]}) must be finite"
            }
            require(i == 0 || times[i] > times[i - 1]) {
                "times must grow, but row $i (${times[i]} s) follows ${times[i - 1]} s"
            }
        }
    }

    /** Number of readings. */
    public val size: Int get() = times.size

    /** Median time between readings, s; NaN for fewer than two. */
    public val medianStep: Double by lazy {
        val steps = DoubleArray(maxOf(0, size - 1)) { times[it + 1] - times[it] }.apply { sort() }
        if (steps.isEmpty()) Double.NaN else steps[steps.size / 2]
    }

    /** Silences longer than this end a stretch, s: five median steps. */
    public val gapLimit: Double get() = GAP_STEPS * medianStep

    /**
     * The same readings where the boat was when they were taken, if its receiver repeats a fix until it has a new one:
     * positions that repeat the one before are put on the straight way between the first rows of successive fixes. Left
     * as they are, they would be late and hide part of a sensor's delay.
     */
    public fun withFreshPositions(): TrackSeries {
        val freshXs = xs.copyOf()
        val freshYs = ys.copyOf()
        var fix = 0
        for (i in 1 until size) {
            if (xs[i] == xs[fix] && ys[i] == ys[fix]) continue
            // Over a gap the boat may have stood; how long nobody knows.
            val isNear = times[i] - times[i - 1] <= gapLimit
            for (row in fix + 1 until i) {
                if (!isNear) break
                val share = (times[row] - times[fix]) / (times[i] - times[fix])
                freshXs[row] = xs[fix] + share * (xs[i] - xs[fix])
                freshYs[row] = ys[fix] + share * (ys[i] - ys[fix])
            }
            fix = i
        }
        return TrackSeries(times, freshXs, freshYs, values)
    }

    private companion object {
        const val GAP_STEPS = 5.0
    }
}
