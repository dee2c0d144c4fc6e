package stillwater.diagnose.evidence

import org.hipparchus.special.Erf
import org.hipparchus.special.Gamma
import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * Noise that is the sum of a normal number and of Student's t: what wanders is normal, what comes anew with each reading
 * has tails. Its scale is that of the normal number with as much in the middle: √([share] t² + (1 − [share]) n²).
 *
 * t is a normal number over √(χ²/ν), so that the sum is normal for each χ²: a mean over these, by the logarithm of χ².
 *
 * @property freedom ν, degrees of freedom of t. @property share part of the square that is t's, within 0..1.
 */
internal data class TailedNoise(val freedom: Int, val share: Double) {
    private val spreads = DoubleArray(NODES)
    private val weights = DoubleArray(NODES)

    /** The logarithm of t's density at 0 over that of a normal number. */
    private val highest =
        ln(exp(Gamma.logGamma((freedom + 1) / 2.0) - Gamma.logGamma(freedom / 2.0)) * sqrt(2.0 / freedom))

    init {
        // Where the density of the logarithm y of χ², e^(νy/2 − e^y/2), is more than e^−REACH of its highest.
        val top = ln(freedom.toDouble())
        val width = REACH / sqrt(freedom.toDouble())
        for (k in 0 until NODES) {
            val y = top - width + (width + UPWARD) * (k + 0.5) / NODES
            weights[k] = exp(freedom * (y - top) / 2 - (exp(y) - freedom) / 2)
            spreads[k] = sqrt(1 - share + share * freedom / exp(y))
        }
        val sum = weights.sum()
        for (k in 0 until NODES) weights[k] /= sum
    }

    /** The logarithm of the density at [z] over that of a normal number at 0. */
    fun logDensity(z: Double): Double {
        if (share == 1.0) return highest - (freedom + 1) / 2.0 * ln(1 + z * z / freedom)
        var sum = 0.0
        for (k in 0 until NODES) {
            val scaled = z / spreads[k]
            sum += weights[k] / spreads[k] * exp(-scaled * scaled / 2)
        }
        return ln(maxOf(sum, TINY))
    }

    /** The share of such numbers that is farther from 0 than [limit], either way. */
    fun beyond(limit: Double): Double = when {
        !limit.isFinite() -> 1.0
        share == 1.0 -> Evidence.student(limit, freedom)
        else -> (0 until NODES).sumOf { weights[it] * Erf.erfc(limit / spreads[it] / sqrt(2.0)) }
    }

    private companion object {
        const val NODES = 32
        const val REACH = 14.0
        const val UPWARD = 2.0
        const val TINY = 1e-300
    }
}
