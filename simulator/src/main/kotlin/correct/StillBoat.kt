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

    /**
     * Times after which a boat that goes anywhere is far from where it was, s, however often its place is written: ten rows a
     * second of a slow boat are less apart than its fixes scatter.
     */
    private val TIMES = listOf(60.0, 200.0)

    /** A boat swings so far about its anchor, m. */
    private const val SWING = 10.0

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

    private fun isWithin(series: TrackSeries): Boolean = radius(series) < WANDER

    /** How far from the middle 95 % of the places lie, m. */
    private fun radius(series: TrackSeries): Double {
        val x = series.xs.sorted()[series.size / 2]
        val y = series.ys.sorted()[series.size / 2]
        return quantile(DoubleArray(series.size) { hypot(series.xs[it] - x, series.ys[it] - y) }, MOST)
    }

    private fun isJitter(series: TrackSeries): Boolean {
        if (series.size <= 2 * STEPS.last()) return false
        val one = distance(series, 1)
        // Rows that far apart are sailed, to and fro or from station to station: no fixes scatter so.
        if (one >= 2 * WANDER) return false
        return STEPS.all { distance(series, it) < FARTHER * one } && !isSailed(series, one)
    }

    /** Whether the boat gets away from its places in a minute or three, farther than they scatter from row to row, [one]. */
    private fun isSailed(series: TrackSeries, one: Double) =
        radius(series) > SWING + one && TIMES.any { distanceAfter(series, it) > maxOf(FARTHER * one, SWING) }

    private fun distance(series: TrackSeries, rows: Int) = quantile(
        DoubleArray(series.size - rows) {
            hypot(series.xs[it + rows] - series.xs[it], series.ys[it + rows] - series.ys[it])
        },
        LARGE,
    )

    /** The same for the first rows that are [seconds] later; 0 where the log is too short for any. */
    private fun distanceAfter(series: TrackSeries, seconds: Double): Double {
        var later = 0
        val distances = (0 until series.size).mapNotNull { i ->
            while (later < series.size && series.times[later] < series.times[i] + seconds) later++
            if (later == series.size) null else hypot(series.xs[later] - series.xs[i], series.ys[later] - series.ys[i])
        }
        return if (distances.isEmpty()) 0.0 else quantile(distances.toDoubleArray(), LARGE)
    }

    private fun quantile(numbers: DoubleArray, share: Double): Double {
        numbers.sort()
        return numbers[(share * (numbers.size - 1)).toInt()]
    }
}

/** Whether all of [numbers] are the same. */
internal fun isFlat(numbers: DoubleArray): Boolean = numbers.all { it == numbers[0] }
