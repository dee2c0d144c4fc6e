package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.evidence.Evidence
import stillwater.diagnose.evidence.SmallShifts
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Term
import kotlin.math.abs

/**
 * A cause tried on top of a model of a log without a reference, or a look at what no cause explains.
 *
 * @property term the cause; null for a look. @property name what was tried, in words. @property point its numbers; null
 *   for a look. @property model the model with it. @property change what it adds to the prediction, length n.
 * @property ratio twice the gain in log-likelihood over what the scores' correlation inflates it.
 * @property inflation that. @property degrees numbers added. @property chance the probability of [ratio] by chance, and
 *   of how stretches of the log agree about it. @property state the model with it where water and noise were fitted to it.
 *   @property sureness the ratio against water that does not change, where the trial is on such; else [ratio].
 */
internal class BlindTrial(
    val term: Term?,
    val name: String,
    val model: ResponseModel?,
    val point: BlindPoint?,
    val change: DoubleArray,
    val ratio: Double,
    val inflation: Double,
    val degrees: Int,
    val chance: Double,
    val state: BlindState? = null,
    val sureness: Double = ratio,
    private val halves: Double = 0.0,
    private val leftOut: Double = 0.0,
) {
    /** [chance], or that of what fits without each stretch of the log say, where that is larger. */
    val pValue: Double get() = sure(chance)

    /**
     * [pValue] where [chance] is [adjusted] for all that was tried: fits without stretches are asked of what was chosen.
     * What these say counts a fifth where [chance] is next to nothing: where one stretch has nearly all that is known of it
     * the others cannot agree as clearly.
     */
    fun sure(adjusted: Double): Double = maxOf(adjusted, if (chance < NEXT_TO_NOTHING) leftOut / EASED else leftOut)

    /** Whether the sensor is behind the fixes, which makes readings late as a lag of either kind does; none is ahead. */
    val isLate: Boolean
        get() {
            val place = term?.takeIf { it.cause == Cause.POSITION_OFFSET } ?: return false
            val (model, numbers) = state?.let { it.model to it.numbers } ?: (model to point?.numbers)
            return checkNotNull(SmallShifts.late(place, checkNotNull(model), checkNotNull(numbers))) > 0
        }

    /** Whether the two halves of the log contradict each other about the size of it, at 1 %. */
    val isContradicted: Boolean get() = abs(halves) > NORMAL_99

    /** The ratio less what as many meaningless numbers would gain on average, doubled as AIC does. */
    val worth: Double get() = ratio - 2 * degrees

    /** The same of [sureness]. */
    val surely: Double get() = sureness - 2 * degrees

    /** Twice the gain in log-likelihood, of which nothing was taken off. */
    val gain: Double get() = ratio * inflation

    /**
     * [worth] before inflation, by which causes are held against each other: how far each one's scores seem correlated
     * differs by chance.
     */
    val likelier: Double get() = gain - 2 * degrees

    /** This trial where it is on top of a model whose twice log-likelihood is higher by [score] than the base's. */
    fun instead(score: Double): BlindTrial = atMost(ratio + score / inflation)

    /** This trial, as sure as it is, where others are held against a model whose score is lower by [score]. */
    fun among(score: Double) = changed(ratio + score / inflation, chance)

    /** This trial where its p-value is too small by [times]. */
    fun lessSure(times: Double) = changed(ratio, minOf(1.0, times * chance))

    /** This trial where the model that it is on is less likely by [score] than the one that others are held against. */
    fun onLess(score: Double) = changed(ratio, chance, sureness = sureness + score / inflation)

    /** This trial, where fits without each stretch of the log have it by chance with the probability [pValue]. */
    fun leftOut(pValue: Double) = changed(ratio, chance, leftOut = pValue)

    /** This trial, of which fits without each stretch of the log say what they do of [other]. */
    fun leftOut(other: BlindTrial) = leftOut(other.leftOut)

    /** This trial, as sure as it is, in the model [other]. */
    fun beside(other: BlindState) = changed(ratio, chance, other)

    private fun changed(
        ratio: Double,
        chance: Double,
        state: BlindState? = this.state,
        sureness: Double = this.sureness,
        leftOut: Double = this.leftOut,
    ) = BlindTrial(
        term,
        name,
        model,
        point,
        change,
        ratio,
        inflation,
        degrees,
        chance,
        state,
        sureness,
        halves,
        leftOut,
    )

    /** This trial where its ratio is [most] at most. */
    fun atMost(most: Double): BlindTrial {
        val weaker = minOf(ratio, maxOf(most, 0.0))
        return changed(weaker, maxOf(chance, Evidence.pValue(weaker, degrees)), sureness = minOf(sureness, weaker))
    }

    private companion object {
        const val NORMAL_99 = 2.576

        /**
         * Of a cause or a look: the root of its likelihood ratio is 7 and more. In eight logs in the field without an effect
         * it was 4 to 6 (core/docs/Diagnosis.md (13)).
         */
        const val NEXT_TO_NOTHING = 1e-12
        const val EASED = 5.0
    }
}

/** [state] with the numbers of [trial], and the water for them. */
internal fun BlindSearch.with(state: BlindState, trial: BlindTrial): BlindState {
    val model = checkNotNull(trial.model)
    val numbers = checkNotNull(trial.point).numbers
    return settled(model.terms, numbers, state.fit.design.noise, state.variances, before = state)
}

/** [state] with the noise that suits it, and then the numbers that fit better. */
internal fun BlindSearch.suited(state: BlindState): BlindState = improved(requieted(state))

/** [state] with the numbers that fit better, the noise that suits these, and numbers again, each as long as that is likelier. */
internal fun BlindSearch.fullySuited(state: BlindState): BlindState = climbed(requieted(climbed(state)))
