package stillwater.diagnose

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
    val modes = state.modes
    val variances = DoubleArray(modes.bands) { if (it in modes.moving) BlindSearch.LEAST else state.variances[it] }
    return settled(state.model.terms, state.numbers, state.fit.design.noise, variances, before = state)
}

/** [state] with water that may change in time, and with what suits that. */
internal fun BlindSearch.opened(state: BlindState): BlindState {
    if (!isStill(state)) return state
    val variances = DoubleArray(state.modes.bands) { if (it in state.modes.moving) OPENED else state.variances[it] }
    val noise = state.fit.design.noise
    val rounds = BlindSearch.FIRST_ROUNDS
    return fullySuited(settled(state.model.terms, state.numbers, noise, variances, rounds, before = state))
}
