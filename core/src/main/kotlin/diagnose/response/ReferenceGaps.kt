package stillwater.diagnose.response

import stillwater.diagnose.algebra.Lagrange
import stillwater.diagnose.algebra.squares
import kotlin.math.abs
import kotlin.math.sqrt

/**
 * How well the truth is known between the rows of a reference that is sparser than the readings.
 *
 * Each row of the reference is foretold from two before and two after it (the cubic through them), and again with every
 * other row left out; the first error over the second says how fast it falls with the distance, and so what it is
 * within the gaps themselves. Readings see it through their lag, which evens it out.
 */
internal object ReferenceGaps {
    /**
     * How far what is not known of the truth may carry the fit of [base] as a whole, in standard deviations of its
     * noise.
     */
    fun reach(base: ModelFit): Double {
        val series = base.model.series
        val truth = series.reference ?: return 0.0
        val near = foretelling(series.times, truth, 1)
        val far = foretelling(series.times, truth, 2)
        if (near.isNaN() || far.isNaN() || !(near > 0)) return 0.0
        val within = near / (far / near).coerceIn(1.0, FASTEST)
        val tau = base.numbers[ResponseModel.TIME_CONSTANT]
        val evened = sqrt(minOf(1.0, series.period / (2 * tau)))
        val shown = abs(base.numbers[ResponseModel.GAIN]) * within * evened
        return shown / sqrt(maxOf(base.variance, Double.MIN_VALUE)) * sqrt(series.size.toDouble())
    }

    /** Root mean square of the error of foretelling each row from those [apart] and twice [apart] rows beside it. */
    private fun foretelling(times: DoubleArray, truth: DoubleArray, apart: Int): Double {
        val rows = times.size - 4 * apart
        if (rows <= 0) return Double.NaN
        return sqrt(squares(errors(times, truth, apart)) / rows)
    }

    /**
     * Size of the error of foretelling each row of [truth] at [times], s, from those [apart] and twice [apart] rows
     * beside it; 0 at the ends and where a step between them [isGap].
     */
    fun errors(times: DoubleArray, truth: DoubleArray, apart: Int, isGap: BooleanArray? = null): DoubleArray {
        val errors = DoubleArray(times.size)
        val from = IntArray(4)
        for (i in 2 * apart until times.size - 2 * apart) {
            if (isGap != null && (i - 2 * apart + 1..i + 2 * apart).any { isGap[it] }) continue
            from[0] = i - 2 * apart
            from[1] = i - apart
            from[2] = i + apart
            from[3] = i + 2 * apart
            errors[i] = abs(truth[i] - Lagrange.through(times, truth, from, times[i]))
        }
        return errors
    }

    /** Seven times smaller an error in a gap half as long: what a cubic's is for smooth water. */
    const val FASTEST = 7.0
}
