package stillwater.estimate

import kotlin.math.PI
import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * A normal belief about a value that is then told to lie to one side of a bound, which is itself known to a deviation:
 * the normal distribution with the mean and the variance of what is left (moment matching, as for a censored reading).
 * A reusable buffer; no allocation.
 */
internal class OneSided {
    /** Mean of what is left. */
    var mean = 0.0
        private set

    /** Its variance, above 0 and at most the belief's. */
    var variance = 0.0
        private set

    /** Logarithm of the probability of lying to this side. */
    var logProbability = 0.0
        private set

    /**
     * The belief of [before] and [spread] (variance, above 0) told to lie above [bound], or below it if not [isAbove].
     *
     * @param looseness deviation of the bound, above 0.
     */
    fun tell(before: Double, spread: Double, bound: Double, isAbove: Boolean, looseness: Double) {
        val side = if (isAbove) 1 else -1
        val total = spread + looseness * looseness
        val u = side * (before - bound) / sqrt(total)
        val below = TruncatedNormal.cumulative(u)
        val isFar = u < FARTHEST
        // φ/Φ, which far out tends to −u.
        val hazard = if (isFar) -u - 1 / u else exp(-u * u / 2) / sqrt(2 * PI) / below
        logProbability = if (isFar) -u * u / 2 - ln(-u * sqrt(2 * PI)) else ln(below)
        mean = before + side * spread / sqrt(total) * hazard
        variance = (spread - spread * spread / total * hazard * (hazard + u)).coerceIn(spread * LEAST, spread)
    }

    private companion object {
        const val FARTHEST = -30.0
        const val LEAST = 1e-6
    }
}
