package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.DiagnosisSettings

/**
 * The causes that were found in a log without a reference.
 *
 * @property steps one for each, in the order in which they were added. @property ended all that was tried on top of the
 *   last; null where that was not.
 */
internal class BlindFound(val steps: List<BlindStep>, val ended: BlindRound?)

/**
 * Adds one cause after the other to a model of a log without a reference, for as long as one is sure.
 *
 * @param round tries all on top of a model.
 */
internal class BlindForward(
    private val search: BlindSearch,
    private val settings: DiagnosisSettings,
    private val round: (BlindState) -> BlindRound,
) {
    /** What is found on top of the model of [first]. */
    fun of(first: BlindRound): BlindFound = needed(exchanged(extended(BlindFound(emptyList(), first)), first))

    /** [found] with as many causes more as are sure. */
    private fun extended(found: BlindFound): BlindFound {
        val chosen = ArrayList(found.steps)
        var ended = found.ended
        while (chosen.size < settings.mostCauses) {
            val round = checkNotNull(ended)
            if (round.adjustedCauses.none { it < CAUSES * settings.level }) break
            // That something is there is told by the surest cause, which it is by the likeliest; rounding comes last, for
            // in readings that are rounded nothing else can be looked for.
            val sure = possible(round)
            val likeliest = sure.maxBy { it.likelier }
            val isRounding = likeliest.term?.cause == Cause.QUANTISATION
            val best = if (isRounding) beforeRounding(round) ?: likeliest else likeliest
            if (best.sureness < FURTHER * (chosen.maxOfOrNull { it.trial.sureness } ?: 0.0)) break
            // What no cause explains comes first where it is far ahead of all, or the stronger and stays: a cause would be
            // named for its shadow. A response that rings is like many others.
            val look = round.strongestLook
            val ahead = look?.let { ahead(round.looks[it], sure) } ?: Double.NEGATIVE_INFINITY
            val isShadow = ahead > settings.separation
            if (look != null && isShadow && ahead > BlindLag.MUCH && !round.look(look).ofWater) break
            val state = added(round.state, best)
            if (isCurved(round, best, state)) break
            val isLast = chosen.size + 1 == settings.mostCauses
            val next = if (isShadow || !isLast) round(state) else null
            if (isShadow && checkNotNull(next).strongestLook != null) break
            chosen += BlindStep(best, round, state)
            ended = next
        }
        return BlindFound(chosen, ended)
    }

    /**
     * How far [look] is ahead of all of [causes], against water that does not change, and as a model of the log: a cause
     * in water that changes, with which the log is likelier than with what no cause explains in still water, is not its
     * shadow.
     */
    private fun ahead(look: BlindTrial, causes: List<BlindTrial>): Double =
        minOf(look.surely - causes.maxOf { it.surely }, look.likelier - causes.maxOf { it.likelier })

    /** Whether a curved calibration is likelier than [best], an asymmetric response, with which [state] is. */
    private fun isCurved(round: BlindRound, best: BlindTrial, state: BlindState): Boolean =
        best.term?.cause == Cause.ASYMMETRIC_RESPONSE &&
            CurvedReadings(search, round.state).score > state.score + BlindDiagnosis.ONE_NUMBER

    /**
     * [found], or two causes that explain more: one may come nearest to what two do together, and so come before either.
     * That is asked where it is alone and leaves something.
     */
    private fun exchanged(found: BlindFound, first: BlindRound): BlindFound {
        val own = found.steps.singleOrNull() ?: return found
        val end = found.ended ?: return found
        val look = end.strongestLook?.let { end.looks[it] }
        if (look == null && end.adjustedCauses.none { it < settings.level }) return found
        // Two causes in place of one beside which something is left that no cause explains: that then is their shadow.
        val least = maxOf(look?.likelier ?: 0.0, settings.separation)
        val others = possible(first).filter { it !== own.trial && it.state != null }
            .sortedByDescending { it.likelier }.take(EXCHANGED)
        val instead = others.map { other ->
            val state = added(first.state, other)
            extended(BlindFound(listOf(BlindStep(other, first, state)), round(state)))
        }
        return instead.maxByOrNull(::worth)?.takeIf { worth(it) > worth(found) + least } ?: found
    }

    private fun worth(found: BlindFound) = found.steps.last().state.let { it.score - 2 * it.model.terms.size }

    /**
     * The causes of [round] that may be meant. Where something changed, for certain, others have water that changes beside
     * them, which makes up for it: they are no answer in place of a drift or a jump, unless they are as sure as a first one.
     */
    private fun possible(round: BlindRound): List<BlindTrial> {
        fun isFirst(i: Int) = round.adjustedCauses[i] < CAUSES * settings.level
        fun isSlow(trial: BlindTrial) = trial.term?.cause in BlindDiagnosis.SLOW
        val isChange = round.changing > settings.separation &&
            round.causes.indices.any { isFirst(it) && isSlow(round.causes[it]) }
        return round.causes.filterIndexed { i, trial ->
            trial.pValue < settings.level && (!isChange || isSlow(trial) || isFirst(i))
        }
    }

    /** The likeliest of the causes of [round] that are as sure as a first one must be, but rounding; null if none is. */
    private fun beforeRounding(round: BlindRound): BlindTrial? = round.causes.filterIndexed { i, trial ->
        trial.term?.cause != Cause.QUANTISATION && round.adjustedCauses[i] < CAUSES * settings.level
    }.maxByOrNull { it.likelier }

    /** [found] without what the others have made needless; what is left keeps its rounds. */
    private fun needed(found: BlindFound): BlindFound {
        val chosen = found.steps
        if (chosen.size < 2) return found
        val full = chosen.last().state
        for (i in 0 until chosen.size - 1) {
            val others = search.suited(search.without(chosen.first().round.state, chosen, i))
            val without = if (search.isStill(full)) search.still(others) else search.opened(others)
            val lost = (full.score - without.score) / chosen[i].trial.inflation
            if (lost > NEEDLESS) continue
            val rest = chosen.filterIndexed { k, _ -> k != i }
            val last = rest.last()
            return needed(BlindFound(rest.dropLast(1) + BlindStep(last.trial, last.round, without), round(without)))
        }
        return found
    }

    private fun added(state: BlindState, trial: BlindTrial): BlindState {
        val next = trial.state ?: search.improved(search.with(state, trial))
        val model = search.climbed(search.improved(search.evened(next)))
        // How steps are held shows only once the response is right.
        val stepped = search.stepped(model)
        return if (stepped === model) model else search.climbed(search.requieted(stepped))
    }

    private companion object {
        /**
         * The level of causes of the list over that of a first one, whose p-values are too small by less than those of
         * looks: of 260 simulated logs without an effect two have a cause between this and a tenth, of 29 effects of 1x to
         * 1.6x three do (seeds 194000 to 201079).
         */
        const val CAUSES = 0.3

        /**
         * Share of what the surest cause explains that another must, to be named beside it: the model of a strong effect
         * is not right to a few percent, as between the rows, and leaves traces that others take.
         */
        const val FURTHER = 0.02

        /** Causes in whose place two others are asked for. */
        const val EXCHANGED = 2

        /** Twice a gain in log-likelihood below which a cause goes again, once others are named beside it. */
        const val NEEDLESS = 8.0
    }
}
