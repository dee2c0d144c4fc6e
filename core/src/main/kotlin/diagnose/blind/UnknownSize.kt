package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.response.Term

/** Jumps that are in a model of a log without a reference, and whose size the log does not tell. */
internal object UnknownSize {
    /** Whether [term] is such in [state], whose numbers may be off by [errors]: by more than the readings differ by. */
    fun isOf(term: Term, state: BlindState, errors: DoubleArray): Boolean {
        val at = state.model.slotOrNull(term)
        if (at == null || term.cause != Cause.OFFSET_STEPS) return false
        return (at until at + state.model.width(term)).any { isOpen(errors[it], state.model.scales.range) }
    }

    /** Whether an [error] says as good as nothing of a number, where readings are within a [range], sensor units. */
    fun isOpen(error: Double, range: Double): Boolean = BlindErrors.REACH * error > range

    /** What is to be said of such a [term]. */
    fun words(term: Term): String =
        "A term for ${term.cause.label} was fitted beside and is not named: the log does not tell how large it is."
}
