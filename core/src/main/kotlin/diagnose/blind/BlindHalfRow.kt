package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.all
import stillwater.diagnose.evidence.SmallShifts
import stillwater.diagnose.response.Steps
import stillwater.diagnose.response.Term
import kotlin.math.abs

/**
 * Whether the readings are half a row late, or ahead, because the truth is held over each row, asked before all causes are
 * weighed: a log that is sampled so shows it in the lag alone, and all that is found before that is known is for nothing.
 */
internal class BlindHalfRow(private val search: BlindSearch, private val base: BlindState) {
    /**
     * [base], a lag alone, with the truth held until the next row, from which on all that follows begins, where that is
     * clear; else null.
     */
    fun held(): BlindState? {
        if (search.steps.isHeld) return null
        val least = base.score + BlindLag.MUCH
        val held = search.copy().turned(base, Steps.UNTIL_NEXT, least) ?: return null
        val tries = BlindTrials(search, base)
        fun begun(term: Term) = search.improved(tries.begun(tries.attempt(term), base))
        val late = search.suited(begun(Term(Cause.DEAD_TIME)))
        // A delay that is free takes some of what waves that are missing do.
        val freedom = if (base.isResolved) BlindDiagnosis.ONE_NUMBER else BlindLag.MUCH
        if (late.score < least || !isHalfARow(late) || held.score < late.score - freedom) return null
        // Of those that shift readings another may explain more: an offset of place, where speeds differ.
        val others = BlindTerms.of(search, hasShape = true).filter { it.cause in RIVALS }
        val rivals = search.loops.all(others, ::begun).filter { it.score > held.score - FAR_BEHIND }
        val likeliest = search.loops.all(rivals, search::suited).maxOfOrNull { it.score } ?: held.score
        return if (held.score >= likeliest - BlindDiagnosis.ONE_NUMBER) search.begun(held) else null
    }

    /**
     * [base], a lag alone, with the truth going on evenly, where it was held over each row for a sensor that is as far ahead
     * of the boat as that goes in half a row, which is much likelier where speeds differ and in turns; else null.
     */
    fun ahead(): BlindState? {
        if (search.steps != Steps.HELD) return null
        val evenly = search.copy()
        val place = listOf(Term(Cause.POSITION_OFFSET))
        val numbers = evenly.model(place, base.modes, base.water).carried(base.model, base.numbers)
        val held = evenly.settled(place, numbers, base.fit.design.noise, base.variances, before = base)
        val even = evenly.stepped(held).takeIf { it !== held } ?: return null
        val onWay = evenly.fullySuited(even)
        val arm = evenly.onArm(onWay)
        val likeliest = maxOf(onWay.score, arm.score - evenly.anew(onWay, arm))
        if (likeliest < base.score + BlindLag.MUCH) return null
        return search.turned(base, Steps.EVEN, Double.NEGATIVE_INFINITY)
    }

    companion object {
        private val RIVALS = setOf(Cause.SECOND_ORDER_RESPONSE, Cause.POSITION_OFFSET)

        /** Twice the log-likelihood that noise of its own does not make up for. */
        private const val FAR_BEHIND = 300.0

        /** Whether [state] has a dead time of about half a row. */
        fun isHalfARow(state: BlindState): Boolean {
            val slot = state.model.slotOrNull(Term(Cause.DEAD_TIME)) ?: return false
            val rows = state.numbers[slot] / state.model.series.period
            return abs(rows + Steps.UNTIL_NEXT.lead) < SmallShifts.NEARLY
        }
    }
}
