package stillwater.diagnose

import kotlin.math.abs
import kotlin.math.sqrt

/** Single readings that the model of [fit] leaves far off, among all rows. */
internal class LooseReadings(private val fit: ModelFit) {
    private val series = fit.model.series
    private val z = DoubleArray(series.size).also { out ->
        val all = BooleanArray(series.size) { true }
        fit.noise.over(series.times, all).whiten(fit.residuals, out)
        fit.model.scales.unknown?.let { unknown -> for (i in out.indices) if (unknown.isInDoubt(i)) out[i] = 0.0 }
    }
    private val spread = sqrt(fit.variance)

    /** Half of this is what rounding alone may move a reading by. */
    private val resolution = fit.model.scales.resolution
    private val spikes = Spikes.of(z).filter {
        abs(fit.residuals[it]) > FARTHEST * spread + resolution / 2 && Spikes.isSingle(fit.residuals, it)
    }
    private val mixture = Spikes.ratio(z)

    /** Whether readings come back after most of what is far off: bubbles and knocks that fade are no outliers. */
    private val isMostlySingle: Boolean
        get() = z.indices.filter { abs(z[it]) > FARTHEST * spread }.let { far ->
            2 * far.count { Spikes.isSingle(fit.residuals, it) } >= far.size
        }

    /** Of there being outliers, by their number or by the tails of all residuals, which coarse rounding shapes too. */
    val pValue: Double = Evidence.poissonTail(spikes.size, series.size * BEYOND).let { lone ->
        val far = mixture.size > FARTHEST * spread && resolution < spread && isMostlySingle
        if (far) minOf(lone, Evidence.pValue(mixture.ratio, 3)) else lone
    }

    /** How often and how far. */
    fun size(): SpikeSize =
        SpikeSize.of(spikes, fit.residuals, spread) ?: SpikeSize(mixture.share, mixture.size)

    private companion object {
        const val BEYOND = 4e-5
        const val FARTHEST = 4.5
    }
}
