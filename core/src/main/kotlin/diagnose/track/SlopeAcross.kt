package stillwater.diagnose.track

import stillwater.diagnose.algebra.squares

/**
 * How steep a truth is across a track and how far such a slope reaches, from how it goes along the track, rows [step] m
 * apart.
 *
 * In water that is alike in all directions, whose values differ by 2γ(d), squared, at places d apart, slopes along the
 * line from one place to the other go together by γ''(d) and those across it by γ'(d)/d, which is the mean of γ'' from 0
 * to d: they reach farther. γ'' is seen along the track. Where γ'(d)/d first falls to zero it is taken to end; noise of
 * the truth, another at each row, is gone from it after two rows.
 */
internal class SlopeAcross(truth: DoubleArray, private val step: Double) {
    /** Mean square of the slope, squared sensor units/m². */
    val variance: Double

    /**
     * Independent pieces of the track: the degrees of freedom of [variance], rows over the sum of the squared
     * correlations of the slopes along it (Bartlett 1946).
     */
    val pieces: Int

    /** For each number of rows the mean product of two slopes across the way so far apart, squared sensor units/m². */
    private val products = ArrayList<Double>()

    init {
        // Jitter makes steps longer as well as shorter: the middle step stands for the way made.
        val slopes = DoubleArray(maxOf(truth.size - 1, 0)) { (truth[it + 1] - truth[it]) / maxOf(step, 1e-9) }
        variance = squares(slopes) / maxOf(slopes.size, 1)
        var sum = variance / 2
        var correlations = 1.0
        products += variance
        for (rows in 1..slopes.size / 2) {
            val product = product(slopes, rows)
            val across = (sum + product / 2) / rows
            if (!(across > 0)) break
            sum += product
            products += across
            correlations += 2 * (product / variance) * (product / variance)
        }
        pieces = (slopes.size / correlations).toInt()
    }

    /** How far apart, m, slopes across the way go together. */
    val reach: Double get() = step * (products.size - 1)

    /** Mean product of slopes across the way [distance] m apart, squared sensor units/m². */
    fun alike(distance: Double): Double {
        val at = distance / step
        val row = at.toInt()
        if (!(distance < reach)) return 0.0
        return products[row] + (at - row) * (products[row + 1] - products[row])
    }

    /** Mean product of two of [slopes] so many [rows] apart, of at most [MOST] of them. */
    private fun product(slopes: DoubleArray, rows: Int): Double {
        val stride = maxOf(slopes.size / MOST, 1)
        var sum = 0.0
        var count = 0
        for (i in 0 until slopes.size - rows step stride) {
            sum += slopes[i] * slopes[i + rows]
            count++
        }
        return sum / count
    }

    private companion object {
        /** Products that a mean needs at most: a long track is cheap. */
        const val MOST = 4000
    }
}
