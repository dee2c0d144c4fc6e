package stillwater.estimate

import kotlin.math.abs

/**
 * Finds the slope ε that the bounded filter has to ignore, from a stretch of readings of a sensor at rest.
 *
 * The same median and slope windows as in the filter run over the stretch. At rest every slope but a common drift is
 * noise, so ε is a high quantile of |slope − median slope|. Source: the report, section 5: "epsilon can be
 * determined by analysing a small data set obtained from a sample run". Differs: the report names no statistic.
 *
 * A stretch shorter than the flicker of a coarse sensor between two of its values gives 0, and every such flicker would
 * count as a slope: hold the result against [stepSlope].
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

        /**
         * The slope that a single step of the sensor's [resolution] makes, at the most, in the slope window: an ε below
         * it takes every flicker between two neighbouring values for a slope. Sensor units/s.
         *
         * One step of height q between the k-th and the next of n medians, Δ apart, has the least-squares slope
         * 6 k (n − k) q / (n (n² − 1) Δ), which is largest at k = n / 2: 0.3 q / Δ for n = 5. [MARGIN] is added, since a
         * step of the readings is seldom exactly [step] long and a slope counts when it is above ε.
         *
         * @param resolution step q in which values are rounded, sensor units, at least 0.
         * @param step usual time Δ between readings, s, above 0.
         * @param slopeWindow medians n in the regression window, as in [BoundedFilterSettings].
         * @throws IllegalArgumentException if a number is out of its range.
         */
        public fun stepSlope(resolution: Double, step: Double, slopeWindow: Int = 5): Double {
            require(resolution >= 0 && resolution.isFinite()) {
                "resolution ($resolution) must be at least 0 and finite"
            }
            require(step > 0 && step.isFinite()) { "step ($step s) must be above 0 s and finite" }
            require(slopeWindow >= 2) { "slopeWindow ($slopeWindow medians) must be at least 2" }
            val n = slopeWindow.toDouble()
            val k = (slopeWindow / 2).toDouble()
            return (1 + MARGIN) * 6 * k * (n - k) * resolution / (n * (n * n - 1) * step)
        }

        private const val MARGIN = 0.05
        private const val FIRST_SIZE = 256
    }
}
