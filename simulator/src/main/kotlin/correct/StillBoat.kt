package stillwater.correct

import stillwater.estimate.TrackSeries
import kotlin.math.hypot

/**
 * Whether a boat lay where it was, at a buoy or an anchor: its fixes then wander over water that changes with time, and
 * passes "through the same water" would teach a lag that is none.
 */
internal object StillBoat {
    /** Fixes of common receivers wander so far about the place over minutes, m. */
    private const val WANDER = 5.0
    private const val MOST = 0.95
    private const val LARGE = 0.9

    /** A boat that goes anywhere comes so many times as far in one of [STEPS] rows as in one. */
    private const val FARTHER = 2.0
    private val STEPS = listOf(7, 20, 50)

    /** Why [series], from fixes on the globe if [hasFixes], is that of a boat that lay still; null where it is not. */
    fun why(series: TrackSeries, hasFixes: Boolean): String? = when {
        isFlat(series.xs) && isFlat(series.ys) -> "the boat never moves"
        // Along a line, as casts on one axis are, nothing scatters.
        isFlat(series.ys) -> null
        hasFixes && isWithin(series) ->
            "the boat hardly moves: 95 % of its fixes lie within 5 m, as far as fixes wander"
        isJitter(series) -> "the boat hardly moves: it comes no farther in 50 rows than its positions scatter in one"
        else -> null
    }

    private fun isWithin(series: TrackSeries): Boolean {
        val x = series.xs.sorted()[series.size / 2]
        val y = series.ys.sorted()[series.size / 2]
        return quantile(DoubleArray(series.size) { hypot(series.xs[it] - x, series.ys[it] - y) }, MOST) < WANDER
    }

    private fun isJitter(series: TrackSeries): Boolean {
        if (series.size <= 2 * STEPS.last()) return false
        val one = distance(series, 1)
        // Rows that far apart are sailed, to and fro or from station to station: no fixes scatter so.
        if (one >= 2 * WANDER) return false
        return STEPS.all { distance(series, it) < FARTHER * one }
    }

    private fun distance(series: TrackSeries, rows: Int) = quantile(
        DoubleArray(series.size - rows) {
            hypot(series.xs[it + rows] - series.xs[it], series.ys[it + rows] - series.ys[it])
        },
        LARGE,
    )

    private fun quantile(numbers: DoubleArray, share: Double): Double {
        numbers.sort()
        return numbers[(share * (numbers.size - 1)).toInt()]
    }
}

/** Whether all of [numbers] are the same. */
internal fun isFlat(numbers: DoubleArray): Boolean = numbers.all { it == numbers[0] }
