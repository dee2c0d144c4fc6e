package stillwater.diagnosis

import kotlin.math.exp
import kotlin.math.sqrt

/**
 * Noise of which a part is correlated: cov(t, u) = σ² ((1 − a) δ(t, u) + a exp(−|t − u| / T)).
 *
 * @param spread σ, sensor units. @param share a, 0 to 1. @param time T, s, at least 0.
 */
internal class CorrelatedNoise(private val spread: Double, private val share: Double, private val time: Double) {
    /** Standard deviation of the mean of the noise at [times], s, in ascending order and at least one; sensor units. */
    fun ofMean(times: List<Double>): Double {
        // Σⱼ Σᵢ₍ᵢ<ⱼ₎ exp(−(tⱼ − tᵢ)/T): what row j has of those before it is what the row before had, and it, decayed.
        var before = 0.0
        var pairs = 0.0
        for (j in 1 until times.size) {
            before = (before + 1) * if (time > 0) exp((times[j - 1] - times[j]) / time) else 0.0
            pairs += before
        }
        val count = times.size.toDouble()
        // σ²/m² ((1 − a) m + a (m + 2 Σ))
        return spread * sqrt(count + 2 * share * pairs) / count
    }
}
