package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.ChannelLag
import stillwater.diagnose.algebra.squares
import stillwater.diagnose.all
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Term
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * Whether a log without a reference shows a lag at all, and whether it shows which: a time constant or a dead time.
 *
 * @property timeConstant the model with a lag alone. @param still the same in water that does not change, where water
 *   that does has taken so much that a wrong response may be in it; else null.
 */
internal class BlindLag(
    private val search: BlindSearch,
    val timeConstant: BlindState,
    private val still: BlindState? = null,
) {
    private val period = timeConstant.model.series.period

    /** The model of a sensor that follows at once. */
    val none: BlindState = settled(emptyList(), period / 50, null)

    /** The same with the noise that suits it. */
    private val suited by lazy { search.requieted(none) }

    /** The model with a dead time in place of the lag. */
    val deadTime: BlindState = search.loops.all(STARTS) { share ->
        settled(listOf(Term(Cause.DEAD_TIME)), period / 50, share * timeConstant.timeConstant)
    }.maxBy { it.score }.let { search.requieted(refined(it)) }.let { refined(it) }

    private fun settled(terms: List<Term>, tau: Double, delay: Double?, from: BlindState = timeConstant) =
        search.settled(
            terms,
            listOfNotNull(tau, 1.0, 0.0, 0.0, delay).toDoubleArray(),
            from.fit.design.noise,
            from.variances,
            before = from,
        )

    /** [state] with the dead time alone fitted, as far as it leads: the water must follow each step. */
    private fun refined(state: BlindState): BlindState {
        var best = state
        repeat(REFINEMENTS) {
            val next = search.improved(best, BooleanArray(state.numbers.size) { it >= ResponseModel.BASE }, STEPS)
            val gain = next.score - best.score
            if (gain > 0) best = next
            if (!(gain > BlindSearch.ENOUGH)) return best
        }
        return best
    }

    /** The model with a dead time beside the lag, or with the lag alone where that is not worth it. */
    val both: BlindState by lazy {
        // Of what both share the likelier kind alone has most of it; a lag alone may be far too long.
        val half = (if (deadTime.score > timeConstant.score) deadTime.numbers.last() else timeConstant.timeConstant) / 2
        val near = search.climbed(search.improved(settled(listOf(Term(Cause.DEAD_TIME)), half, half)))
        val best = listOfNotNull(near, still?.let(::parted)).maxBy { it.score }
        if ((best.score - timeConstant.score) / inflation > WORTH) best else timeConstant
    }

    /** The model with a dead time beside the lag, half of the lag each, begun on water that does not change, as [state]. */
    private fun parted(state: BlindState): BlindState {
        val half = state.timeConstant / 2
        val begun = settled(listOf(Term(Cause.DEAD_TIME)), half, half, state)
        return search.opened(search.fullySuited(begun))
    }

    /**
     * Whether neither a time constant nor a dead time alone will do: then what is at work beside a lag can be told.
     * All have noise of their own. Either alone is within the model with both, where the t of gains is half that of the
     * added number's own size.
     */
    val isNeitherAlone: Boolean by lazy {
        if (both === timeConstant) return@lazy false
        val better = search.suited(both)
        val worse = if (timeConstant.score > deadTime.score) timeConstant else deadTime
        (better.score - worse.score) / inflation > MUCH && BlindEvidence.between(worse, better) > SURE / 2
    }

    /** How late the readings are as a dead time, s, with the small lag that the model has besides, as [none] has it. */
    val delay: Double get() = deadTime.numbers.last() + deadTime.timeConstant

    /** How far [delay] may be off, s, as [BlindErrors] says it of a number. */
    private val delayError: Double get() {
        val state = deadTime
        val column = state.derivative(state.numbers.size - 1)
        val unlike = state.fit.unlike(column)
        val inflation = BlindEvidence.inflation(listOf(unlike), state.whitened)
        val error = sqrt(state.variance * inflation / maxOf(squares(unlike), 1e-300))
        return maxOf(BlindErrors.WIDER * error, Jackknife.of(state.fit, state.whitened, listOf(column)).error(0))
    }

    /** The highest score of all these; of both kinds together only where there is a lag at all. */
    val likeliest: Double get() = maxOf(timeConstant.score, deadTime.score, if (isSeen) both.score else none.score)

    /** How much more often than by the noise's model the log's stretches sway: what correlation inflates. */
    private val inflation: Double = run {
        val column = timeConstant.fit.unlike(timeConstant.derivative(ResponseModel.TIME_CONSTANT))
        BlindEvidence.inflation(listOf(column), timeConstant.whitened)
    }

    /** Twice the gain in log-likelihood of a lag of either kind, over [inflation]. */
    val seen: Double = (maxOf(timeConstant.score, deadTime.score) - none.score) / inflation

    /** The same of a time constant against a dead time. */
    val preference: Double = (timeConstant.score - deadTime.score) / inflation

    /** Whether stretches of the log agree that there is a lag, of the likelier kind: Student's t. */
    val sureness: Double =
        BlindEvidence.between(none, if (timeConstant.score > deadTime.score) timeConstant else deadTime)

    /** Whether the log cannot tell a time constant from a dead time. */
    fun isOpen(separation: Double): Boolean = isSeen && !isNeitherAlone &&
        (preference < separation || !isFarOrAgreed || isShared)

    /**
     * Whether [found], a model with more beside both kinds, whose numbers may be off by [errors], has no dead time and is
     * sure of its time constant: what made either kind likely was then what is in the model now.
     */
    fun isToldIn(found: BlindState, errors: DoubleArray): Boolean {
        val dead = found.model.slotOrNull(Term(Cause.DEAD_TIME)) ?: return false
        val most = found.numbers[dead] + BlindErrors.REACH * errors[dead]
        return most < period / 2 && BlindErrors.REACH * errors[ResponseModel.TIME_CONSTANT] < TOLD
    }

    /** Whether a lag alone is far likelier than a dead time alone, or stretches of the log agree that it is likelier. */
    private val isFarOrAgreed: Boolean by lazy {
        preference > FAR || BlindEvidence.between(deadTime, timeConstant) > SURE
    }

    /** Whether a dead time alone is far likelier than a lag alone, and stretches of the log agree. */
    val isDeadTime: Boolean by lazy { -preference > MUCH && BlindEvidence.between(timeConstant, deadTime) > SURE }

    /**
     * Whether some of the lag is rather a dead time, but stretches of the log do not agree about that: that a dead time
     * alone is less likely than a lag alone then says nothing of which it is. The lag alone is within the model with
     * both, where the t of gains is half that of the dead time's own size.
     */
    private val isShared: Boolean by lazy {
        both !== timeConstant && BlindEvidence.between(timeConstant, both) < SURE / 2
    }

    /** Whether the log shows a lag of either kind. */
    val isSeen: Boolean get() = seen > LAG_SEEN && sureness > SURE

    /**
     * Whether the log shows a lag as [other] has it, a response of another shape, with what correlation inflates there:
     * where the shape is wrong a lag alone may be no better than none. Its time constant must be many standard errors.
     */
    fun isSeenIn(other: BlindState, inflation: Double): Boolean =
        (other.score - suited.score) / inflation > MUCH &&
            1 / BlindErrors.of(search, other)[ResponseModel.TIME_CONSTANT] > SURE

    /**
     * The delay as that of the channel [name], with what steps that are held add to it, or take; none where the time constant,
     * whose logarithm may be off by [error], is anything from one to ten.
     */
    fun channel(name: String, error: Double): ChannelLag {
        if (!isSeen || 2 * BlindErrors.REACH * error > ln(ANY)) return ChannelLag(name, Double.NaN, Double.NaN)
        return ChannelLag(name, delay - deadTime.model.steps.lead * period, delayError)
    }

    companion object {
        /** Twice the gain in log-likelihood over inflation of a second number, at 0.01 %. */
        const val MUCH = 15.0

        /**
         * The same of which stretches are not asked: steep water may hold most of what tells the kinds apart, in few of
         * them. Of 30 simulated dead times two are behind a time constant, by 2 and 63 (234800 to 234829); Lac Hertel has
         * 99 for a time constant, where others find a dead time.
         */
        private const val FAR = 200.0
        private const val LAG_SEEN = 12.0

        /** How far the interval of a time constant that is sure reaches, on a logarithmic scale. */
        private const val TOLD = 0.2
        private const val WORTH = 4.0

        /** Student's t with 23 degrees of freedom, two-sided 1 %. */
        const val SURE = 2.8
        private const val STEPS = 6

        /** The ratio of the ends of a time constant's interval from which on the log does not tell how late readings are. */
        private const val ANY = 10.0
        private const val REFINEMENTS = 8
        private val STARTS = listOf(0.5, 1.0)
    }
}
