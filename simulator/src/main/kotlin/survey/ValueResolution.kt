package stillwater.survey

import java.math.BigDecimal
import kotlin.math.abs
import kotlin.math.roundToLong

/** The step in which a sensor or its log rounds its values. */
internal object ValueResolution {
    private const val FEWEST_STEPS = 3
    private const val ON_THE_STEP = 0.98
    private const val TOLERANCE = 0.05
    private const val DIGITS = 1e-9

    /**
     * The step of which (nearly) all differences between [values] are multiples, sensor units; NaN where there is none
     * or there are too few different values to tell.
     */
    fun of(values: DoubleArray): Double {
        val sorted = values.copyOf().apply { sort() }
        if (sorted.isEmpty()) return Double.NaN
        val smallest = maxOf(abs(sorted.first()), abs(sorted.last())) * DIGITS
        val steps = steps(sorted, smallest)
        if (steps.size < FEWEST_STEPS) return Double.NaN
        val step = steps.first()
        val matching = steps.count { gap ->
            val multiple = gap / step
            abs(multiple - multiple.roundToLong()) <= TOLERANCE
        }
        // Distinct values that lie as close as those of a continuous quantity would are no grid.
        val places = (sorted.last() - sorted.first()) / step
        val isGrid = matching >= ON_THE_STEP * steps.size && places <= steps.size * MOST_PLACES_A_VALUE
        // Rounding noise goes: 0.010000000000000009 is 0.01.
        return if (isGrid) "%.6g".format(java.util.Locale.ROOT, step).toDouble() else Double.NaN
    }

    /** Differences of neighbours in [sorted] above [smallest], ascending. */
    private fun steps(sorted: DoubleArray, smallest: Double): DoubleArray {
        val steps = DoubleArray(sorted.size)
        var count = 0
        for (i in 1 until sorted.size) {
            val step = sorted[i] - sorted[i - 1]
            if (step > smallest) steps[count++] = step
        }
        return steps.copyOf(count).apply { sort() }
    }

    /**
     * As [of]; and of values too few for that, which 8.25 and 8.5 alone are, whose step may be 0.25 or 0.01: the place
     * of the last digit that is not 0, at most 1. 0 where no step is to be seen.
     */
    fun atLeast(values: DoubleArray): Double {
        val step = of(values)
        if (step.isFinite()) return step
        val few = HashSet<Double>()
        for (value in values) if (few.add(value) && few.size > FEWEST_STEPS) return 0.0
        val digits = few.maxOfOrNull { BigDecimal.valueOf(it).stripTrailingZeros().scale() } ?: return 0.0
        return BigDecimal.ONE.scaleByPowerOfTen(-maxOf(0, digits)).toDouble()
    }

    private const val MOST_PLACES_A_VALUE = 1000.0
}
