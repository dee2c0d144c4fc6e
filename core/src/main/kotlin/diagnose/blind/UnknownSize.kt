package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Term
import kotlin.math.abs

/** Whether a cause is in a model of a log without a reference, and the log does not tell how large it is. */
internal object UnknownSize {
    /**
     * Whether it is so of [term] in [state], whose numbers may be off by [errors]: jumps of either sign, or an end of the range
     * anywhere.
     */
    fun isOf(term: Term, state: BlindState, errors: DoubleArray): Boolean {
        val at = state.model.slotOrNull(term) ?: return false
        val slots = (at until at + state.model.width(term)).filter { abs(state.numbers[it]) < ResponseModel.NO_END }
        fun reach(slot: Int) = BlindErrors.REACH * errors[slot]
        return when (term.cause) {
            Cause.OFFSET_STEPS -> slots.all { abs(state.numbers[it]) < reach(it) }
            Cause.SATURATION -> slots.any { reach(it) > state.model.scales.range }
            else -> false
        }
    }

    /** What is to be said of such a [term]. */
    fun words(term: Term): String =
        "A term for ${term.cause.label} was fitted beside and is not named: the log does not tell how large it is."
}
