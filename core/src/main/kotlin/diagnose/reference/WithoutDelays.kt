package stillwater.diagnose.reference

import stillwater.diagnose.evidence.Trial
import stillwater.diagnose.evidence.without
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ReferenceLead
import stillwater.diagnose.response.Scales
import stillwater.diagnose.response.Steps

/** What explains a log in the place of causes and is none: in [words], with twice its log-likelihood less what it gains by chance. */
internal class Rival(val words: String, val worth: Double)

/**
 * What was [chosen], one after the other, on top of [base], without the delays and further lags among it: something that is no
 * cause of the list may be in their place.
 *
 * @param longest longest correlation time of noise, s.
 */
internal class WithoutDelays(val base: ModelFit, private val chosen: List<Trial>, val longest: Double) {
    /** The model with all that was chosen. */
    val last: ModelFit = chosen.lastOrNull()?.fit ?: base
    private val gone = chosen.filter { it.term.cause in ReferenceLead.ALIKE }

    /** Whether there were any. */
    val hadSome: Boolean get() = gone.isNotEmpty()

    /** The rest, fitted to what [scales] have with [steps], from a lag of [tau] s on. */
    fun fit(scales: Scales, steps: Steps, tau: Double): ModelFit =
        last.without(gone, tau, scales, steps, last.noise.used, longest)

    /**
     * That [words] say what it is, where [fit], whose own numbers gain [chance] in twice the log-likelihood by chance, is clearly
     * likelier than what was chosen; else null.
     */
    fun rival(fit: ModelFit, chance: Double, words: () -> String): Rival? {
        val worth = fit.score - (chosen.sumOf { it.cost } - gone.sumOf { it.cost } + chance)
        return if (worth < last.score - chosen.sumOf { it.cost } + CLEARLY) null else Rival(words(), worth)
    }

    private companion object {
        /** Twice the log-likelihood by which it must be likelier than causes of the list, which are common. */
        const val CLEARLY = 18.0
    }
}
