package stillwater.estimate

import kotlin.math.abs

/**
 * Finds the slope ε that the bounded filter has to ignore, from a stretch of readings of a sensor at rest.
 *
 * The same median and slope windows as in the filter run over the stretch. At rest every slope but a common drift is
 * noise, so ε is a high quantile of |slope − median slope|. Source: the report, section 5: "epsilon can be
 * determined by analysing a small data set obtained from a sample run". Differs: the report names no statistic.
 *
 * A sensor that was not at rest gives a larger ε: fewer bounds, none of them wrong for that. Keeps one number for
 * each reading, at most [MAX_SLOPES]. Confined to one thread.
 *
 * @param medianWindow samples in the median window, as in [BoundedFilterSettings].
 * @param slopeWindow medians in the regression window, as in [BoundedFilterSettings].
 * @throws IllegalArgumentException if a window is out of its range.
 */
public class EpsilonCalibration(medianWindow: Int = 3, slopeWindow: Int = 5) {
    private val medians = MedianWindow(medianWindow)
    private val window = SlopeWindow(slopeWindow)
    private var kept = DoubleArray(FIRST_SIZE)

    /** Number of slopes seen since the start or the last [clear]; those beyond [MAX_SLOPES] are not counted. */
    public var slopes: Int = 0
        private set

    /** Takes the sample [value], sensor units, of the time [seconds], s. What is not finite is left out. */
    public fun add(seconds: Double, value: Double) {
        if (!(seconds + value).isFinite()) return
        medians.add(seconds, value)
        if (!medians.full) return
        window.add(medians.time, medians.median)
        if (!window.full || slopes == MAX_SLOPES) return
        if (slopes == kept.size) kept = kept.copyOf(minOf(2 * kept.size, MAX_SLOPES))
        kept[slopes++] = window.slope()
    }

    /** Empties the windows and keeps the slopes: for a gap in the readings. */
    public fun interrupt() {
        medians.clear()
        window.clear()
    }

    /** Forgets everything. */
    public fun clear() {
        interrupt()
        slopes = 0
    }

    /** Median of the slopes, the sensor's drift over the stretch, sensor units/s; NaN without any. */
    public fun drift(): Double = median(kept.copyOf(slopes).apply { sort() })

    /**
     * The [quantile] (0 to 1) of |slope − median slope|, sensor units/s; NaN without any slope.
     *
     * The order statistic at or above the quantile: with few slopes the largest. O(n log n).
     *
     * @throws IllegalArgumentException if [quantile] is out of its range.
     */
    public fun epsilon(quantile: Double = DEFAULT_QUANTILE): Double {
        require(quantile in 0.0..1.0) { "quantile ($quantile) must be in 0..1" }
        if (slopes == 0) return Double.NaN
        val sorted = kept.copyOf(slopes)
        sorted.sort()
        val middle = median(sorted)
        for (i in sorted.indices) sorted[i] = abs(sorted[i] - middle)
        sorted.sort()
        return sorted[kotlin.math.ceil(quantile * (slopes - 1)).toInt()]
    }

    private fun median(sorted: DoubleArray): Double = when {
        sorted.isEmpty() -> Double.NaN
        sorted.size % 2 == 1 -> sorted[sorted.size / 2]
        else -> (sorted[sorted.size / 2 - 1] + sorted[sorted.size / 2]) / 2
    }

    public companion object {
        /** The share of resting slopes that ε covers unless said otherwise. */
        public const val DEFAULT_QUANTILE: Double = 0.99

        /** The largest number of slopes kept. */
        public const val MAX_SLOPES: Int = 1 shl 17

        private const val FIRST_SIZE = 256
    }
}
