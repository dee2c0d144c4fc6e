package stillwater.diagnose.blind

import stillwater.diagnose.water.WaterModes

/** How strong the waves of each band are, over the noise. */
internal object WaterVariances {
    /** MacKay's fixed point: what the waves of a band have been found to be over how well they are determined. */
    fun next(fit: BlindFit, left: Double, modes: WaterModes): DoubleArray {
        val squares = DoubleArray(modes.bands)
        val known = DoubleArray(modes.bands)
        val spreads = fit.spreads()
        val variance = left / fit.rows
        for (k in 0 until modes.size) {
            val band = modes.band[k]
            squares[band] += fit.heights[k] * fit.heights[k] / variance
            known[band] += (1 - fit.precisions[k] * spreads[k]).coerceIn(0.0, 1.0)
        }
        return DoubleArray(modes.bands) {
            val isOff = 1 / fit.precisions[modes.band.indexOf(it)] <= BlindSearch.LEAST && it > 0
            if (isOff) {
                BlindSearch.LEAST
            } else {
                (squares[it] / maxOf(known[it], 1e-6)).coerceIn(BlindSearch.LEAST, WaterModes.MOST)
            }
        }
    }
}
