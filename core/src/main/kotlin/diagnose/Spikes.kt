package stillwater.diagnose

import kotlin.math.abs

/** Single rows that stick out of their neighbours. */
internal object Spikes {
    private const val HALF_WINDOW = 3
    private const val TIMES_SPREAD = 5.5
    private const val NORMAL = 1.4826

    /**
     * The rows whose residual is more than 5.5 robust standard deviations off the median of the seven around it.
     *
     * A model that is wrong elsewhere has residuals that neighbours share; those are not single.
     */
    fun of(residuals: DoubleArray, resolution: Double): List<Int> {
        val n = residuals.size
        if (n < 4 * HALF_WINDOW) return emptyList()
        val off = DoubleArray(n) { i ->
            val from = (i - HALF_WINDOW).coerceIn(0, n - 1 - 2 * HALF_WINDOW)
            residuals[i] - median(residuals.copyOfRange(from, from + 2 * HALF_WINDOW + 1))
        }
        val spread = maxOf(NORMAL * median(DoubleArray(n) { abs(off[it]) }), resolution)
        return off.indices.filter { i ->
            val beside = maxOf(abs(off.getOrElse(i - 1) { 0.0 }), abs(off.getOrElse(i + 1) { 0.0 }))
            abs(off[i]) > TIMES_SPREAD * spread && beside < 0.8 * abs(off[i])
        }
    }
}
