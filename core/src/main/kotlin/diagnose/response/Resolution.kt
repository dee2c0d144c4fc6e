package stillwater.diagnose.response

import kotlin.math.abs
import kotlin.math.max
import kotlin.math.pow
import kotlin.math.round

/** The step to which a column of a log was rounded. */
internal object Resolution {
    /** Part of a step by which the mean of all differs from the smallest for arithmetic alone. */
    private const val SAME = 1e-6

    /** Part of a step by which a difference may be off a multiple of it. */
    private const val OFF = 0.02

    /** Share of the differences, or of the values, that must be where steps have them: some may be wild. */
    private const val MOST = 0.99

    /** Decimals that values may have been written with. */
    private const val DECIMALS = 9

    /** Units of the last decimal that a step needs at least, so that one step and two are not mixed up. */
    private const val LEAST_UNITS = 4.0

    /** The same by which two gaps of one step each may differ, rounded at both ends, and what arithmetic adds. */
    private const val UNITS_APART = 2.5

    /** The same that a value may be off its step: half of one, and what the step itself is off. */
    private const val UNITS_OFF = 0.6

    /** Different values that say the step beyond chance, of which at most 1.2 in 4 are near one: 0.3^8 is 7e-5. */
    private const val LEAST_VALUES = 10

    /**
     * The largest step of which all differences of [values] are multiples, or 0; to what the log's own digits leave of
     * it. From the lowest to the highest value these say it far better than between two: 0.0962 written as 0.096 and 0.097.
     */
    fun of(values: DoubleArray): Double {
        val distinct = values.toSet().sorted()
        if (distinct.size < 3) return 0.0
        val gaps = DoubleArray(distinct.size - 1) { distinct[it + 1] - distinct[it] }
        val smallest = gaps.filter { it > 1e-12 * (abs(distinct.last()) + abs(distinct.first())) }.minOrNull()
            ?: return 0.0
        val fits = gaps.count { abs(it / smallest - round(it / smallest)) < OFF }
        if (fits < MOST * gaps.size) return writtenAgain(distinct, gaps, smallest)
        val mean = (distinct.last() - distinct.first()) / gaps.sumOf { round(it / smallest) }
        return if (abs(mean - smallest) < SAME * smallest) smallest else mean
    }

    /**
     * The step of a converter whose readings were then written with so few decimals that [gaps] between [distinct] values
     * are no multiples of the [smallest]; 0 for none. Steps of 0.0456 with three decimals are 0.045 and 0.046.
     */
    private fun writtenAgain(distinct: List<Double>, gaps: DoubleArray, smallest: Double): Double {
        val unit = unit(distinct) ?: return 0.0
        if (distinct.size < LEAST_VALUES || smallest < (LEAST_UNITS - 1) * unit) return 0.0
        val first = gaps.filter { it < smallest + UNITS_APART * unit }.average()
        if (first < LEAST_UNITS * unit) return 0.0
        val counts = DoubleArray(distinct.size)
        for (i in gaps.indices) counts[i + 1] = counts[i] + round(gaps[i] / first)
        val middle = counts.average()
        val level = distinct.average()
        val step = distinct.indices.sumOf { (counts[it] - middle) * (distinct[it] - level) } /
            counts.sumOf { (it - middle) * (it - middle) }
        val near = distinct.indices.count {
            abs(distinct[it] - level - step * (counts[it] - middle)) < UNITS_OFF * unit
        }
        return if (near >= MOST * distinct.size) step else 0.0
    }

    /** The unit of the last decimal that all of [values] have; null where they have more than are written. */
    private fun unit(values: List<Double>): Double? = (0..DECIMALS).map { 10.0.pow(it) }.firstOrNull { scale ->
        values.all { abs(it * scale - round(it * scale)) < max(1e-6, 1e-12 * abs(it * scale)) }
    }?.let { 1 / it }
}
