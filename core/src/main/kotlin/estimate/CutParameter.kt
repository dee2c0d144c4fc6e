package stillwater.estimate

import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.sqrt

/** A normally distributed parameter that lies between two ends for certain; eq. (16) of core/docs/SelfCalibratingEstimator.md. */
internal class CutParameter {
    /** Its mean. */
    var mean: Double = 0.0
        private set

    /** Its variance. */
    var variance: Double = 1.0
        private set

    /** Its mean where not the parameter is equally likely anywhere beforehand but the root of what it is below the upper end. */
    var meanByShare: Double = 0.0
        private set

    /**
     * Cuts a normal distribution with mean [place] and variance [spread] at [low] and [high]; answers false, and does
     * nothing, where that takes nothing away.
     */
    fun take(place: Double, spread: Double, low: Double, high: Double): Boolean {
        val deviation = sqrt(spread)
        if (place - low > CERTAIN * deviation && high - place > CERTAIN * deviation) return false
        val nearest = (place.coerceIn(low, high) - place) / deviation
        // Far out in its tail the normal density falls by e within a deviation over the distance in deviations.
        val reach = CERTAIN * deviation / if (abs(nearest) > CERTAIN) abs(nearest) else 1.0
        val from = maxOf(low, minOf(place, high) - reach)
        val end = minOf(high, maxOf(place, low) + reach)
        val width = (end - from) / PARTS
        var sum = 0.0
        var first = 0.0
        var second = 0.0
        var shares = 0.0
        var byShare = 0.0
        for (k in 0 until PARTS) {
            val x = from + (k + HALF) * width
            val off = (x - place) / deviation
            val weight = exp((nearest * nearest - off * off) / 2)
            sum += weight
            first += weight * x
            second += weight * x * x
            val share = weight * SHARES[k]
            shares += share
            byShare += share * x
        }
        mean = first / sum
        variance = maxOf(second / sum - mean * mean, width * width / 12)
        meanByShare = if (end == high) byShare / shares else mean
        return true
    }

    private companion object {
        /** Deviations from an end beyond which it takes nothing away. */
        const val CERTAIN = 5.0
        const val PARTS = 48
        const val HALF = 0.5

        /** The root of what is left to the upper end, which the last part touches: what of it lies in each part. */
        val SHARES = DoubleArray(PARTS) { sqrt((PARTS - it).toDouble()) - sqrt((PARTS - it - 1).toDouble()) }
    }
}
