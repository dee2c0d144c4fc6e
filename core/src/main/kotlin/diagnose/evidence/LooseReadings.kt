package stillwater.diagnose.evidence

import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.SpikeSize
import kotlin.math.abs
import kotlin.math.sqrt

/** Single readings that the model of [fit] leaves far off, among all rows. */
internal class LooseReadings(private val fit: ModelFit) {
    private val series = fit.model.series
    private val sure = BeyondDoubt(fit)
    private val z = whitened(series.readRows())
    private val spread = sqrt(fit.variance)

    /** Half of this is what rounding alone may move a reading by. */
    private val resolution = fit.model.scales.resolution

    /** What sums lose in a log without noise. */
    private val least = ROUNDING * fit.model.scales.range

    /** Readings that are as far off as outliers, but are followed by others that are: sudden changes that last. */
    val lasting: List<Int>
    private val spikes: List<Int>
    private val mixture: Mixture

    /** Share of rows that stick out where nothing is wrong with any of them: more of noise with heavy tails. */
    private val beyond: Double

    /** Whether noise with heavy tails is about as likely as normal noise with single wrong readings, or likelier. */
    private val isTailed: Boolean

    init {
        // Noise may be larger at some values, speeds or times than at others: that is no outlier yet.
        LocalSpread.of(fit, z).forEachIndexed { i, factor -> z[i] /= factor }
        fun isFar(i: Int) = abs(fit.residuals[i]) > FARTHEST * spread + resolution / 2 + least
        val usual = usual()
        val sudden = z.indices.filter { abs(z[it]) > FARTHEST * usual }
        // What is foretold of the rows after a single wild reading is to come from those before it.
        val single = sudden.filter { isSingle(it) && isFar(it) }
        val others = series.readRows()
        single.forEach { others[it] = false }
        val beside = whitened(others)
        lasting = sudden.filterNot { isSingle(it) || (it > 0 && abs(z[it - 1]) > FARTHEST * usual && isSingle(it - 1)) }
            .filter { abs(beside[it]) > FARTHEST * usual }
        lasting.forEach { z[it] = 0.0 }
        // Rows in doubt say nothing: many that are as good as right would make all others look far off.
        val sure = z.indices.filterNot(::isInDoubt)
        val told = DoubleArray(sure.size) { z[sure[it]] }
        spikes = Spikes.of(told).map { sure[it] }.filter(::isFar)
        mixture = Spikes.ratio(told)
        val tails = Spikes.student(told, fit.noise)
        isTailed = tails.ratio > mixture.ratio - TAILED
        beyond = if (isTailed) maxOf(BEYOND, tails.beyond(Spikes.farthest(told))) else BEYOND
    }

    private fun isInDoubt(i: Int) =
        (fit.model.scales.isInDoubt(i) && i !in sure) || series.isRead?.get(i) == false

    /** Residuals over what is foretold of each from those of [rows] before it; 0 in rows in doubt and all others. */
    private fun whitened(rows: BooleanArray) = DoubleArray(series.size).also { out ->
        fit.noise.over(rows).whiten(fit.residuals, out)
        for (i in out.indices) if (isInDoubt(i)) out[i] = 0.0
    }

    /** Spread of the rows that are not in doubt. */
    private fun usual() = Spikes.spread(z.filter { it != 0.0 }.toDoubleArray())

    private fun isSingle(i: Int) = Spikes.isSingle(fit.residuals, i)

    /** Of there being sudden changes that last; those where the truth itself is sudden are none. */
    val lastingPValue: Double
        get() = if (LocalSpread.isConcentrated(fit, lasting)) 1.0 else tail(lasting.size, BEYOND)

    /** Of there being outliers, by their number or by the tails of all residuals, which coarse rounding shapes too. */
    val pValue: Double = tail(spikes.size + series.wild.size, beyond).let { lone ->
        val far = mixture.size > maxOf(FARTHEST * spread, least) && resolution < spread && !isTailed
        val found = if (far) minOf(lone, Evidence.pValue(mixture.ratio, 3)) else lone
        val usual = usual()
        if (LocalSpread.isConcentrated(fit, z.indices.filter { abs(z[it]) > TAIL * usual })) 1.0 else found
    }

    /** Of so many rows being far off by chance where a [share] of all is. */
    private fun tail(count: Int, share: Double) = Evidence.poissonTail(count, series.size * share)

    private fun off() = DoubleArray(series.size) { fit.residuals[it] + (series.wild[it] ?: 0.0) }

    /** How often and how far. */
    fun size(): SpikeSize =
        SpikeSize.of((spikes + series.wild.keys).sorted(), off(), spread) ?: SpikeSize(mixture.share, mixture.size)

    companion object {
        /** Deviations beyond which a reading is far off. */
        const val FARTHEST: Double = 4.5
        private const val BEYOND = 4e-5
        private const val ROUNDING = 1e-9

        /**
         * Twice a log-likelihood ratio that is no evidence. Of noises of 1100 rows, half normal and half with tails of five
         * degrees, one in seven is then taken for outliers, of outliers of 1.3 times the detectable size one in six for
         * tails; with 0 one in four and one in eight (120 of each; a script that is not in the repository).
         */
        private const val TAILED = 4.0

        /** Of these only one in two thousand is no outlier. */
        private const val TAIL = 3.5
    }
}
