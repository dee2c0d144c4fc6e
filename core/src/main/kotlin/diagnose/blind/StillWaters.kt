package stillwater.diagnose.blind

/** Variance over the noise's of water that changes, to begin with. */
private const val OPENED = 10.0

/** Whether the water of [state] does not change in time. */
internal fun BlindSearch.isStill(state: BlindState): Boolean =
    state.modes.moving.all { state.variances[it] <= BlindSearch.LEAST }

/** [state] with water that does not change in time, and with what suits that. */
internal fun BlindSearch.still(state: BlindState): BlindState =
    if (isStill(state)) state else fullySuited(held(state))

/** [state] with water that does not change in time, all else the same. */
internal fun BlindSearch.held(state: BlindState): BlindState {
    val variances = withChanging(state, BlindSearch.LEAST)
    return settled(state.model.terms, state.numbers, state.fit.design.noise, variances, before = state)
}

/** [state] with water that may change in time, and with what suits that. */
internal fun BlindSearch.opened(state: BlindState): BlindState {
    if (!isStill(state)) return state
    val variances = withChanging(state, OPENED)
    val noise = state.fit.design.noise
    val rounds = BlindSearch.FIRST_ROUNDS
    return fullySuited(settled(state.model.terms, state.numbers, noise, variances, rounds, before = state))
}

/** The variances of [state], but [variance] of all waves that change in time. */
private fun withChanging(state: BlindState, variance: Double) =
    DoubleArray(state.modes.bands) { if (it in state.modes.moving) variance else state.variances[it] }
