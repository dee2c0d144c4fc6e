package stillwater.diagnose.response

import stillwater.diagnose.median
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * The noise of a reference, and the reference without most of it.
 *
 * The truth is taken as an integrated random walk, which makes its likeliest course the cubic smoothing spline; how
 * rough it is and how noisy the reference come from the likelihood of the reference alone. At breaks it starts anew.
 *
 * Source: Wecker and Ansley 1983, The signal extraction approach to nonlinear regression and spline smoothing, Journal
 * of the American Statistical Association 78.
 *
 * @param isBroken whether the truth starts anew at a row, length n.
 */
internal class ReferenceNoise(
    private val times: DoubleArray,
    private val reference: DoubleArray,
    private val isBroken: BooleanArray,
) {
    private val n = times.size
    private val period = median(DoubleArray(maxOf(n - 1, 0)) { times[it + 1] - times[it] })

    // Of each row: the state foretold and its covariance, then both after the row was seen; value, slope.
    private val foretold = Array(n) { DoubleArray(STATE) }
    private val known = Array(n) { DoubleArray(STATE) }
    private var squareSum = 0.0
    private val roughness = roughness()

    /** Standard deviation of the reference's noise, its own units. */
    val spread: Double

    init {
        filter(roughness)
        spread = sqrt(squareSum / maxOf(counted(), 1))
    }

    private fun counted() = n - FORGOTTEN * (1 + isBroken.count { it })

    /** The reference without most of its noise, its own units; Rauch, Tung and Striebel's smoother. */
    fun smoothed(): DoubleArray {
        filter(roughness)
        val out = DoubleArray(n)
        var value = known[n - 1][VALUE]
        var slope = known[n - 1][SLOPE]
        out[n - 1] = value
        for (i in n - 2 downTo 0) {
            val own = known[i]
            if (isBroken[i + 1]) {
                value = own[VALUE]
                slope = own[SLOPE]
            } else {
                val next = foretold[i + 1]
                val dt = times[i + 1] - times[i]
                val area = next[VV] * next[SS] - next[VS] * next[VS]
                // C = P Fᵀ (P⁻)⁻¹
                val vv = own[VV] + dt * own[VS]
                val sv = own[VS] + dt * own[SS]
                val a = (vv * next[SS] - own[VS] * next[VS]) / area
                val b = (own[VS] * next[VV] - vv * next[VS]) / area
                val c = (sv * next[SS] - own[SS] * next[VS]) / area
                val d = (own[SS] * next[VV] - sv * next[VS]) / area
                val above = value - next[VALUE]
                val steeper = slope - next[SLOPE]
                value = own[VALUE] + a * above + b * steeper
                slope = own[SLOPE] + c * above + d * steeper
            }
            out[i] = value
        }
        return out
    }

    /** The likeliest variance of the walk's steps over a row, in variances of the noise. */
    private fun roughness(): Double = ROUGHNESSES.maxBy { filter(it) }

    /** Runs the filter for a walk of [rough]; twice the log-likelihood, less a constant. */
    private fun filter(rough: Double): Double {
        val rate = rough / (period * period * period)
        squareSum = 0.0
        var logs = 0.0
        var since = 0
        for (i in 0 until n) {
            val now = foretold[i]
            val before = if (i > 0) known[i - 1] else now
            if (i == 0 || isBroken[i]) {
                now.fill(0.0)
                now[VALUE] = reference[i]
                now[VV] = UNKNOWN
                now[SS] = UNKNOWN / (period * period)
                since = 0
            } else {
                val dt = times[i] - times[i - 1]
                now[VALUE] = before[VALUE] + dt * before[SLOPE]
                now[SLOPE] = before[SLOPE]
                now[VV] = before[VV] + 2 * dt * before[VS] + dt * dt * before[SS] + rate * dt * dt * dt / 3
                now[VS] = before[VS] + dt * before[SS] + rate * dt * dt / 2
                now[SS] = before[SS] + rate * dt
            }
            val innovation = reference[i] - now[VALUE]
            val total = now[VV] + 1
            if (since++ >= FORGOTTEN) {
                squareSum += innovation * innovation / total
                logs += ln(total)
            }
            val after = known[i]
            val forValue = now[VV] / total
            val forSlope = now[VS] / total
            after[VALUE] = now[VALUE] + forValue * innovation
            after[SLOPE] = now[SLOPE] + forSlope * innovation
            after[VV] = now[VV] * (1 - forValue)
            after[VS] = now[VS] * (1 - forValue)
            after[SS] = now[SS] - forSlope * now[VS]
        }
        val count = maxOf(counted(), 1)
        return -count * ln(maxOf(squareSum, Double.MIN_VALUE) / count) - logs
    }

    private companion object {
        const val VALUE = 0
        const val SLOPE = 1
        const val VV = 2
        const val VS = 3
        const val SS = 4
        const val STATE = 5
        const val UNKNOWN = 1e6

        /** Rows that a walk of unknown start and slope takes to be foretold at all. */
        const val FORGOTTEN = 2
        val ROUGHNESSES = DoubleArray(19) { Math.pow(10.0, -5.0 + it / 2.0) }
    }
}
