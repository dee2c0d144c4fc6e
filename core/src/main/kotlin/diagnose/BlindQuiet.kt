package stillwater.diagnose

/** Times the lag found, from which it is looked for once more. */
private val LONGER = listOf(1.0, 2.0, 4.0)

/** Share of noise that hardly wanders; and from which on it may have taken what a sensor does. */
private const val QUIET = 0.2
private const val WANDERING = 0.5

/** Twice the log-likelihood that such noise is behind where noise wanders for certain. */
private const val FAR_BEHIND = 300.0

/** [state] with the noise, as [of] makes it, that suits it best; never a less likely one. */
internal fun BlindSearch.quieted(
    state: BlindState,
    of: (BlindState, CorrelatedNoise) -> BlindNoise = steep::of,
): BlindState {
    val noises = BlindSearch.SHARES.flatMap { share ->
        BlindSearch.TIMES.filter { share > 0 || it == BlindSearch.TIMES[0] }.map { steps -> noise(share, steps) }
    }
    return (listOf(state) + loops.all(noises) { again(state, of(state, it)) }).maxBy { it.score }
}

/** [state] with errors of fixes in its noise, where these may show: noise that wanders may have taken what they do. */
internal fun BlindSearch.placed(state: BlindState): BlindState = if (fixes.isWide(state)) quieted(state) else state

/**
 * [state], or what is likelier and is found from noise that hardly wanders, and from longer lags: a lag that is too
 * short and noise that wanders make up for each other.
 */
internal fun BlindSearch.restarted(state: BlindState): BlindState {
    val noise = hardlyWandering(state)
    val begun = loops.all(LONGER) { times ->
        val lag = minOf(times * state.timeConstant, state.model.series.duration)
        settled(state.model.terms, base(lag), noise, state.variances, before = state)
    }
    val quiet = improved(begun.maxBy { it.score })
    // Of noise that is far less likely only the lag is asked: the water need not follow to the end.
    return likelier(state, if (isFar(state, quiet)) quiet else climbed(quiet))
}

/**
 * [state], or what is likelier and is found from [quiet], another model under noise that hardly wanders. Where that is
 * far less likely noise does wander: the other model is then held against [state] under the same noise.
 */
internal fun BlindSearch.likelier(state: BlindState, quiet: BlindState): BlindState {
    val isFar = isFar(state, quiet)
    val other = climbed(if (isFar) again(quiet, state.fit.design.noise) else requieted(quiet))
    return if (!(other.score > state.score)) {
        state
    } else if (isFar) {
        climbed(requieted(other))
    } else {
        other
    }
}

/**
 * [state] with noise that hardly wanders, where it does: such noise has taken what a sensor does that the model does
 * not have, and leaves little for it to explain.
 */
internal fun BlindSearch.quiet(state: BlindState): BlindState? =
    state.fit.design.noise.let {
        val isQuiet = it.noise.share < WANDERING && it.places == null
        if (isQuiet) null else climbed(again(state, hardlyWandering(state)))
    }

private fun BlindSearch.hardlyWandering(state: BlindState) =
    noise(QUIET, BlindSearch.FIRST_STEPS).let {
        if (state.fit.design.noise.places == null) state.fit.design.noise.with(it) else steep.without(state, it)
    }

private fun isFar(state: BlindState, quiet: BlindState) = state.score - quiet.score > FAR_BEHIND
