package stillwater.diagnose.blind

import stillwater.diagnose.all
import stillwater.diagnose.noise.CorrelatedNoise
import kotlin.math.abs
import kotlin.math.ln

/** Times the lag found, from which it is looked for once more. */
private val LONGER = listOf(1.0, 2.0, 4.0)

/** Share of noise that hardly wanders; and from which on it may have taken what a sensor does. */
private const val QUIET = 0.2
private const val WANDERING = 0.5

/** Rounds in which both shares and times are gone through. */
private const val CLIMBS = 3

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

/** [state] with noise that wanders less or more, and sooner or later, as long as that suits it better. */
internal fun BlindSearch.requieted(state: BlindState): BlindState {
    val shares = BlindSearch.SHARES
    val times = BlindSearch.TIMES
    val now = state.fit.design.noise.noise
    var share = shares.indices.minBy { abs(shares[it] - now.share) }
    var time = times.indices.minBy { abs(ln(times[it] * state.model.series.period / now.time)) }
    if (share == 0) time = times.size / 2
    var best = state
    val asked = HashSet<Pair<Int, Int>>()
    fun climbed(toShare: Int, toTime: Int): Boolean {
        if (toShare !in shares.indices || toTime !in times.indices || (share == 0 && toShare == 0)) return false
        val noise = noise(shares[toShare], times[toTime])
        if (!asked.add(toShare to toTime) || best.isFarBehind(noise)) return false
        val next = again(best, steep.with(best, noise))
        if (next.score <= best.score) {
            best.learn(noise, best.score - next.score)
            return false
        }
        best = next
        asked.clear()
        share = toShare
        time = toTime
        return true
    }
    repeat(CLIMBS) {
        var isBetter = false
        for (way in listOf(-1, 1)) {
            while (climbed(share + way, time)) isBetter = true
            while (climbed(share, time + way)) isBetter = true
        }
        if (!isBetter) return best
    }
    return best
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
    val other = climbed(if (isFar) again(quiet, state.fit.design.noise) else requieted(quiet), state.score)
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
