package stillwater.correct

import stillwater.survey.Leg
import kotlin.math.sqrt

/**
 * How far successive passes of a transect, casts of a float say, differ at the same places: the root mean square over
 * even places between [from] and [to], where both passes have readings on either side.
 *
 * @param places coordinate along the transect at each reading, in the log's unit, length n. Not modified.
 * @param legs the passes, in the order of time. @param from lower end. @param to upper end, above [from].
 */
internal class PassDifference(
    private val places: DoubleArray,
    private val legs: List<Leg>,
    private val from: Double,
    private val to: Double,
) {
    /** The difference of [values], one a reading, over each pass in [firsts] and the next one; NaN where none meet. */
    fun of(values: DoubleArray, firsts: List<Int>): Double {
        var sum = 0.0
        var count = 0
        for (first in firsts) {
            val one = profile(legs[first], values)
            val other = profile(legs[first + 1], values)
            for (i in one.indices) {
                val difference = one[i] - other[i]
                if (difference.isNaN()) continue
                sum += difference * difference
                count++
            }
        }
        return if (count > 0) sqrt(sum / count) else Double.NaN
    }

    /** [values] at the even places, straight between the readings on either side. */
    private fun profile(leg: Leg, values: DoubleArray): DoubleArray {
        val rows = (leg.first..leg.last).sortedBy { places[it] }
        var k = 0
        return DoubleArray(PLACES + 1) { i ->
            val at = from + (to - from) * i / PLACES
            while (k < rows.size - 2 && places[rows[k + 1]] < at) k++
            val below = rows[k]
            val above = rows[k + 1]
            val span = places[above] - places[below]
            if (at < places[below] || at > places[above] || span == 0.0) return@DoubleArray Double.NaN
            values[below] + (at - places[below]) / span * (values[above] - values[below])
        }
    }

    private companion object {
        const val PLACES = 80
    }
}
