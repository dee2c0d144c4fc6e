package stillwater.diagnose.blind

import stillwater.diagnose.Cause

/**
 * Whether what a cause explains is more than waves which the water was not given, or could not be, may be taken for. Asked
 * where the finest waves are strong.
 */
internal object BeyondWaves {
    /** Twice the gain in log-likelihood that water finer than was resolved does not give a response of another shape. */
    const val GAIN = 100.0

    /**
     * Share of the readings' number that twice the gain in log-likelihood over inflation of a cause that goes with values
     * must be, which is the share of the residuals' square sum that it explains while that is small. On chessboards without
     * a cause, of which four to ten steps cross a square, waves that are missing gave a play of 0.4 to 3 %.
     */
    private const val SHARE = 0.05

    /** The same of other shapes of the lag, which missing waves look like: they go with no quantity but the way. */
    private const val MOST = 0.25

    /** Causes that go with how readings rise and fall, as what is left does where water has fronts that waves round off. */
    private val OF_VALUE = setOf(Cause.HYSTERESIS, Cause.ASYMMETRIC_RESPONSE, Cause.SLEW_LIMIT)

    /**
     * [trial] where it explains more; nothing else. No finer waves are missing beside it, or it explains more than missing
     * waves could be taken for, as an arm does that leaves the way in turns.
     */
    fun of(trial: BlindTrial, search: BlindSearch): BlindTrial {
        val state = trial.state ?: return trial
        val cause = trial.term?.cause
        val isMore = when {
            trial.ratio <= 0 || state.isResolved -> true
            cause in OF_VALUE -> trial.ratio > SHARE * state.fit.rows || !FinerWaves.areMissing(state, search)
            cause !in BlindSearch.LINEAR -> true
            trial.ratio > if (cause in BlindTerms.OF_LAG) MOST * state.fit.rows else GAIN -> true
            else -> FinerWaves.isNone(state, search) || search.isOnArm(state, GAIN * trial.inflation)
        }
        return if (isMore) trial else trial.atMost(0.0)
    }
}
