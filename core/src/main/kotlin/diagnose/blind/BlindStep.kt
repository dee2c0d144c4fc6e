package stillwater.diagnose.blind

import stillwater.diagnose.Cause

/** A cause that was added: [trial], among what it was chosen from, and the model with it. */
internal class BlindStep(val trial: BlindTrial, val round: BlindRound, val state: BlindState)

/**
 * What [step] has added, as it is beside all others that were chosen: one of [causes], the chosen one first.
 *
 * @property isContradicted whether the halves of the log contradict each other about it, then and when it was chosen: what
 * other causes are missing does so, too.
 */
internal class ChosenCause(val step: BlindStep, val causes: List<Cause>, val isContradicted: Boolean)

/** The model with all that was [chosen] but the [left]-th, with the noise of [base]. */
internal fun BlindSearch.without(base: BlindState, chosen: List<BlindStep>, left: Int): BlindState {
    val full = chosen.last().state
    val dropped = chosen[left].trial.name
    val terms = full.model.terms.filter { it.key != dropped }
    val numbers = model(terms, full.modes, full.water).carried(full.model, full.numbers)
    return improved(settled(terms, numbers, base.fit.design.noise, base.variances, before = full))
}
