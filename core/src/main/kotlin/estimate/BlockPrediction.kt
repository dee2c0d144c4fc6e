package stillwater.estimate

import stillwater.model.Grid

/**
 * What the cells with data say of each cell of one block, the covariances that are held for possible one after the other,
 * so that a prediction may be left and gone on with: it is of the data as they were when it began. A reusable workspace;
 * no call allocates but for the covariances' tables.
 *
 * Means and variances of the candidates are pooled to first and second moments; core/docs/BayesianMap.md, eqs. (3), (4).
 */
internal class BlockPrediction(
    private val grid: Grid,
    private val covariances: FieldCovariances,
    private val blocks: CellBlocks,
) {
    private val regression = CellRegression(grid, covariances, blocks.capacity)
    private val precisions = DoubleArray(blocks.capacity)

    // Of the block's cells, row by row.
    private val firsts = DoubleArray(blocks.mostCells)
    private val seconds = DoubleArray(blocks.mostCells)
    private val isMeasured = BooleanArray(blocks.mostCells)
    private var unmeasured = 0
    private var solved = 0.0
    private var next = 0

    /** The block that is under way, or whose prediction is complete; −1 where there is none. */
    var block: Int = NONE
        private set

    /** Whether all candidates are in. */
    val isComplete: Boolean get() = block != NONE && next >= covariances.keptCount

    /**
     * Begins the prediction of [block].
     *
     * @param cells the cells with data, the first [count] of it. Not modified.
     * @param values their scaled values, by cell. Not modified.
     * @param variances their error variances, by cell, NaN where a cell was not measured. Not modified.
     */
    fun begin(block: Int, cells: IntArray, count: Int, values: DoubleArray, variances: DoubleArray) {
        this.block = block
        blocks.looks(block, blocks.gather(block, cells, count, values, variances, regression))
        next = 0
        solved = 0.0
        unmeasured = 0
        blocks.forEachCell(block) { cell, place ->
            firsts[place] = 0.0
            seconds[place] = 0.0
            isMeasured[place] = !variances[cell].isNaN()
            if (!isMeasured[place]) unmeasured++
        }
    }

    /** Forgets the block. */
    fun drop() {
        block = NONE
    }

    /** Takes the next candidate in, where not all are. Answers how much work that was, multiplications and additions. */
    fun go(): Double {
        val candidate = covariances.kept[next++]
        val amplitude = covariances.amplitudes[candidate]
        if (!regression.solve(candidate, amplitude)) return regression.solving
        regression.invert()
        regression.precisions(precisions)
        val weight = covariances.weights[candidate]
        solved += weight
        for (i in 0 until regression.size) {
            val cell = regression.cell(i)
            if (blocks.blockOf(cell) != block) continue
            val variance = regression.varianceLeftOut(i, precisions[i], amplitude)
            pool(blocks.placeOf(cell), weight, regression.meanLeftOut(i, precisions[i]), amplitude * variance)
        }
        blocks.forEachCell(block) { cell, place ->
            if (!isMeasured[place]) {
                val mean = regression.mean(cell)
                pool(place, weight, mean, amplitude * regression.variance())
            }
        }
        return 2 * regression.solving + unmeasured * regression.predicting
    }

    /** Mean of the cell at [place] of the block; not a number where no candidate could be solved. */
    fun mean(place: Int): Double = firsts[place] / solved

    /** Variance of the same, about its [mean]; of a field that varies alike everywhere. */
    fun variance(place: Int, mean: Double): Double = seconds[place] / solved - mean * mean

    /** Adds a candidate's mean and variance of the cell at [place] to the first two moments. */
    private fun pool(place: Int, weight: Double, mean: Double, variance: Double) {
        firsts[place] += weight * mean
        seconds[place] += weight * (maxOf(variance, 0.0) + mean * mean)
    }

    private companion object {
        const val NONE = -1
    }
}
