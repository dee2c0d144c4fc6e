package stillwater.diagnose.evidence

import stillwater.diagnose.Cause
import stillwater.diagnose.algebra.squares
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ReferenceLead
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Steps
import stillwater.diagnose.response.Term
import stillwater.diagnose.response.isTiming
import java.util.Locale
import kotlin.math.abs

/**
 * Effects of the model [last], [base] with more, that the way the log is sampled may make as well, however surely they show: they are kept
 * in the model, so that nothing else is taken for them, and are not named.
 *
 * Where the truth moves in sharp steps, each may have come anywhere between two rows: what changes the reading less
 * than a shift of a row does is then no cause. A truth taken as held smooths what noise its reference has left, and a
 * delay of half a step then puts it back where it was.
 *
 * @param late by how much the reference was late, s, before it was put right; 0 where it was not.
 */
internal class SmallShifts(private val last: ModelFit, private val base: ModelFit, private val late: Double = 0.0) {
    private val model = last.model
    private val period = model.series.period

    /** Whether the log leaves open when, within a row, the truth moved. */
    private val isWithinRows = model.scales.unknown?.isSharp == true

    /** By how much a truth that is held over each step is ahead of one that goes on evenly, s. */
    private val lead = model.steps.lead * period

    /** Of [trial], which may be any of [set]: whether it is too small. */
    fun isSmall(trial: Trial, set: List<Cause>): Boolean {
        val shift = shift(trial.term, set)
        val isNone = shift != null && (isUndone(trial.term, shift) || isNothing(trial.term, shift))
        return isNone || (isWithinRows && isLessThanARow(trial.term))
    }

    /** Whether one of [chosen] puts a truth that is held over each step back where it was. */
    fun areUndone(chosen: List<Trial>): Boolean = chosen.any { trial ->
        late(trial.term, model, last.numbers)?.let { isUndone(trial.term, it) } == true
    }

    /** Whether a delay of [shift] s by [term], beyond a given one, puts a truth that is held over each step back where it was. */
    private fun isUndone(term: Term, shift: Double) =
        model.steps.isHeld && abs(shift - given(term) - lead) < LEAST_ROWS * period

    /** Whether a delay of [shift] s by [term] differs from a given one by no more than a simulation in fine steps makes. */
    private fun isNothing(term: Term, shift: Double) =
        abs(shift - given(term)) < maxOf(SIMULATED_ROWS * period, ReferenceLead.PRECISION * late)

    /** The delay by [term] that the base has already, s. */
    private fun given(term: Term) = late(term, base.model, base.numbers) ?: 0.0

    /** Whether [term] puts the readings ahead by about as much as a truth held over each step does, which this is not. */
    fun isLikeHeld(term: Term): Boolean =
        !model.steps.isHeld && shift(term, emptyList())?.let { abs(it / period + Steps.HELD.lead) < NEARLY } == true

    /**
     * Whether [term] does what a reference does that is late as an ordinary one may be: it puts readings ahead of where the
     * truth goes evenly, or a part of them is there at once.
     */
    fun isLikeLate(term: Term): Boolean {
        val reach = ReferenceLead.ordinary(base)
        if (term.cause == Cause.TWO_PATH_RESPONSE) return last.numbers[ResponseModel.TIME_CONSTANT] < reach
        return shift(term, emptyList())?.let { it - lead < 0 && lead - it < reach } == true
    }

    /** [small] effects in words for the reader; none if there are none. */
    fun words(small: List<Trial>): List<String> = small.map { trial ->
        val why = when {
            isWithinRows -> SHARP
            late(trial.term, model, last.numbers)?.let { isNothing(trial.term, it) && !isUndone(trial.term, it) } ==
                true ->
                "clocks, fixes and the way a log is sampled do as much as a thirtieth of a row."
            else -> "it undoes the shift of a truth that is held over each step."
        }
        words(trial.term, model, last.numbers, why)
    }

    /** What is to be said of those among [named] that are shifts of next to nothing; none if there are none. */
    fun cautions(named: List<Pair<Trial, List<Cause>>>): List<String> =
        named.filter { (trial, set) ->
            shift(trial.term, set)?.let { abs(it - given(trial.term)) < LEAST_ROWS * period } == true
        }.map { (trial, _) -> "The ${trial.term.cause.label} is a $LITTLE" }

    /** By how much the readings are late for [term], s; null where that is not what it does. */
    private fun shift(term: Term, set: List<Cause>): Double? =
        late(term, model, last.numbers).takeIf { term.cause != Cause.SECOND_ORDER_RESPONSE || Cause.DEAD_TIME in set }

