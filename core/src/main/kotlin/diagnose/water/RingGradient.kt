package stillwater.diagnose.water

import stillwater.diagnose.algebra.Cholesky
import kotlin.math.sqrt

/**
 * The gradient of water that is a sum of the columns of [WaterRings]: such water is Σ cₚ k(|place − p|) over the places p
 * that were pivots, c the inverse of their covariance times what it is there, and so is what it is beside the track.
 *
 * @param x metres east. @param y metres north. @param pivots rows. @param step a distance within which the covariance
 *   hardly bends, m. @param covariance k, of a distance, m.
 */
internal class RingGradient(
    private val x: DoubleArray,
    private val y: DoubleArray,
    private val pivots: List<Int>,
    private val step: Double,
    private val covariance: (Double) -> Double,
) {
    private val factor by lazy {
        val along = DistanceCurve(step, covariance)
        Cholesky(Array(pivots.size) { a -> DoubleArray(a + 1) { b -> along.at(distance(pivots[a], pivots[b])) } })
    }

    /** k′(d)/d. */
    private val curve = DistanceCurve(step) { d ->
        if (d < step) {
            2 * (covariance(step) - covariance(0.0)) / (step * step)
        } else {
            (covariance(d + step) - covariance(d - step)) / (2 * step * d)
        }
    }

    /** How [water], such a sum along the track, rises to the east and to the north at each row, its units/m. */
    @Synchronized
    fun of(water: DoubleArray): Pair<DoubleArray, DoubleArray> {
        val heights = factor.back(factor.half(DoubleArray(pivots.size) { water[pivots[it]] }))
        val east = DoubleArray(x.size)
        val north = DoubleArray(x.size)
        for ((k, pivot) in pivots.withIndex()) {
            for (i in x.indices) {
                val slope = heights[k] * curve.at(distance(i, pivot))
                east[i] += slope * (x[i] - x[pivot])
                north[i] += slope * (y[i] - y[pivot])
            }
        }
        return east to north
    }

    private fun distance(a: Int, b: Int) = sqrt((x[a] - x[b]) * (x[a] - x[b]) + (y[a] - y[b]) * (y[a] - y[b]))
}
