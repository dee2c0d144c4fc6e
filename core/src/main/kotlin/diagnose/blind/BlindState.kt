package stillwater.diagnose.blind

import stillwater.diagnose.algebra.squares
import stillwater.diagnose.evidence.AveragedNoise
import stillwater.diagnose.noise.CorrelatedNoise
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Term
import stillwater.diagnose.water.WaterModes
import kotlin.math.abs
import kotlin.math.ln

/**
 * A model of a log without a reference, with the water that suits it.
 *
 * @property model the sensor's model, whose truth is the water along the track. @property numbers its parameters.
 * @property fit the water's part. @property variances of the waves in each band over the noise's.
 * @property residuals readings less what the model shows, length n. @property left their square sum once the water has
 *   taken what it can. @param known how far other noises were behind, seen from this one's or from one before it.
 * @property lastGain twice the gain in log-likelihood by the last time that variances were fitted.
 */
internal class BlindState(
    val model: ResponseModel,
    val numbers: DoubleArray,
    val fit: BlindFit,
    val variances: DoubleArray,
    val residuals: DoubleArray,
    val left: Double,
    val modes: WaterModes,
    known: Map<NoiseStep, NoiseLoss>,
    val lastGain: Double,
) {
    /** Twice the log-likelihood, less a constant. */
    val score: Double = fit.score(left)

    /** The noise's variance, sensor units². */
    val variance: Double get() = left / fit.rows

    /** Residuals, whitened, without what the water takes. */
    val whitened: DoubleArray by lazy { fit.residual(residuals) }

    /** What the residuals say of an instrument that averages its readings; null for nothing. */
    val averaged: AveragedNoise? by lazy { model.series.let { AveragedNoise.of(whitened, it.values, it.times) } }

    /** What the model shows, sensor units, length n. */
    val shown: DoubleArray get() = DoubleArray(residuals.size) { model.series.values[it] - residuals[it] }

    /** What minus twice the log-likelihood has beside the square sum of residuals over their variance. */
    val spare: Double get() = fit.rows * ln(variance) + fit.design.noise.logDeterminant

    /**
     * Minus twice the log-likelihood of each whitened row where all others foretell it, less the logarithm of the noise's
     * variance, length n: with h the water's share in a row (leverage), the error of the forecast is 1/(1 − h) times what
     * is left, and its variance as many times the noise's.
     */
    val surprises: DoubleArray by lazy {
        val out = DoubleArray(whitened.size)
        val parts = (out.size + PART - 1) / PART
        fit.design.loops.each(parts) { part ->
            val from = part * PART
            val to = minOf(from + PART, out.size)
            val taken = DoubleArray(to - from)
            for (half in fit.halfRows(from, to)) for (i in taken.indices) taken[i] += half[i] * half[i]
            for (i in from until to) {
                val own = maxOf(1 - taken[i - from], LEAST_OWN)
                out[i] = whitened[i] * whitened[i] / (variance * own) - ln(own)
            }
        }
        out
    }

    @Volatile
    private var sure = emptyMap<String, Double>()

    /** How sure [term] is by [Jackknife], which [ask] tells where that was not asked before. */
    fun sure(term: Term, ask: () -> Double): Double = sure[term.key] ?: ask().also { sure = sure + (term.key to it) }

    /** The lag's time, s. */
    val timeConstant: Double get() = numbers[ResponseModel.TIME_CONSTANT]

    /** The water along the track, sensor units. */
    val water: DoubleArray get() = checkNotNull(model.series.reference)

    /** How the water rises to the east and to the north at each row, sensor units/m; null where the track is a line. */
    val gradient: Pair<DoubleArray, DoubleArray>? by lazy { modes.gradient(fit.heights) }

    /** Whether the finest waves are small, over the noise: where they are not, still finer ones may be there. */
    val isResolved: Boolean
        get() = modes.isWhole || (!modes.isCut && power(modes.bands - 1) < MOST_FINEST * variance)

    /** Mean square of what was found of process [band], sensor units². */
    fun power(band: Int): Double {
        val found = modes.along(DoubleArray(modes.size) { if (modes.band[it] == band) fit.heights[it] else 0.0 })
        return squares(found) / found.size
    }

    /** Length of the shortest wave that the water needs, m: shorter ones hold less than a tenth of the noise each. */
    val shortestNeeded: Double
        get() = modes.lengths.indices.filter { modes.lengths[it].isFinite() && power(it) > NEEDED * variance }
            .minOfOrNull { modes.lengths[it] } ?: modes.shortest

    /** The model as a fit, of which the numbers [free] were fitted. */
    fun asFit(free: BooleanArray) =
        ModelFit(model, numbers, free, fit.design.noise.noise, residuals, whitened, score)

    /** How fast what the model shows goes down with parameter [i] on the scale it is fitted on, length n. */
    fun derivative(i: Int): DoubleArray = BlindDescent.derivative(model, BlindDescent.apart(model, numbers), i)

    /** How far other noises were behind, for this or a state that it was found from. */
    var behind: Map<NoiseStep, NoiseLoss> = known
        private set

    /** Keeps that with [noise] in place of its own this is less likely, by [loss] in twice the log-likelihood. */
    fun learn(noise: CorrelatedNoise, loss: Double) {
        behind = behind + (step(noise) to NoiseLoss(loss, score))
    }

    /**
     * Whether [noise] in place of the own one was far behind, by more than has become likelier or less likely since:
     * a model that is as good as the one it was found from is no better under it.
     */
    fun isFarBehind(noise: CorrelatedNoise): Boolean {
        val then = behind[step(noise)] ?: return false
        return then.loss - abs(score - then.score) > FAR_BEHIND
    }

    private fun step(noise: CorrelatedNoise) =
        fit.design.noise.noise.let { NoiseStep(it.share, it.time, noise.share, noise.time) }

    /** Whether it was found that other numbers do not make this likelier. */
    var isAtEnd: Boolean = false

    private companion object {
        /** Rows that are done together: so many of all columns stay in the processor's cache. */
        const val PART = 128

        /** Share of a row of which the water foretells all, for rounding. */
        const val LEAST_OWN = 1e-6

        /** Twice the log-likelihood, below the noise at hand, that one cause or number does not turn round. */
        const val FAR_BEHIND = 100.0

        /** Mean square of the finest waves over the noise's, above which there must be finer ones. */
        const val MOST_FINEST = 10.0

        /** Mean square of waves over the noise's that the water is not without. */
        const val NEEDED = 0.1
    }
}

/** From noise of a [share] that wanders over [time] s to one [toShare] and [toTime]. */
internal data class NoiseStep(val share: Double, val time: Double, val toShare: Double, val toTime: Double)

/** A [loss] of twice the log-likelihood, of a state that had [score]. */
internal class NoiseLoss(val loss: Double, val score: Double)