    /** Whether what [term] does to the readings is less than a dead time of a row would. */
    private fun isLessThanARow(term: Term): Boolean {
        if (term.cause == Cause.DEAD_TIME) {
            return last.numbers[model.slot(term)] < (1 + LEAST_ROWS + model.secondLead) * period
        }
        if (!term.cause.isTiming) return false
        val prompt = model.terms.filter { it.cause != Cause.DEAD_TIME }
        val rest = prompt.filter { it.key != term.key }
        val all = shown(prompt)
        val without = shown(rest)
        val shifted = shown(rest + Term(Cause.DEAD_TIME))
        val change = DoubleArray(all.size) { all[it] - without[it] }
        val moved = DoubleArray(all.size) { shifted[it] - without[it] }
        // A slow path or a dead band shows on plateaus, too, where no shift of a step does.
        return squares(change) < squares(moved) && StepShifts(last).beyond(term, change) < CERTAIN
    }

    /** What the model shows with [terms] alone, their numbers as in [last]; a dead time is one row's. */
    private fun shown(terms: List<Term>): DoubleArray {
        val other = ResponseModel(model.series, terms, model.steps, model.scales)
        val numbers = DoubleArray(other.parameters.size) { if (it < ResponseModel.BASE) last.numbers[it] else 0.0 }
        for (term in terms) {
            val to = other.slotOrNull(term) ?: continue
            val from = model.slotOrNull(term)
            if (term.cause == Cause.DEAD_TIME) {
                numbers[to] = period
            } else if (from != null) {
                for (k in 0 until other.width(term)) numbers[to + k] = last.numbers[from + k]
            }
        }
        return DoubleArray(model.series.size).also { other.predict(numbers, it) }
    }

    companion object {
        /** By how much the readings are late for [term] of [model] with [numbers], s; null where that is not what it does. */
        fun late(term: Term, model: ResponseModel, numbers: DoubleArray): Double? {
            // A number of the base that was given has no place of its own.
            val number = model.slotOrNull(term)?.let(numbers::getOrNull) ?: return null
            return when (term.cause) {
                // A short second lag does what a dead time does.
                Cause.DEAD_TIME, Cause.SECOND_ORDER_RESPONSE -> number
                Cause.POSITION_OFFSET -> number / model.scales.ordinarySpeed
                else -> null
            }
        }

        /**
         * [numbers] of [model] with which readings are as late as now where its steps are [to]: the first shift of the whole
         * log, within its bounds, makes up for what the truth is sooner or later then.
         */
        fun kept(model: ResponseModel, numbers: DoubleArray, to: Steps): DoubleArray {
            val out = numbers.copyOf()
            val term = model.terms.firstOrNull { it.cause in WHOLE } ?: return out
            val slot = model.slotOrNull(term) ?: return out
            val later = (to.lead - model.steps.lead) * model.series.period
            val more = if (term.cause == Cause.POSITION_OFFSET) later * model.scales.ordinarySpeed else later
            val bounds = model.parameters[slot]
            out[slot] = (numbers[slot] + more).coerceIn(bounds.lower, bounds.upper)
            return out
        }

        /** Of [term] of [model] with [numbers], which is fitted and not named, for the reader. */
        fun words(term: Term, model: ResponseModel, numbers: DoubleArray, why: String): String {
            val slot = model.slot(term)
            val number = "%.2g".format(Locale.ROOT, numbers[slot])
            val size = "$number ${model.parameters[slot].unit}"
            return "A ${term.cause.label} of $size was fitted beside and is not named: $why"
        }

        /** Shifts of the whole log. */
        val WHOLE = setOf(Cause.DEAD_TIME, Cause.POSITION_OFFSET)

        /** What is to be said of readings that are as late as a truth held until the next row makes them. */
        const val UNTIL_NEXT =
            "The truth looks held from each row until the next, as a simulation may hold it. Half a row of delay " +
                "would look the same, and is not named."

        /** What is to be said of a shift of next to nothing. */
        const val LITTLE =
            "shift of less than a tenth of a row: clocks, fixes and the way a log is sampled do as much."

        /** Rows by which a shift may differ from that of held steps and still be asked whether it is one. */
        const val NEARLY = 0.25

        /** Twice a log-likelihood that is more than chance: 1 % over eighteen causes tried. */
        const val CERTAIN = 11.9

        /**
         * Rows; a shift of less is none. A simulation of twenty steps a row, each by the truth at its end or at its beginning,
         * is ahead or late by half a step, 0.025 rows, and no boat's clock and fixes are that good.
         */
        const val SIMULATED_ROWS = 0.03

        /** Rows; a shift of less is next to nothing. */
        const val LEAST_ROWS = 0.1

        /** Why nothing of less than a row shows where the truth is sharp. */
        const val SHARP = "the truth moves in sharp steps, and when between two rows each came is not known."
    }
}
