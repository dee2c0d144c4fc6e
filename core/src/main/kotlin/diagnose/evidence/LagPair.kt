package stillwater.diagnose.evidence

import stillwater.diagnose.Cause
import stillwater.diagnose.response.Fitting
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ResponseModel
import stillwater.model.Interval
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.ln

/**
 * Two lags in a row whose order does not show, of [fit]: its time constant and its number [second].
 *
 * Where both are alike, readings change with either in the same way and with their difference by its square only, so that
 * standard errors are far too wide: intervals reach to where the likelihood has fallen by what 95 % allows, the other
 * numbers fitted anew. The longer one stays the longer one.
 */
internal class LagPair private constructor(private val fit: ModelFit, val second: Int) {
    private val first = fit.numbers[ResponseModel.TIME_CONSTANT]
    private val middle = (first + fit.numbers[second]) / 2

    /** Whether number [i] is one of the two, and off by a factor of exp([reach]) on the other's side of [middle]. */
    fun isAlike(i: Int, reach: Double): Boolean = when {
        i != ResponseModel.TIME_CONSTANT && i != second -> false
        isLonger(i) -> fit.numbers[i] * exp(-reach) < middle
        else -> fit.numbers[i] * exp(reach) > middle
    }

    /** The 95 % interval of number [i], one of the two, by the [used] rows. */
    fun interval(i: Int, used: BooleanArray): Interval {
        val parameter = fit.model.parameters[i]
        return Interval(end(i, parameter.lower, used), end(i, parameter.upper, used))
    }

    /** Whether the second is the longer one. */
    val isTurned: Boolean get() = fit.numbers[second] > first

    /** Which of the model's numbers is told in the place of number [i], so that the longer lag is told first. */
    fun inOrder(i: Int): Int = when {
        !isTurned -> i
        i == second -> ResponseModel.TIME_CONSTANT
        i == ResponseModel.TIME_CONSTANT -> second
        else -> i
    }

    private fun isLonger(i: Int) = (i == second) == isTurned

    /** Where number [i] is as unlikely as 95 % allow, on the way to [limit]; at most [limit]. */
    private fun end(i: Int, limit: Double, used: BooleanArray): Double {
        val value = fit.numbers[i]
        val most = ln(limit / value)
        fun isLikely(step: Double) = fit.score - score(i, value * exp(step), used) < TWO_SIDED_95
        var inside = 0.0
        var outside = if (most < 0) -FIRST_STEP else FIRST_STEP
        while (abs(outside) < abs(most) && isLikely(outside)) {
            inside = outside
            outside *= 2
        }
        if (abs(outside) >= abs(most)) {
            if (isLikely(most)) return limit
            outside = most
        }
        repeat(HALVINGS) {
            val between = (inside + outside) / 2
            if (isLikely(between)) inside = between else outside = between
        }
        return value * exp(outside)
    }

    /** Score of the likeliest numbers with number [i] at [value], where it stays the longer or the shorter one. */
    private fun score(i: Int, value: Double, used: BooleanArray): Double {
        val other = if (i == second) ResponseModel.TIME_CONSTANT else second
        val isBeyond = if (isLonger(i)) value < middle else value > middle
        val free = fit.free.copyOf()
        val numbers = fit.numbers.copyOf()
        free[i] = false
        numbers[i] = value
        // The other takes up what this one leaves; beyond half of their sum it can only be the same.
        numbers[other] = if (isBeyond) value else maxOf(2 * middle - value, fit.model.parameters[other].lower)
        if (isBeyond) free[other] = false
        return Fitting.fit(fit.model, numbers, free, used, fit.noise.time, noise = fit.noise).score
    }

    companion object {
        /** The pair of [fit], where it has one. */
        fun of(fit: ModelFit): LagPair? {
            val terms = fit.model.terms
            val term = terms.firstOrNull { it.cause == Cause.SECOND_ORDER_RESPONSE } ?: return null
            val second = fit.model.slotOrNull(term) ?: return null
            val isPlain = terms.none { it.cause in LAG_CHANGES || it.isWithin }
            val isFree = fit.free[ResponseModel.TIME_CONSTANT] && fit.free[second]
            return if (isPlain && isFree) LagPair(fit, second) else null
        }

        /** What makes the first lag another one than the second. */
        private val LAG_CHANGES = setOf(
            Cause.ASYMMETRIC_RESPONSE,
            Cause.FLOW_DEPENDENT_RESPONSE,
            Cause.TEMPERATURE_DEPENDENT_RESPONSE,
            Cause.TWO_PATH_RESPONSE,
        )

        /** Chi-square with one degree of freedom at 95 %. */
        private const val TWO_SIDED_95 = 3.84
        private const val FIRST_STEP = 0.02
        private const val HALVINGS = 4
    }
}
