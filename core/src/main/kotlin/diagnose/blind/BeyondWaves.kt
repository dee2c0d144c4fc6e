package stillwater.diagnose.blind

import stillwater.diagnose.Cause

/**
 * Whether what a cause or a look explains is more than waves which the water was not given, or could not be, may be taken
 * for, in a round that begins on [state].
 */
internal class BeyondWaves(private val search: BlindSearch, private val state: BlindState) {
    private val isBlurred = !state.isResolved

    /** Whether finer waves show in what is left, although the finest that there are hold little. */
    private val isFiner by lazy { !isBlurred && FinerWaves.show(state, search) }

    /**
     * [trial] where it explains more; nothing else. No finer waves are missing beside it, or it explains more than missing
     * waves could be taken for, as an arm does that leaves the way in turns.
     */
    fun of(trial: BlindTrial): BlindTrial {
        val state = trial.state ?: return trial
        val cause = trial.term?.cause
        val isMore = when {
            trial.ratio <= 0 || !mayBeWaves(trial) -> true
            isBlurred && state.isResolved -> true
            cause in OF_VALUE && trial.ratio > SHARE * state.fit.rows -> true
            cause in OF_VALUE -> isBlurred && !FinerWaves.areMissing(state, search)
            cause !in BlindSearch.LINEAR -> true
            trial.ratio > if (cause in BlindTerms.OF_LAG) MOST * state.fit.rows else GAIN -> true
            isFiner -> !FinerWaves.show(state, search)
            else -> FinerWaves.isNone(state, search) || search.isOnArm(state, GAIN * trial.inflation)
        }
        return if (isMore) trial else trial.atMost(0.0)
    }

    /** [trial] of [look] with the water and the noise of a model as it is, where it explains more; nothing else. */
    fun of(look: BlindLook, trial: BlindTrial): BlindTrial {
        val isMore = when {
            look.ofWater -> !isMissing(look, trial) && !mayBeWaves(trial)
            else -> isMoreThanFronts(look, trial, state)
        }
        return if (isMore) trial else trial.atMost(0.0)
    }

    /** Whether [look] may explain more with the water and the noise of [refitted], which has waves that [state] may lack. */
    fun isClear(look: BlindLook, refitted: BlindState): Boolean =
        !isBlurred || !look.ofWater || refitted.isResolved || FinerWaves.isNone(refitted, search)

    /** [trial] of [look] with the water and the noise of [refitted], where it explains more; nothing else. */
    fun of(look: BlindLook, trial: BlindTrial, refitted: BlindState): BlindTrial {
        val isMore = when {
            !look.ofWater -> isMoreThanFronts(look, trial, refitted)
            isBlurred -> !isMissing(look, trial)
            !mayBeWaves(trial) -> true
            else -> if (refitted.isResolved) !FinerWaves.show(refitted, search) else FinerWaves.isNone(refitted, search)
        }
        return if (isMore) trial else trial.atMost(0.0)
    }

    /** Whether [trial] of [look] is more than what goes with values where waves that [on] lacks round fronts off. */
    private fun isMoreThanFronts(look: BlindLook, trial: BlindTrial, on: BlindState): Boolean = when {
        look.follow == null || trial.ratio > SHARE * on.fit.rows || !mayBeWaves(trial) -> true
        on.isResolved -> !isFiner || !FinerWaves.show(on, search)
        else -> !isFiner && !FinerWaves.areMissing(on, search)
    }

    /** Whether waves are missing, or may be; of a trial that is not sure it is not asked where the finest are weak. */
    private fun mayBeWaves(trial: BlindTrial) = isBlurred || (trial.pValue < UNSURE && isFiner)

    /** Whether waves that the water is not given may look like [look] as much as [trial] says. */
    private fun isMissing(look: BlindLook, trial: BlindTrial) = look.ofWater && !look.isLoose && trial.ratio < RING

    companion object {
        /** Twice the gain in log-likelihood that water finer than was resolved does not give a response of another shape. */
        const val GAIN = 100.0

        /**
         * Share of the readings' number that twice the gain in log-likelihood over inflation of a cause that goes with values
         * must be, which is the share of the residuals' square sum that it explains while that is small. On chessboards without
         * a cause, of which four to ten steps cross a square, waves that are missing gave a play of 0.4 to 3 %, and 6.7 % where rows
         * are 7 m apart across narrower fronts; hidden plays have 12 % and more where waves are missing.
         */
        private const val SHARE = 0.09

        /** The same of other shapes of the lag, which missing waves look like: they go with no quantity but the way. */
        private const val MOST = 0.25

        /** The same as [GAIN] that waves which are missing do not give a look at the response: they gave 30 and 36 (191070, 195170). */
        private const val RING = 45.0

        /** p-value of what is no answer, whatever waves are missing. */
        private const val UNSURE = 0.05

        /** Causes that go with how readings rise and fall, as what is left does where water has fronts that waves round off. */
        private val OF_VALUE = setOf(Cause.HYSTERESIS, Cause.ASYMMETRIC_RESPONSE, Cause.SLEW_LIMIT)
    }
}
