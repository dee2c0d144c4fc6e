package stillwater.diagnose

import stillwater.diagnose.BlindAnswer.Companion.three
import kotlin.math.abs
import kotlin.math.hypot
import kotlin.math.sqrt

/**
 * What fixes that scatter about the boat's way do to a log without a reference: water told at the wrong places, so that
 * readings seem wrong by as much as what the sensor shows is steep there. A receiver whose error wanders is followed in
 * part, so that its scatter is larger than this.
 */
internal class FixScatter(
    private val series: MeasuredSeries,
    private val search: BlindSearch,
    private val last: BlindState,
) {
    private val n = series.size
    private val track = search.track

    /** Standard deviation of a fix about the way on either axis, m: the median distance is 1.18 of it. */
    private val scatter: Double =
        median(DoubleArray(n) { hypot(series.x[it] - track.x[it], series.y[it] - track.y[it]) }) / RAYLEIGH_MEDIAN

    /** Root mean square of how steep what the sensor shows is along the way, sensor units/m. */
    private val steepness: Double = sqrt(squares(last.modes.steepness(last.shown)) / n)

    /** What readings scatter by themselves, sensor units: third differences hold 20 times its square, and no water. */
    private val own: Double = run {
        val v = series.values
        val third = DoubleArray(maxOf(n - 3, 1)) { i ->
            if (i + 3 < n) abs(v[i + 3] - 3 * v[i + 2] + 3 * v[i + 1] - v[i]) else 0.0
        }
        maxOf(NORMAL_MEDIAN * median(third) / sqrt(THIRD), search.scales.resolution / sqrt(ROUNDING))
    }

    /** In words, where it is more than what readings scatter by themselves, and a part of what is left; null where not. */
    fun words(): String? {
        val error = scatter * steepness
        if (!(error > maxOf(own, PART * sqrt(last.variance)))) return null
        val times = if (own > 0) ", ${three(error / own)} times what readings scatter by themselves" else ""
        val by = "${three(scatter)} ${series.placeUnit}"
        return "The fixes scatter by $by about the boat's way, which in water as steep as here is ${three(error)} " +
            "sensor units$times: a small effect, or a response of another shape, may come of that alone."
    }

    private companion object {
        /** Of the deviation of what is left. */
        const val PART = 0.4
        const val RAYLEIGH_MEDIAN = 1.1774
        const val NORMAL_MEDIAN = 1.4826

        /** 1 + 3² + 3² + 1. */
        const val THIRD = 20.0

        /** Of a step squared, the variance of rounding to it. */
        const val ROUNDING = 12.0
    }
}
