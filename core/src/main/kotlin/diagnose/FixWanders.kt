package stillwater.diagnose

/** Twice the gain in log-likelihood from which fixes wander. */
private const val WANDERING = 10.0

/** The same that fixes which wander may be behind before their size and time are fitted. */
private const val BEHIND = 30.0

/**
 * To begin with: variances of what fixes that wander do to readings over the noise's, and the share of the noise that
 * wanders beside.
 */
private val RATIOS = listOf(5.0, 30.0)
private const val SHARE = 0.5

/** Time over which they wander to begin with, s, and in rows at least: receivers' errors last for minutes. */
private const val TIME = 60.0
private const val ROWS = 20.0

/** A variance of what they do, over the noise's, that is none. */
private const val LEAST = 0.02

/** Twice a gain in log-likelihood that is none. */
private const val HARDLY = 0.1

/** Factors by which size and time are changed. */
private val WIDTHS = listOf(4.0, 2.0)

/** Times that slopes are taken from the water that suits them. */
private const val AGAIN = 2

/** [state] with fixes that wander and the waves that suit such; the same where they do not wander. */
internal fun BlindSearch.wandering(state: BlindState): BlindState {
    val found = wandered(state) ?: return state
    // Waves were told by noise that did not have errors of fixes.
    val finer = begun(redone(improved(found)))
    return followed(improved(requieted(evened(finer))))
}

/** [state] with fixes that wander, and so all that this search finds from now on; null where they do not. */
private fun BlindSearch.wandered(state: BlindState): BlindState? {
    val slopes = slopes(state) ?: return null
    if (slopes.usual == 0.0) return null
    val now = state.fit.design.noise
    val period = state.model.series.period
    val begun = RATIOS.flatMap { ratio ->
        val wander = slopes.with(ratio / slopes.usual, maxOf(TIME, ROWS * period))
        setOf(now.noise.share, SHARE, 0.0).map { noise(it, now.noise.time / period).beside(wander) }
    }
    val best = loops.all(begun) { tried(state, BlindNoise(it, now.spread)) }.maxBy { it.score }
    if (best.score < state.score - BEHIND) return null
    val found = followed(fitted(best))
    if (found.score > state.score + WANDERING) return found
    wander = null
    return null
}

/** [state], whose fixes wander, with the slopes of its own water, as long as that suits it better. */
private fun BlindSearch.followed(state: BlindState): BlindState {
    var best = state
    for (time in 1..AGAIN) {
        val before = checkNotNull(best.fit.design.noise.noise.wander)
        val slopes = checkNotNull(slopes(best))
        val now = slopes.with(before.variance * before.usual / slopes.usual, before.time)
        // What noise is tried has them beside.
        wander = now
        val next = fitted(requieted(again(best, beside(best, now))))
        val gain = next.score - best.score
        if (gain > 0) best = next
        if (!(gain > BlindSearch.ENOUGH)) break
    }
    wander = best.fit.design.noise.noise.wander
    return best
}

/** [state] with fixes that wander less or more, sooner or later, as long as that suits it better. */
private fun BlindSearch.fitted(state: BlindState): BlindState {
    var best = state
    for (width in WIDTHS) {
        // Errors that are larger and last longer move as much from row to row.
        for ((larger, longer) in listOf(width to 1.0, 1.0 to width, width to width)) {
            best = fitted(fitted(best, larger, longer), 1 / larger, 1 / longer)
        }
    }
    return if (best === state) state else again(best, best.fit.design.noise)
}

/** [state] with variance and time of its wandering fixes [larger] and [longer] times as large, as often as that suits it. */
private fun BlindSearch.fitted(state: BlindState, larger: Double, longer: Double): BlindState {
    val series = state.model.series
    var best = state
    while (true) {
        val now = checkNotNull(best.fit.design.noise.noise.wander)
        val other = now.with(now.variance * larger, now.time * longer)
        if (other.variance * other.usual < LEAST || other.time !in series.period..series.duration) return best
        val next = tried(best, beside(best, other))
        if (!(next.score > best.score + HARDLY)) return best
        best = next
    }
}

private fun beside(state: BlindState, wander: FixWander) =
    state.fit.design.noise.let { BlindNoise(it.noise.beside(wander), it.spread) }

/** [state] under [noise], with the water nearly as it suits that. */
private fun BlindSearch.tried(state: BlindState, noise: BlindNoise) =
    settled(state.model.terms, state.numbers, noise, state.variances, rounds = 1, before = state)

/** What fixes that are off by a metre do to readings in the water of [state]; null where the track is a line. */
private fun slopes(state: BlindState): FixWander? {
    val (east, north) = state.modes.slopes(state.fit.heights) ?: return null
    return FixWander(SteepNoise.felt(state, east), SteepNoise.felt(state, north), 1.0, 1.0)
}
