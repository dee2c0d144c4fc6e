package stillwater.diagnose.evidence

import stillwater.diagnose.algebra.squares
import kotlin.math.abs

/**
 * Sudden changes that come back slowly, as bubbles, weed or a loose plug make them, in what a model leaves of a log
 * without a reference.
 *
 * Noise that wanders imitates what each leaves: its spread is then that of the changes, and no cause is worth anything
 * beside. But what is new in a row, the whitened residual, is small in nearly all rows and far off in those in which
 * something happened.
 */
internal object SuddenChanges {
    /** Robust standard deviations that no noise reaches. */
    private const val FAR = 8.0

    /** Changes; fewer may be jumps, which are a cause. */
    private const val FEWEST = 5

    /**
     * Share of all squares that those rows have. Where water is steep, or a cause was named, far rows have up to half
     * (docs/diagnosis.md).
     */
    private const val MOST = 0.8

    /** Robust standard deviations that changes go beyond of which nearly all go one way. */
    private const val FAR_ONE_WAY = 5.0

    /** Of what goes either way as often: the chance of so many one way. */
    private const val CHANCE = 1e-4

    /** What is to be said of [whitened] residuals; null where they are as noise is. */
    fun words(whitened: DoubleArray): String? {
        val spread = Spikes.spread(whitened)
        val rows = whitened.indices.filter { abs(whitened[it]) > FAR * spread }
        val changes = changes(rows).size
        val share = rows.sumOf { whitened[it] * whitened[it] } / squares(whitened)
        if (changes >= FEWEST && share > MOST) {
            return "the readings change suddenly $changes times and come back slowly, as with bubbles"
        }
        return oneWay(changes(whitened.indices.filter { abs(whitened[it]) > FAR_ONE_WAY * spread }), whitened)
    }

    /** The first of [rows] that follow each other: what comes back at once, or in two steps, is one change. */
    private fun changes(rows: List<Int>) = rows.filterIndexed { k, row -> k == 0 || row - rows[k - 1] > 1 }

    /** Of [changes] nearly all of which go one way: steep water, wild readings and tails of noise go either way. */
    private fun oneWay(changes: List<Int>, whitened: DoubleArray): String? {
        val upward = changes.count { whitened[it] > 0 }
        val back = minOf(upward, changes.size - upward)
        if (changes.isEmpty() || 2 * Evidence.evenTail(back, changes.size) > CHANCE) return null
        val way = if (upward > back) "upward" else "downward"
        val most = if (back == 0) "" else ", all but $back of them"
        return "the readings change suddenly ${changes.size} times$most $way, and come back slowly, as with bubbles"
    }
}
