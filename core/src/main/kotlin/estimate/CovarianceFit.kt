package stillwater.estimate

import stillwater.model.Grid
import kotlin.math.ln

/**
 * Learns which of the [covariances] the field has, from the cells around some of the [blocks]: begun anew each time a
 * quarter more cells are visited, and one candidate's look at one block at a time, so that a decision can wait for it.
 * Until the last of them the weights of before hold. No call allocates but for the covariances' tables.
 */
internal class CovarianceFit(
    grid: Grid,
    private val covariances: FieldCovariances,
    private val blocks: CellBlocks,
) {
    private val regression = CellRegression(grid, covariances, blocks.capacity)
    private val logLikelihoods = DoubleArray(covariances.size)
    private val misfits = DoubleArray(covariances.size)
    private var nextFit = 1

    // Of the fit under way, or the last: how many blocks it takes, how many are done, their cells, and the next candidate.
    private var parts = 0
    private var done = 0
    private var count = 0
    private var candidate = 0
    private var isBetweenBlocks = true

    init {
        covariances.weigh(logLikelihoods)
    }

    /** Whether no fit is under way. */
    val isComplete: Boolean get() = done == parts

    /** Standard deviations in a 97.5 % quantile over the normal distribution's, for what the amplitude leaves open. */
    var widening: Double = 1.0
        private set

    /**
     * Begins a fit if it is time.
     *
     * @param visited how many cells have data.
     */
    fun beginIfDue(visited: Int) {
        if (!isComplete || visited < nextFit) return
        nextFit = visited + maxOf(1, visited / 4)
        begin(minOf(blocks.size, visited, MOST_FITTED))
    }

    /**
     * Goes on with the fit that is under way: one candidate's look at one block.
     *
     * @param cells the cells with data, the first [visited] of it. Not modified.
     * @param values their scaled values, by cell. Not modified.
     * @param variances their error variances, by cell. Not modified.
     * @return how much work that was, multiplications and additions.
     */
    fun go(cells: IntArray, visited: Int, values: DoubleArray, variances: DoubleArray): Double {
        if (isBetweenBlocks) {
            isBetweenBlocks = false
            val block = blocks.blockOf(cells[done * visited / parts])
            blocks.gather(block, cells, visited, values, variances, regression)
            count += regression.size
        }
        val level = covariances.amplitudes[covariances.kept[0]]
        if (!regression.solve(candidate, level)) logLikelihoods[candidate] = Double.NEGATIVE_INFINITY
        logLikelihoods[candidate] -= regression.logDeterminant / 2
        misfits[candidate] += regression.misfit
        do candidate++ while (candidate < covariances.size && logLikelihoods[candidate] == Double.NEGATIVE_INFINITY)
        if (candidate == covariances.size) endBlock(visited)
        return regression.solving
    }

    private fun endBlock(visited: Int) {
        candidate = 0
        isBetweenBlocks = true
        done++
        if (done == parts) {
            weigh(visited)
            return
        }
        if (done < FEWEST_TO_JUDGE) return
        var best = Double.NEGATIVE_INFINITY
        for (k in 0 until covariances.size) best = maxOf(best, logLikelihood(k, visited))
        for (k in 0 until covariances.size) {
            if (logLikelihood(k, visited) < best - HOPELESS) logLikelihoods[k] = Double.NEGATIVE_INFINITY
        }
        while (candidate < covariances.size - 1 && logLikelihoods[candidate] == Double.NEGATIVE_INFINITY) candidate++
    }

    private fun begin(wanted: Int) {
        parts = wanted
        done = 0
        count = 0
        candidate = 0
        isBetweenBlocks = true
        logLikelihoods.fill(0.0)
        misfits.fill(0.0)
    }

    /** Of [candidate], by the blocks so far: the marginal likelihood's logarithm, eq. (5). */
    private fun logLikelihood(candidate: Int, visited: Int): Double {
        val evidence = evidence(visited)
        // ln p = −κ ln|A|/2 − (κn + n₀)/2 · ln(κ yᵀA⁻¹y + n₀s₀²)
        return evidence * logLikelihoods[candidate] - freedom(evidence) / 2 * ln(sum(candidate, evidence))
    }

    /** κ; blocks may share cells, which are evidence once. */
    private fun evidence(visited: Int) = FieldCovariances.EVIDENCE * minOf(1.0, visited.toDouble() / count)

    private fun freedom(evidence: Double) = evidence * count + FieldCovariances.FIRST_CELLS

    private fun sum(candidate: Int, evidence: Double) =
        evidence * misfits[candidate] + FieldCovariances.FIRST_CELLS * FieldCovariances.FIRST_AMPLITUDE

    private fun weigh(visited: Int) {
        val evidence = evidence(visited)
        val freedom = freedom(evidence)
        for (candidate in 0 until covariances.size) {
            logLikelihoods[candidate] = logLikelihood(candidate, visited)
            covariances.amplitudes[candidate] = sum(candidate, evidence) / freedom
        }
        covariances.weigh(logLikelihoods)
        val normal = TruncatedNormal.NORMAL
        widening = 1 + (normal * normal + 1) / (4 * freedom)
    }

    private companion object {
        /** Blocks whose data the covariance is learned from, at most. */
        const val MOST_FITTED = 6

        /** After so many a candidate is dropped that is so much less likely, on a logarithm's scale, than the best. */
        const val FEWEST_TO_JUDGE = 2
        const val HOPELESS = 12.0
    }
}
