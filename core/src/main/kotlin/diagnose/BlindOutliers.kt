package stillwater.diagnose

import kotlin.math.abs
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
    private val residuals = state.residuals
    private val resolution = state.model.scales.resolution

    /** The rows that stick out: single ones, off their neighbours on both sides by more than rounding makes. */
    val rows: List<Int> =
        (Spikes.of(z) + sharp()).distinct().sorted().filter { it > 0 && it < residuals.size - 1 && isSingle(it) }

    /**
     * The rows that stick out of the readings themselves: a parabola through the rows beside them foretells them badly.
     * Fixes that jitter do no harm here.
     */
    private fun sharp(): List<Int> {
        val values = series.values
        val inside = REACH until values.size - REACH
        val off = DoubleArray(values.size) { if (it in inside) values[it] - Neighbours.foretold(values, it) else 0.0 }
        return inside.filter { i ->
            val about = (maxOf(REACH, i - NEAR)..minOf(values.size - 1 - REACH, i + NEAR)).filter { it != i }
            abs(off[i]) > FAR * NORMAL * median(DoubleArray(about.size) { abs(off[about[it]]) })
        }
    }

    /** After a jump the next reading stays; after an outlier it comes back. */
    private fun isSingle(i: Int): Boolean {
        val off = abs(residuals[i] - (residuals[i - 1] + residuals[i + 1]) / 2)
        return Spikes.isSingle(residuals, i) && off > STEPS * resolution && isAlone(i)
    }

    /** Whether reading [i] is off the line between its neighbours as none about it is: a sharp front is no outlier. */
    private fun isAlone(i: Int): Boolean {
        val values = series.values
        fun bend(k: Int) = abs(values[k] - (values[k - 1] + values[k + 1]) / 2)
        val about = (maxOf(1, i - WINDOW)..minOf(values.size - 2, i + WINDOW)).filter { abs(it - i) > 1 }
        return bend(i) > ALONE * median(DoubleArray(about.size) { bend(about[it]) })
    }

    /** Of there being as many: tails of other residuals say nothing, because water that is not resolved has them too. */
    val pValue: Double = Evidence.poissonTail(rows.size, series.size * BEYOND)

    /** How many and how far; null where there are none. */
    fun size(): SpikeSize? = SpikeSize.of(rows, residuals, spread)

    private companion object {
        /** Share of rows that stick out of their neighbours as far where the noise's tails are somewhat heavy. */
        const val BEYOND = 1.5e-4
        const val WINDOW = 12
        const val REACH = Neighbours.REACH
        const val NEAR = 30
        const val FAR = 5.0
        const val NORMAL = 1.4826

        /** Seven median bends are 4.7 normal standard deviations. */
        const val ALONE = 7.0
        const val STEPS = 4
    }
}
