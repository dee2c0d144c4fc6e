package stillwater.estimate

import kotlin.math.abs
import kotlin.math.sqrt

/**
 * At which readings the sensor rises, and at which it runs at its rate limit.
 *
 * @property rising length n. @property silent length n; never without a limit.
 */
internal class SensorSides(series: TrackSeries, response: Response, resolution: Double) {
    val rising: BooleanArray
    val silent: BooleanArray

    init {
        val reach = reach(series, response.slewRate, resolution)
        val slopes = slopes(series, reach)
        rising = BooleanArray(series.size) { slopes[it] > 0 }
        val running = BooleanArray(series.size) { abs(slopes[it]) > AT_LIMIT * response.slewRate }
        // A slope reaches over its neighbours: what touches a run may be at the limit, too.
        silent = BooleanArray(series.size) { i ->
            (maxOf(0, i - reach)..minOf(series.size - 1, i + reach)).any { running[it] }
        }
    }

    companion object {
        private const val AT_LIMIT = 0.85
        private const val FEWEST = 2
        private const val MOST = 8
        private const val NOISE_SHARE = 0.1
        private const val TOP = 0.995
        private const val NEAR = 0.1
        private const val BELOW = 0.3
        private const val FEWEST_SHARE = 0.04
        private const val TIMES_BELOW = 2.0
        private const val ABOVE_SHARE = 0.1
        private const val FEWEST_ROWS = 100
        private const val CLEAR = 0.05
        private val REACHES = listOf(2, 4, 8, 16)

        /** Slopes over so many rows either way that noise hardly bears on them. */
        private fun reach(series: TrackSeries, rate: Double, resolution: Double): Int {
            if (rate.isInfinite()) return FEWEST + 1
            val noise = roughness(series) + resolution / 2
            return (noise / (NOISE_SHARE * rate * series.medianStep)).toInt().coerceIn(1, MOST)
        }

        /** Standard deviation of what changes from one reading to the next but one, by its median. */
        private fun roughness(series: TrackSeries): Double {
            if (series.size < 3) return 0.0
            val seconds = DoubleArray(series.size - 2) {
                abs(series.values[it] - 2 * series.values[it + 1] + series.values[it + 2])
            }.apply { sort() }
            return seconds[seconds.size / 2] / (0.6745 * sqrt(6.0))
        }

        private fun slopes(series: TrackSeries, reach: Int) = DoubleArray(series.size) { i ->
            val from = maxOf(0, i - reach)
            val to = minOf(series.size - 1, i + reach)
            if (to == from) 0.0 else (series.values[to] - series.values[from]) / (series.times[to] - series.times[from])
        }

        /** See [rateLimit] of a series. */
        fun rateLimit(series: TrackSeries): Double {
            if (series.size < FEWEST_ROWS) return Double.NaN
            for (reach in REACHES) {
                val slopes = slopes(series, reach).map { abs(it) }.sorted()
                val top = slopes[(slopes.size * TOP).toInt().coerceAtMost(slopes.size - 1)]
                val noise = roughness(series) / (reach * series.medianStep)
                if (top > 0 && (noise < CLEAR * top || reach == REACHES.last())) return plateau(slopes, top)
            }
            return Double.NaN
        }

        private fun plateau(slopes: List<Double>, top: Double): Double {
            val at = slopes.filter { it in (1 - NEAR) * top..(1 + NEAR) * top }
            val below = slopes.count { it >= (1 - BELOW) * top && it < (1 - NEAR) * top }
            val above = slopes.count { it > (1 + NEAR) * top }
            val isPlateau = at.size >= FEWEST_SHARE * slopes.size && at.size >= TIMES_BELOW * below &&
                above <= ABOVE_SHARE * at.size
            return if (isPlateau) at[at.size / 2] else Double.NaN
        }
    }
}

/**
 * The rate at which the sensor of these readings often runs and which it hardly ever exceeds, sensor units/s; NaN
 * where there
 * is none. No lag and no water does that: slopes thin out towards their largest.
 */
public fun TrackSeries.rateLimit(): Double = SensorSides.rateLimit(this)
