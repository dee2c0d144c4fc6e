package stillwater.diagnose

import kotlin.math.sqrt

/** Single readings that the model of [state] leaves far off, among all rows. */
internal class BlindOutliers(state: BlindState) {
    private val series = state.model.series
    private val noise = state.fit.design.noise
    private val spread = sqrt(state.variance)
    private val z = DoubleArray(series.size).also { out ->
        val all = BooleanArray(series.size) { true }
        BlindNoise(CorrelatedNoise(series.times, noise.noise.share, noise.noise.time, all), noise.spread)
            .whiten(state.residuals, out)
    }
    private val mixture = Spikes.ratio(z)
    private val residuals = state.residuals

    /** The rows that stick out. */
    val rows: List<Int> = Spikes.of(z)

    /** Of there being outliers, by their number or by the tails of all residuals. */
    val pValue: Double = Evidence.poissonTail(rows.size, series.size * BEYOND).let { lone ->
        if (mixture.size > FARTHEST * spread) minOf(lone, Evidence.pValue(mixture.ratio, DEGREES)) else lone
    }

    /** How many and how far. */
    fun size(): SpikeSize = SpikeSize.of(rows, residuals, spread) ?: SpikeSize(mixture.share, mixture.size)

    private companion object {
        /** Share of normal rows that stick out of their neighbours as far. */
        const val BEYOND = 4e-5
        const val FARTHEST = 4.5
        const val DEGREES = 3
    }
}
