package stillwater.diagnose

import kotlin.math.exp

/**
 * Water along a track as a Gaussian process of one length and one time: of covariance exp(−d²/2ℓ² − Δt²/2T²) between
 * places d apart at times Δt apart.
 *
 * @param times of the rows, s. @param length ℓ, m. @param time T, s; infinite of water that stays.
 */
internal class SmoothWater(
    private val track: SmoothTrack,
    private val times: DoubleArray,
    private val length: Double,
    private val time: Double = Double.POSITIVE_INFINITY,
) {
    private val n = times.size

    /** The first columns of its pivoted Cholesky factor, [most] at most; of every [thin]-th row. */
    fun factor(most: Int, thin: Int = 1): PivotedCholesky =
        PivotedCholesky.of((n + thin - 1) / thin, 1.0, ENOUGH, most) { a, b -> alike(a * thin, b * thin) }

    private fun alike(a: Int, b: Int): Double {
        val dx = (track.x[a] - track.x[b]) / length
        val dy = (track.y[a] - track.y[b]) / length
        val dt = (times[a] - times[b]) / time
        return exp(-(dx * dx + dy * dy + dt * dt) / 2)
    }

    /**
     * Adds the slopes at each row of the water whose columns in a factor that ends in [ends] have [heights] to [east] and
     * to [north], in its units/m.
     */
    fun addSlopes(ends: PivotedCholesky.Ends, heights: DoubleArray, east: DoubleArray, north: DoubleArray) {
        val shares = ends.shares(heights)
        for (i in 0 until n) {
            for ((k, row) in ends.pivots.withIndex()) {
                val share = shares[k] * alike(i, row) / (length * length)
                east[i] -= share * (track.x[i] - track.x[row])
                north[i] -= share * (track.y[i] - track.y[row])
            }
        }
    }

    private companion object {
        const val ENOUGH = 1e-4
    }
}
