package stillwater.diagnose.reference

import stillwater.diagnose.Cause
import stillwater.diagnose.response.Fitting
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Steps
import stillwater.diagnose.response.Term

/**
 * Whether a sensor that is ahead of the boat by about as far as that goes in half a row, and a truth that goes on evenly,
 * explain a log better than a truth held over each row does, which is ahead by half a row of time.
 *
 * Where speeds differ the two are not the same; what [held] leaves then looks like another cause that goes with speed.
 *
 * @param even the same model as [held] with a truth that goes on evenly. @param used rows that are fitted.
 * @param longest the noise may be correlated over, s. @param margin twice the log-likelihood by which it must be better.
 */
internal fun isProbeAhead(
    held: ModelFit,
    even: ModelFit,
    used: BooleanArray,
    longest: Double,
    margin: Double,
): Boolean {
    val term = Term(Cause.POSITION_OFFSET)
    if (even.model.slotOrNull(term) != null) return false
    val scales = even.model.scales
    val model = ResponseModel(even.model.series, even.model.terms + term, even.model.steps, scales)
    val slot = model.slot(term)
    val free = BooleanArray(model.parameters.size) { it == slot || even.free.getOrElse(it) { false } }
    val start = even.numbers.copyOf(model.parameters.size)
    start[slot] = -Steps.HELD.lead * model.series.period * scales.ordinarySpeed
    return Fitting.fit(model, start, free, used, longest, guess = held.noise).score > held.score + margin
}
