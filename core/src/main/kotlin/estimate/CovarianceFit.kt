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
        if (candidate == 0) {
            val block = blocks.blockOf(cells[done * visited / parts])
            blocks.gather(block, cells, visited, values, variances, regression)
            count += regression.size
        }
        val level = covariances.amplitudes[covariances.kept[0]]
        if (!regression.solve(candidate, level)) logLikelihoods[candidate] = Double.NEGATIVE_INFINITY
        logLikelihoods[candidate] -= regression.logDeterminant / 2
        misfits[candidate] += regression.misfit
        if (++candidate == covariances.size) {
            candidate = 0
            if (++done == parts) weigh(visited)
        }
        return regression.solving
    }

    private fun begin(wanted: Int) {
        parts = wanted
        done = 0
        count = 0
        logLikelihoods.fill(0.0)
        misfits.fill(0.0)
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
