package stillwater.diagnose.blind

import stillwater.diagnose.all

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
        val gain = finer.score - state.score
        if (most(0.0) >= gain) return false
        val trials = search.loops.all(BlindTerms.of(search, hasShape = true), tries::attempt)
        if (trials.any { most(it.gain) >= gain }) return false
        val responses = trials.filter { it.term?.cause in BlindSearch.LINEAR }
        return search.loops.all(responses, ::gain).all { most(it) < gain }
    }

    /** Twice the gain in log-likelihood of [trial], a response, at its first steps with water of its own. */
    private fun gain(trial: BlindTrial) = search.improved(tries.begun(trial, state)).score - state.score

    companion object {
        /** Times that a cause may gain more at its end than at its first steps, and units besides. */
        private const val FURTHER = 3.0
        private const val NEAR = 50.0

        /** The most that a cause may gain at its end that gains [first] at its first steps, in twice the log-likelihood. */
        fun most(first: Double): Double = FURTHER * first + NEAR
    }
}
