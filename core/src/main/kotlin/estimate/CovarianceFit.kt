package stillwater.estimate

import kotlin.math.ln
import kotlin.math.pow

/**
 * Learns which of the [covariances] the field has, from the cells around some of the [blocks]: begun anew each time a
 * quarter more cells are visited, and so many blocks at a time that a decision can wait for them. Until the last of
 * them the weights of before hold. No call allocates but for the covariances' tables.
 */
internal class CovarianceFit(
    private val covariances: FieldCovariances,
    private val blocks: CellBlocks,
    private val regression: CellRegression,
) {
    private val logLikelihoods = DoubleArray(covariances.size)
    private val misfits = DoubleArray(covariances.size)
    private var nextFit = 1

    // Of the fit under way, or the last: how many blocks it takes, how many are done, and their cells.
    private var parts = 0
    private var done = 0
    private var count = 0

    init {
        covariances.weigh(logLikelihoods)
    }

    /** Whether no fit is under way. */
    val isComplete: Boolean get() = done == parts

    /** Standard deviations in a 97.5 % quantile over the normal distribution's, for what the amplitude leaves open. */
    var widening: Double = 1.0
        private set

    /**
     * Goes on with the fit, or begins one if it is time.
     *
     * @param cells the cells with data, the first [visited] of it. Not modified.
     * @param values their scaled values, by cell. Not modified.
     * @param variances their error variances, by cell. Not modified.
     * @param pace how much to do: so many full blocks, and at least one.
     * @return whether it did anything.
     */
    fun go(cells: IntArray, visited: Int, values: DoubleArray, variances: DoubleArray, pace: Int): Boolean {
        if (isComplete) {
            if (visited < nextFit) return false
            nextFit = visited + maxOf(1, visited / 4)
            begin(minOf(blocks.size, visited, MOST_FITTED))
        }
        // Work is the cube of the number of cells.
        var left = pace * CellBlocks.NEAREST.toDouble().pow(3)
        while (!isComplete && left > 0) {
            val block = blocks.blockOf(cells[done++ * visited / parts])
            blocks.gather(block, cells, visited, values, variances, regression)
            add()
            left -= regression.size.toDouble().pow(3)
        }
        if (isComplete) weigh(visited)
        return true
    }

    private fun begin(wanted: Int) {
        parts = wanted
        done = 0
        count = 0
        logLikelihoods.fill(0.0)
        misfits.fill(0.0)
    }

    private fun add() {
        val level = covariances.amplitudes[covariances.kept[0]]
        count += regression.size
        for (candidate in 0 until covariances.size) {
            if (!regression.solve(candidate, level)) logLikelihoods[candidate] = Double.NEGATIVE_INFINITY
            logLikelihoods[candidate] -= regression.logDeterminant / 2
            misfits[candidate] += regression.misfit
        }
    }

    /** By the marginal likelihood, eq. (5). */
    private fun weigh(visited: Int) {
        val first = FieldCovariances.FIRST_CELLS
        // Blocks may share cells, which are evidence once.
        val evidence = FieldCovariances.EVIDENCE * minOf(1.0, visited.toDouble() / count)
        val freedom = evidence * count + first
        for (candidate in 0 until covariances.size) {
            // ln p = −κ ln|A|/2 − (κn + n₀)/2 · ln(κ yᵀA⁻¹y + n₀s₀²)
            val sum = evidence * misfits[candidate] + first * FieldCovariances.FIRST_AMPLITUDE
            logLikelihoods[candidate] = evidence * logLikelihoods[candidate] - freedom / 2 * ln(sum)
            covariances.amplitudes[candidate] = sum / freedom
        }
        covariances.weigh(logLikelihoods)
        val normal = TruncatedNormal.NORMAL
        widening = 1 + (normal * normal + 1) / (4 * freedom)
    }

    private companion object {
        /** Blocks whose data the covariance is learned from, at most. */
        const val MOST_FITTED = 6
    }
}
