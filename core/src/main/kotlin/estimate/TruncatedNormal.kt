package stillwater.estimate

import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * Median and central 95 % of a normal distribution cut to a range: what is left of a belief about a value when the value
 * cannot lie beyond the range. A reusable buffer; no allocation.
 *
 * Where its mean lies outside and less than [LEAST_MASS] of it inside, what was measured contradicts the range and the
 * distribution is taken uncut.
 */
internal class TruncatedNormal {
    /** Lower end of the central 95 %. */
    var lower: Double = 0.0
        private set

    /** Half of the distribution lies below. */
    var median: Double = 0.0
        private set

    /** Upper end of the central 95 %. */
    var upper: Double = 0.0
        private set

    /** Cuts the normal distribution with [mean] and [deviation] (above 0) to [from]..[to]. */
    fun cut(mean: Double, deviation: Double, from: Double, to: Double) {
        val a = (from - mean) / deviation
        val b = (to - mean) / deviation
        if (a < -FAR && b > FAR) return uncut(mean, deviation)
        // In the upper tail differences of probabilities near 1 are lost: mirror.
        val mirrored = a > 0
        val low = cumulative(if (mirrored) -b else a)
        val mass = cumulative(if (mirrored) -a else b) - low
        val isInside = a <= 0 && b >= 0
        if (!isInside && !(mass > LEAST_MASS)) return uncut(mean, deviation)
        val sign = if (mirrored) -1 else 1
        val first = (mean + sign * deviation * quantile(low + TAIL * mass)).coerceIn(from, to)
        val last = (mean + sign * deviation * quantile(low + (1 - TAIL) * mass)).coerceIn(from, to)
        lower = if (mirrored) last else first
        upper = if (mirrored) first else last
        median = (mean + sign * deviation * quantile(low + mass / 2)).coerceIn(lower, upper)
    }

    private fun uncut(mean: Double, deviation: Double) {
        median = mean
        lower = mean - NORMAL * deviation
        upper = mean + NORMAL * deviation
    }

    companion object {
        /** 97.5 % quantile of the normal distribution. */
        const val NORMAL = 1.959963984540054

        /** Least part of the distribution that the range must hold. */
        const val LEAST_MASS = 1e-6
        private const val TAIL = 0.025

        /** Beyond so many deviations an end of the range does not show. */
        private const val FAR = 6.0
        private const val LOW_TAIL = 0.02425
        private val ROOT_TWO_PI = sqrt(2 * Math.PI)

        /**
         * The normal distribution's cumulative probability below [x]; relative error below 1e-6 for x in −8..8.
         *
         * Source: Abramowitz and Stegun 1964, 26.2.17, near the middle; the continued fraction 26.2.14 in the tails.
         */
        fun cumulative(x: Double): Double {
            val z = abs(x)
            val density = exp(-z * z / 2) / ROOT_TWO_PI
            val tail = if (z < 2.5) {
                // Series 26.2.11: erf-like, all terms positive.
                var term = z
                var sum = z
                var k = 1
                while (term > 1e-17 * sum && k < 200) {
                    term *= z * z / (2 * k + 1)
                    sum += term
                    k++
                }
                0.5 - density * sum
            } else {
                var fraction = z
                for (k in 40 downTo 1) fraction = z + k / fraction
                density / fraction
            }
            return if (x < 0) tail else 1 - tail
        }

        /**
         * The number below which the normal distribution has the probability [p], 0 < p < 1; relative error 1e-9.
         *
         * Source: Acklam 2003, An algorithm for computing the inverse normal cumulative distribution function.
         */
        fun quantile(p: Double): Double {
            if (p > 0.5) return -quantile(1 - p)
            if (p < LOW_TAIL) {
                val q = sqrt(-2 * ln(p.coerceAtLeast(Double.MIN_VALUE)))
                return (((((C[0] * q + C[1]) * q + C[2]) * q + C[3]) * q + C[4]) * q + C[5]) /
                    ((((D[0] * q + D[1]) * q + D[2]) * q + D[3]) * q + 1)
            }
            val q = p - 0.5
            val r = q * q
            return (((((A[0] * r + A[1]) * r + A[2]) * r + A[3]) * r + A[4]) * r + A[5]) * q /
                (((((B[0] * r + B[1]) * r + B[2]) * r + B[3]) * r + B[4]) * r + 1)
        }

        private val A = doubleArrayOf(
            -3.969683028665376e+01,
            2.209460984245205e+02,
            -2.759285104469687e+02,
            1.383577518672690e+02,
            -3.066479806614716e+01,
            2.506628277459239e+00,
        )
        private val B = doubleArrayOf(
            -5.447609879822406e+01,
            1.615858368580409e+02,
            -1.556989798598866e+02,
            6.680131188771972e+01,
            -1.328068155288572e+01,
        )
        private val C = doubleArrayOf(
            -7.784894002430293e-03,
            -3.223964580411365e-01,
            -2.400758277161838e+00,
            -2.549732539343734e+00,
            4.374664141464968e+00,
            2.938163982698783e+00,
        )
        private val D = doubleArrayOf(
            7.784695709041462e-03,
            3.224671290700398e-01,
            2.445134137142996e+00,
            3.754408661907416e+00,
        )
    }
}
