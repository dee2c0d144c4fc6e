package stillwater.estimate

import kotlin.math.exp
import kotlin.math.sqrt

/**
 * Mixtures of normal distributions, one for each of [size] readings, cut at a reading where it is known from one side.
 */
internal class NormalMixture(private val size: Int) {
    private class Part(
        val weights: DoubleArray,
        val means: DoubleArray,
        val deviations: DoubleArray,
        val sides: ByteArray,
    )

    private val parts = ArrayList<Part>()
    private val limits = DoubleArray(size)
    private val filled = IntArray(size)

    /** Adds a part to the mixture of [row]; [side] 1 if the truth is known to be above [limit], −1 below, else 0. */
    fun add(row: Int, weight: Double, mean: Double, variance: Double, side: Int, limit: Double) {
        if (filled[row] == parts.size) {
            parts += Part(DoubleArray(size), DoubleArray(size), DoubleArray(size), ByteArray(size))
        }
        val part = parts[filled[row]++]
        part.weights[row] = weight
        part.means[row] = mean
        part.deviations[row] = sqrt(variance)
        part.sides[row] = side.toByte()
        limits[row] = limit
    }

    /** Means and the quantiles at 2.5 and 97.5 %, into [track] from row [first] on. */
    fun write(track: CorrectedTrack, first: Int) {
        for (row in 0 until size) {
            track.lower[first + row] = quantile(row, TAIL)
            track.upper[first + row] = quantile(row, 1 - TAIL)
            track.values[first + row] = if (track.silent[first + row]) quantile(row, 0.5) else mean(row)
        }
    }

    private fun mean(row: Int): Double {
        var sum = 0.0
        for (k in 0 until filled[row]) sum += parts[k].weights[row] * parts[k].means[row]
        return sum
    }

    private fun quantile(row: Int, share: Double): Double {
        var low = Double.POSITIVE_INFINITY
        var high = Double.NEGATIVE_INFINITY
        for (k in 0 until filled[row]) {
            val reach = WIDE * parts[k].deviations[row]
            low = minOf(low, parts[k].means[row] - reach, if (parts[k].sides[row] == 0.toByte()) low else limits[row])
            high =
                maxOf(high, parts[k].means[row] + reach, if (parts[k].sides[row] == 0.toByte()) high else limits[row])
        }
        repeat(STEPS) {
            val middle = (low + high) / 2
            if (distribution(row, middle) < share) low = middle else high = middle
        }
        return (low + high) / 2
    }

    private fun distribution(row: Int, at: Double): Double {
        var sum = 0.0
        for (k in 0 until filled[row]) {
            val part = parts[k]
            val below = normal(at, part.means[row], part.deviations[row])
            val side = part.sides[row].toInt()
            val share = if (side == 0) {
                below
            } else {
                val cut = normal(limits[row], part.means[row], part.deviations[row])
                if (side > 0) above(below, cut) else below(below, cut)
            }
            sum += part.weights[row] * share
        }
        return sum
    }

    /** P(x ≤ a | x > limit); where the limit is far out in the tail all is at the limit. */
    private fun above(below: Double, cut: Double) =
        if (1 - cut < RARE) (if (below >= cut) 1.0 else 0.0) else ((below - cut) / (1 - cut)).coerceIn(0.0, 1.0)

    private fun below(below: Double, cut: Double) =
        if (cut < RARE) (if (below > cut) 1.0 else 0.0) else (below / cut).coerceIn(0.0, 1.0)

    private companion object {
        const val TAIL = 0.025
        const val WIDE = 6.0
        const val STEPS = 30
        const val RARE = 1e-9

        fun normal(at: Double, mean: Double, deviation: Double): Double =
            if (deviation <= 0) (if (at >= mean) 1.0 else 0.0) else (1 + erf((at - mean) / deviation / sqrt(2.0))) / 2

        /** Within 1.5e-7 (Abramowitz and Stegun 1964, 7.1.26): far finer than an interval's level need be. */
        fun erf(x: Double): Double {
            val t = 1 / (1 + 0.3275911 * kotlin.math.abs(x))
            val poly = t * (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429))))
            val positive = 1 - poly * exp(-x * x)
            return if (x < 0) -positive else positive
        }
    }
}
