package stillwater.diagnose

/**
 * Whether waves that a model of the water lacks are the water's beyond doubt, before causes are weighed without them.
 *
 * Waves that are missing and a response that is wrong look alike, so that whichever explains more is taken. Where finer
 * waves explain far more than any cause does at its first steps, these need not be taken to their ends.
 */
internal class MissingWaves(private val search: BlindSearch, private val state: BlindState) {
    private val tries = BlindTrials(search, state)

    /** Whether a log that is as likely as [finer] with finer waves has no cause that comes near it without them. */
    fun areClear(finer: BlindState): Boolean {
        val least = (finer.score - state.score - NEAR) / FURTHER
        return least > 0 && search.loops.all(BlindTerms.of(search, hasShape = true)) { gain(it) < least }.all { it }
    }

    /** Twice the gain in log-likelihood of [term] at its first steps, with water of its own where it is a response. */
    private fun gain(term: Term): Double {
        val trial = tries.attempt(term)
        if (term.cause !in BlindSearch.LINEAR) return trial.gain
        return maxOf(trial.gain, search.improved(tries.begun(trial, state)).score - state.score)
    }

    private companion object {
        /** Times that a cause may gain more at its end than at its first steps, and units besides. */
        const val FURTHER = 3.0
        const val NEAR = 50.0
    }
}
