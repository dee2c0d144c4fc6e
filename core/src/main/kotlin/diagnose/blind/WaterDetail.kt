package stillwater.diagnose.blind

import kotlin.math.sqrt

/**
 * How fine the water of a log without a reference is: as many waves as show above the noise, and no more.
 *
 * The water's power need not fall from ring to ring: a chessboard has next to none between waves of twice its squares and
 * of one, and water with sharp fronts has more than rings that were cut off say. So rings far finer than the finest found
 * are asked for ([FinerWaves]) and offered where the readings show more along them than noise.
 *
 * @param most columns at most of rings that are found from the longest down.
 */
internal class WaterDetail(private val search: BlindSearch, private val most: Int) {
    /** Columns at most with rings that are offered: with few rows more columns take no longer. */
    private val mostOffered = search.track.x.size.let { rows ->
        minOf(BlindSearch.most(rows), (BlindSearch.MOST_WAVES * sqrt(MANY_ROWS / rows)).toInt()).coerceAtLeast(most)
    }

    /** [state] with waves as strong as they have been found to be, of which so many are enough as show above the noise. */
    fun of(state: BlindState): BlindState {
        val now = found(state)
        // Beyond a gap alone: where the finest waves hold more than the noise, columns were too few for finer ones, or it is
        // the response that is wrong, which finer ones would hide.
        return if (now.isResolved && now.power(now.modes.bands - 1) <= now.variance) filled(now) else now
    }

    /**
     * [state], whose finest waves are strong, with ever finer ones, a ring at a time, until the finest are weak; null where
     * that is no likelier, or where so many columns would take too long.
     */
    fun deeper(state: BlindState): BlindState? {
        var now = state
        repeat(DEEPENED) {
            val next = now.modes.finer.firstOrNull()?.let { refined(now, mostOffered, setOf(it)) }
            if (next == null || !(next.score > now.score + BlindSearch.ENOUGH)) return now.takeIf { it !== state }
            now = next
            if (now.isResolved) return now
        }
        return now
    }

    /** [state] with rings found from the longest down, as long as that makes it no less likely. */
    private fun found(state: BlindState): BlindState {
        var now = state
        repeat(REDONE) {
            val next = refined(now, most, emptySet())
            if (next == null || next.score < now.score - BlindSearch.ENOUGH) return now
            now = next
        }
        return now
    }

    /** [state] with rings that are finer still, as long as that makes it likelier. */
    private fun filled(state: BlindState): BlindState {
        var now = state
        repeat(FILLED) {
            val offered = missing(now)
            val next = if (offered.isEmpty()) null else refined(now, mostOffered, offered)
            if (next == null || !(next.score > now.score + BlindSearch.ENOUGH)) return now
            now = next
        }
        return now
    }

    /** The rings finer than those of [state], by their shortest waves, m, along which more is left than noise. */
    private fun missing(state: BlindState): Set<Double> {
        val finest = state.modes.finest
        val asked = state.modes.finer.filter { it > finest / FINER }
        return asked.filterIndexedTo(HashSet()) { i, shortest ->
            FinerWaves.excessBetween(state, search, if (i == 0) finest else asked[i - 1], shortest) > MISSING
        }
    }

    /** [state] with the waves that suit it and rings of the shortest waves [offered], m; null where waves are not rings. */
    private fun refined(state: BlindState, most: Int, offered: Set<Double>): BlindState? {
        val waves = state.modes.refined(state.variances, most, offered)
        if (waves === state.modes) return null
        val noise = state.fit.design.noise
        return search.improved(
            search.settled(state.model.terms, state.numbers, noise, waves.first, BlindSearch.FIRST_ROUNDS, waves),
        )
    }

    companion object {
        private const val REDONE = 2
        private const val FILLED = 3
        private const val DEEPENED = 4

        /** How many times finer than the finest rings others are asked for. */
        private const val FINER = 4

        /** Power of what is left along waves over the noise's from which they are offered; whether they stay is then asked. */
        private const val MISSING = 1.25

        /** Rows with which columns more than [BlindSearch.MOST_WAVES] would take longer than ten seconds. */
        private const val MANY_ROWS = 5000.0

        /** Mean square of waves, over the noise's, that no cause's fit would miss. */
        private const val UNSEEN = 1e-3

        /** Whether the shortest waves that [state] has are not in the water. */
        fun isEnough(state: BlindState): Boolean =
            state.modes.lengths.isNotEmpty() && state.power(state.modes.bands - 1) < UNSEEN * state.variance
    }
}
