package stillwater.diagnose.blind

/** A cause that was added: [trial], among what it was chosen from, and the model with it. */
internal class BlindStep(val trial: BlindTrial, val round: BlindRound, val state: BlindState)

/** The model with all that was [chosen] but the [left]-th, with the noise of [base]. */
internal fun BlindSearch.without(base: BlindState, chosen: List<BlindStep>, left: Int): BlindState {
    val full = chosen.last().state
    val dropped = chosen[left].trial.name
    val terms = full.model.terms.filter { it.key != dropped }
    val numbers = model(terms, full.modes, full.water).carried(full.model, full.numbers)
    return improved(settled(terms, numbers, base.fit.design.noise, base.variances, before = full))
}
