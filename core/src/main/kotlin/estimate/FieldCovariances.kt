package stillwater.estimate

import stillwater.model.Grid
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.hypot
import kotlin.math.ln
import kotlin.math.min
import kotlin.math.sqrt

/**
 * The covariances that a [BayesianMap] holds for possible: a smooth part with a correlation length, a part of each cell
 * alone, and an unknown level, with a belief in each.
 *
 * Correlation of cells at the distance d: (1 − ν) ρ(d/ℓ) + ν [d = 0], with ρ one of three families: exp(−r²/2), as
 * smooth as can be; 1/(1 + r²/2), smooth with lengths of all sizes (rational quadratic); (1 + √3 r) exp(−√3 r), rough
 * (Matérn of smoothness 3/2). The level adds [LEVEL] to every covariance. All over the amplitude s², which
 * has a belief of its own in each candidate. Source: Rasmussen and Williams 2006, Gaussian Processes for Machine
 * Learning, eqs. (4.9), (4.17), (4.19) and (2.30); core/docs/BayesianMap.md.
 */
internal class FieldCovariances(grid: Grid) {
    private val side = sqrt(grid.cellWidth) * sqrt(grid.cellHeight)
    private val across = grid.cellWidth / side
    private val along = grid.cellHeight / side
    private val columns = min(grid.columns, FARTHEST)
    private val rows = min(grid.rows, FARTHEST)

    /** Correlation lengths ℓ, sides of a cell. */
    private val lengths = lengths(grid)
    private val tables = arrayOfNulls<DoubleArray>(lengths.size * FAMILIES)

    /** Number of candidates. The last is the one without a smooth part. */
    val size: Int = tables.size * NUGGETS.size + 1

    /** What is believed of each candidate before data: the logarithm of a weight. */
    private val logPrior = DoubleArray(size) { candidate ->
        // One length unit of the logarithm about two cells; without a smooth part as likely as any length.
        if (candidate ==
            size - 1
        ) {
            ln(NUGGETS.size.toDouble() * FAMILIES)
        } else {
            -ln(length(candidate) / 2).let { it * it } / 2
        }
    }

    /** Weight of each candidate; those that are held for possible, at most [MOST_KEPT], add up to 1. */
    val weights: DoubleArray = DoubleArray(size)

    /** s² of each candidate, scaled. */
    val amplitudes: DoubleArray = DoubleArray(size) { FIRST_AMPLITUDE }

    /** The candidates that are held for possible, the likeliest first: the first [keptCount] of it. */
    val kept: IntArray = IntArray(MOST_KEPT)

    /** Number of candidates in [kept]. */
    var keptCount: Int = 0
        private set

    /** Correlation length of [candidate], sides of a cell. */
    fun length(candidate: Int): Double = lengths[tableOf(candidate) % lengths.size]

    /** ν of [candidate]: the part of each cell alone. */
    fun nugget(candidate: Int): Double = if (candidate == size - 1) 1.0 else NUGGETS[candidate % NUGGETS.size]

    /** The table of ρ for [candidate], to look up with [smooth]. Allocates the first time. */
    fun table(candidate: Int): DoubleArray {
        val index = tableOf(candidate)
        return tables[index] ?: DoubleArray(columns * rows) {
            val distance = hypot(it % columns * across, it / columns * along)
            correlation(index / lengths.size, distance / lengths[index % lengths.size])
        }.also { tables[index] = it }
    }

    private fun tableOf(candidate: Int) = min(candidate / NUGGETS.size, tables.size - 1)

    /** ρ of two cells so many columns and rows apart, from the [table] of a candidate. */
    fun smooth(table: DoubleArray, columnsApart: Int, rowsApart: Int): Double {
        val column = abs(columnsApart)
        val row = abs(rowsApart)
        // As far away as the table's end: 128 cells. Nearer ones are data enough.
        return table[min(row, rows - 1) * columns + min(column, columns - 1)]
    }

    private fun correlation(family: Int, r: Double) = when (family) {
        0 -> exp(-r * r / 2)
        1 -> 1 / (1 + r * r / 2)
        else -> (1 + ROOT_THREE * r) * exp(-ROOT_THREE * r)
    }

    /**
     * Weighs the candidates by their marginal likelihood.
     *
     * @param logLikelihoods of each candidate, length [size]. Not modified.
     */
    fun weigh(logLikelihoods: DoubleArray) {
        keptCount = 0
        weights.fill(0.0)
        var best = 0.0
        var sum = 0.0
        while (keptCount < MOST_KEPT) {
            var likeliest = -1
            for (i in 0 until size) {
                if (weights[i] > 0 || !logLikelihoods[i].isFinite()) continue
                if (likeliest < 0 ||
                    logLikelihoods[i] + logPrior[i] > logLikelihoods[likeliest] + logPrior[likeliest]
                ) {
                    likeliest = i
                }
            }
            if (likeliest < 0) break
            val log = logLikelihoods[likeliest] + logPrior[likeliest]
            if (keptCount == 0) best = log
            val weight = exp(log - best)
            if (weight < LEAST_WEIGHT) break
            kept[keptCount++] = likeliest
            weights[likeliest] = weight
            sum += weight
        }
        for (i in 0 until keptCount) weights[kept[i]] /= sum
    }

    companion object {
        /** What is believed of s² beforehand: the variance of a value that may be anywhere in the prior's range. */
        const val FIRST_AMPLITUDE = 1.0 / 12

        /** How many cells' worth of evidence that is. */
        const val FIRST_CELLS = 2.0

        /**
         * How much a cell's evidence counts about the covariance. Less than 1, because no candidate is exactly the
         * field's: with 1 the posterior is surer than its predictions are good.
         */
        const val EVIDENCE = 0.2

        /** Variance of the level over s². */
        const val LEVEL = 1.0

        /** Candidates held for possible at once. */
        const val MOST_KEPT = 5
        private const val LEAST_WEIGHT = 0.03
        private const val FARTHEST = 129
        private const val SHORTEST = 0.75
        private const val MOST_LENGTHS = 12
        private val NUGGETS = doubleArrayOf(0.0, 1e-2, 0.1, 0.4)
        private const val FAMILIES = 3
        private val ROOT_TWO = sqrt(2.0)
        private val ROOT_THREE = sqrt(3.0)

        private fun lengths(grid: Grid): DoubleArray {
            val longest = 0.75 * maxOf(grid.columns, grid.rows, 2)
            val count = 1 + (ln(longest / SHORTEST) / ln(ROOT_TWO)).toInt()
            var length = SHORTEST / ROOT_TWO
            return DoubleArray(count.coerceIn(2, MOST_LENGTHS)) {
                length *= ROOT_TWO
                length
            }
        }
    }
}
