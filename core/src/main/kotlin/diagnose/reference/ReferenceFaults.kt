package stillwater.diagnose.reference

import stillwater.diagnose.Cause
import stillwater.diagnose.evidence.HeldOutScore
import stillwater.diagnose.evidence.SmallShifts
import stillwater.diagnose.evidence.Spikes
import stillwater.diagnose.noise.CorrelatedNoise
import stillwater.diagnose.response.Fitting
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ReferenceLead
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Scales
import stillwater.diagnose.response.Steps
import stillwater.diagnose.response.Term
import stillwater.diagnose.response.UnknownTruth
import java.util.Locale
import kotlin.math.exp
import kotlin.math.expm1
import kotlin.math.ln

/**
 * What a reference can have, and no sensor: it is late, by its clock or by a lag of its own, which need not be longer
 * than the sensor's, or it shows more than the water at the sensor, for noise that neighbouring rows share or for water
 * that it sees elsewhere.
 *
 * @param base the model without causes. @param tried how many causes are tried in all.
 */
internal class ReferenceFaults(
    private val search: CauseSearch,
    private val base: ModelFit,
    baseHeldOut: HeldOutScore,
    private val used: BooleanArray,
    private val tried: Int,
    private val level: Double,
) {
    private val series = base.model.series
    private val late = search.attempt(base, baseHeldOut, Term(Cause.DEAD_TIME, isEitherWay = true), base)
    private val ahead = -late.fit.numbers[late.fit.model.slot(late.term)]

    /** Twice the log-likelihood with a reference that is late, less what that gains by chance. */
    val lateness: Double get() = late.fit.score - late.cost

    /** Whether the reference is late for certain, which explains as much as causes do that are worth [explained]. */
    fun isLate(explained: Double): Boolean =
        // How a log is sampled may do as much as a tenth of a row.
        ahead > SmallShifts.LEAST_ROWS * series.period && late.pValue * tried < level && late.foretells &&
            lateness >= explained

    /** Whether it is late by no more than an ordinary one may be. */
    private val isOrdinary get() = ahead < ReferenceLead.ordinary(base)

    /** Whether it is late for certain, and by more than that; of causes that are worth [explained] see [isLate]. */
    fun isFarLate(explained: Double): Boolean = isLate(explained) && !isOrdinary

    /** What is to be said of a reference that is late by so little, beside causes that are worth [explained]; else null. */
    fun caution(explained: Double): String? =
        ReferenceLead.words(ahead).takeIf { isOrdinary && isLate(explained) }?.let { "The reference differs: $it." }

    /**
     * How the reference differs if that explains as much as causes do that are worth [explained], of which a slow path
     * may be one, [isTwoPath]; null if not.
     */
    fun words(explained: Double, isTwoPath: Boolean): String? = when {
        isFarLate(explained) -> ReferenceLead.words(ahead)
        isTwoPath && slowest.second >= enough(explained, base.score) ->
            "part of the readings is there at once and the rest follows, as where the reference has a lag of its " +
                "own, of about %.2g s".format(Locale.ROOT, slowest.first)
        explained > base.score && smoothest() >= explained ->
            "the readings follow a smoother course than the reference's: it is noisy, or sees other water than " +
                "the sensor"
        else -> null
    }

    /**
     * The lag of a reference under which the readings are likeliest, s, and twice their log-likelihood then, less what
     * it gains by chance. A sensor of which part answers at once does the same.
     */
    private val slowest: Pair<Double, Double> by lazy {
        var step = ln(LONGEST_LAG / SHORTEST_LAG) / (LAGS - 1)
        val lags = List(LAGS) { SHORTEST_LAG * series.period * exp(it * step) }
        var best = lags.map { it to led(it) }.maxBy { it.second }
        repeat(REFINEMENTS) {
            step /= 2
            val beside = listOf(best.first * exp(step), best.first * exp(-step)).map { it to led(it) }
            best = (beside + best).maxBy { it.second }
        }
        best.first to best.second - CHANCE
    }

    /** Twice the log-likelihood of a truth that the reference follows with a lag of [lag] s. */
    private fun led(lag: Double): Double = listOf(Steps.EVEN, Steps.HELD).maxOf { between ->
        val lead = series.withQuieter(
            if (between.isHeld) steps(lag) else ReferenceLead.course(series, lag, base.model.scales.unknown?.isBroken),
        )
        val unknown = UnknownTruth.of(lead)
        val tau = base.numbers[ResponseModel.TIME_CONSTANT] +
            if (base.free[ResponseModel.TIME_CONSTANT]) lag else 0.0
        val spread = Spikes.spread(series.shown(base.whitened))
        val scales =
            Scales(
                lead,
                unknown,
                unknown.shocks(tau, base.numbers[ResponseModel.GAIN], spread, between.isHeld),
                lengthScale = base.model.scales.lengthScale,
            )
        val start = base.numbers.copyOf().also { it[ResponseModel.TIME_CONSTANT] = tau }
        val guess = CorrelatedNoise(series.times, base.noise.share, base.noise.time, used, scales.shocks)
        val model = ResponseModel(lead, base.model.terms, between, scales)
        Fitting.fit(model, start, base.free, used, search.longest, guess = guess).score
    }

    /** What stood still over each step while a sensor with a lag of [lag] s came to show the reference. */
    private fun steps(lag: Double): DoubleArray {
        val reference = requireNotNull(series.reference) { "faults of a reference need one" }
        return DoubleArray(reference.size) { i ->
            val follows = if (i == 0) 1.0 else -expm1(-(series.times[i] - series.times[i - 1]) / lag)
            if (i == 0) reference[0] else reference[i - 1] + (reference[i] - reference[i - 1]) / follows
        }
    }

    /** Twice the log-likelihood with the reference smoothed as much as serves best, less what that gains by chance. */
    private fun smoothest(): Double = WIDTHS.maxOf { width ->
        val smooth = series.withQuieter(smoothed(width * series.period))
        val scales = base.model.scales.of(smooth)
        val model = ResponseModel(smooth, base.model.terms, base.model.steps, scales)
        Fitting.fit(model, base.numbers, base.free, used, search.longest, guess = base.noise).score
    } - CHANCE

    /** The reference under a normal window of standard deviation [width], s; not across gaps. */
    private fun smoothed(width: Double): DoubleArray {
        val reference = requireNotNull(series.reference) { "faults of a reference need one" }
        val times = series.times
        val gap = GAP * series.period
        return DoubleArray(times.size) { i ->
            var weights = 1.0
            var sum = reference[i]
            for (way in intArrayOf(-1, 1)) {
                var k = i + way
                while (k in times.indices && !isBeyond(times, k, way, gap) &&
                    (times[k] - times[i]) * way < REACH * width
                ) {
                    val off = (times[k] - times[i]) / width
                    val weight = exp(-off * off / 2)
                    weights += weight
                    sum += weight * reference[k]
                    k += way
                }
            }
            sum / weights
        }
    }

    private fun isBeyond(times: DoubleArray, k: Int, way: Int, gap: Double) = (times[k] - times[k - way]) * way > gap

    companion object {
        /**
         * What a reference that is late need explain in the place of causes that are worth [explained], where the model
         * without either is worth [base]; twice log-likelihoods.
         */
        fun enough(explained: Double, base: Double): Double =
            explained - minOf(WITHIN_ROWS * (explained - base), FAR_LIKELIER)

        /** Of the windows, in rows. */
        private val WIDTHS = listOf(0.7, 1.5, 3.0, 6.0)
        private const val REACH = 3.0

        /** Of lags of the reference that are tried first, in rows. */
        private const val SHORTEST_LAG = 0.5
        private const val LONGEST_LAG = 32.0
        private const val LAGS = 7
        private const val REFINEMENTS = 4

        /** Of what causes explain: what the truth does within rows, which is not known, may make up so much. */
        private const val WITHIN_ROWS = 0.02

        /** Twice a log-likelihood ratio beyond which nothing makes up for it. */
        private const val FAR_LIKELIER = 30.0

        private const val GAP = 3.0

        /** Twice the log-likelihood that one number and the choice among the windows gain by chance. */
        private const val CHANCE = 4.0
    }
}
