package stillwater.estimate

import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * The sensors with two parameters that a [ResponseBank] can assume. Each contains the first-order lag.
 *
 * The first parameter is the logarithm of a time constant, s.
 *
 * @property lags lags in a row.
 * @property branches how many ways a visit can go: rising and falling, where they differ.
 * @property least smallest second parameter.
 * @property most largest second parameter.
 * @property flatness variance of the prior with which a visit's truth begins, over that of a cell's; see "Second order"
 *   in core/docs/SelfCalibratingEstimator.md.
 */
internal enum class ResponseBankKind(
    val lags: Int,
    val branches: Int,
    val least: Double,
    val most: Double,
    val flatness: Double = 1.0,
) {
    /** Second parameter: a = ln(τ rising / τ falling); the first is the mean of their logarithms. */
    ASYMMETRIC(lags = 1, branches = 2, least = -4.0, most = 4.0),

    /** Second parameter: the dead time, s. */
    DEAD_TIME(lags = 1, branches = 1, least = 0.0, most = Double.MAX_VALUE),

    /**
     * Two lags in a row; second parameter: p, the product of their time constants over the square of their sum T.
     * First: ln T + 0.9 ln 4p, because readings tell that better than ln T; below [STRAIGHT] on in a straight line.
     */
    SECOND_ORDER(lags = 2, branches = 1, least = 0.0, most = 0.25, flatness = 100.0),
    ;

    /** Logarithm of the time constant, s, or of its mean or sum. */
    fun logTime(first: Double, second: Double): Double = first - bend(second)

    /** The first parameter over [logTime]. */
    fun bend(second: Double): Double = when {
        this != SECOND_ORDER -> 0.0
        second >= STRAIGHT -> BEND * ln(second / EQUAL)
        else -> BEND * (ln(STRAIGHT / EQUAL) + (second - STRAIGHT) / STRAIGHT)
    }

    /** How [bend] changes with the second parameter. */
    fun shear(second: Double): Double = if (this == SECOND_ORDER) BEND / maxOf(second, STRAIGHT) else 0.0

    /** Time constant of the lag, or of the first of two, s. */
    fun timeConstant(first: Double, second: Double, branch: Int): Double = when (this) {
        ASYMMETRIC -> exp(first + if (branch == 0) second / 2 else -second / 2)
        DEAD_TIME -> exp(first)
        SECOND_ORDER -> (1 - shorter(second)) * exp(logTime(first, second))
    }

    /** Time constant of the second lag, s; 0 where there is none. */
    fun secondLag(first: Double, second: Double): Double =
        if (this == SECOND_ORDER) shorter(second) * exp(logTime(first, second)) else 0.0

    /** The dead time, s. */
    fun deadTime(second: Double): Double = if (this == DEAD_TIME) second else 0.0

    companion object {
        private const val BEND = 0.9
        private const val STRAIGHT = 0.08
        private const val EQUAL = 0.25

        /** The share that the shorter of two time constants has in their sum, from their [product] over its square. */
        fun shorter(product: Double): Double = (1 - sqrt(maxOf(0.0, 1 - 4 * product))) / 2
    }
}
