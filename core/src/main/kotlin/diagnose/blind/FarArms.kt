package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.all
import stillwater.diagnose.response.Term
import kotlin.math.ln

/**
 * A sensor on an arm, whose end turns may take so far off the boat's way that nothing of it shows along that.
 *
 * @property state the model with it. @property anew what finding the waves anew is worth by itself.
 * @property searched what the best of so many arms gains by chance. Both are twice log-likelihoods.
 */
internal class FarArm(val state: BlindState, val anew: Double, val searched: Double)

/** Looks for far arms in one log: where there is none at first there is none later. */
internal class FarArms(private val search: BlindSearch) {
    private var isNone = false

    /**
     * The likeliest of some arms under [state]; null where none is likelier.
     *
     * Of an arm that nobody knows of passes contradict each other everywhere, and only noise that wanders as much as any
     * may explains that; so it is asked only where there is such. How good an arm is shows once the lag and the noise
     * suit it: the lag is fitted for all, the rest for those that are then likeliest. Not in long logs, where that takes
     * too long.
     */
    fun likeliest(state: BlindState): FarArm? {
        val isWandering = state.fit.design.noise.noise.share >= BlindSearch.SHARES.last()
        if (isNone || state.modes.lengths.isEmpty() || !isWandering || state.residuals.size > MOST_ROWS) return null
        val term = Term(Cause.POSITION_OFFSET)
        val model = search.model(state.model.terms + term, state.modes, state.water)
        val arms = LENGTHS.flatMap { listOf(it, -it) }.map { it * state.modes.shortest }
        val begun = search.loops.all(listOf(0.0) + arms) { behind ->
            val numbers = model.carried(state.model, state.numbers).also { it[model.slot(term)] = behind }
            search.improved(checkNotNull(search.begunAt(behind, state, model.terms, numbers)))
        }
        val likely = begun.drop(1).sortedByDescending { it.score }.take(FITTED)
        val found = search.loops.all(listOf(begun[0]) + likely) { search.fullySuited(it) }
        val best = found.maxBy { it.score }
        isNone = best === found[0] || best.score <= state.score
        if (isNone) return null
        return FarArm(search.onArm(best), maxOf(found[0].score - state.score, 0.0), 2 * ln(arms.size.toDouble()))
    }

    private companion object {
        /** Lengths of arms over that of the shortest wave. */
        val LENGTHS = listOf(0.25, 0.5, 0.75, 1.0, 1.5)

        /** Arms of which all is fitted. */
        const val FITTED = 3

        /** Rows of a log in which the arms are fitted in some seconds of processor time. */
        const val MOST_ROWS = 2000
    }
}
