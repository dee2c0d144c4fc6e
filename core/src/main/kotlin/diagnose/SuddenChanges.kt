package stillwater.diagnose

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

    /** What is to be said of [whitened] residuals; null where they are as noise is. */
    fun words(whitened: DoubleArray): String? {
        val far = FAR * Spikes.spread(whitened)
        val rows = whitened.indices.filter { abs(whitened[it]) > far }
        // What comes back at once, or in two steps, is one.
        val changes = rows.filterIndexed { k, row -> k == 0 || row - rows[k - 1] > 1 }
        val share = rows.sumOf { whitened[it] * whitened[it] } / squares(whitened)
        if (changes.size < FEWEST || !(share > MOST)) return null
        return "the readings change suddenly ${changes.size} times and come back slowly, as with bubbles"
    }
}
