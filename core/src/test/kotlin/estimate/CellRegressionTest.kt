package stillwater.estimate

import stillwater.model.Grid
import kotlin.math.ln
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals

/** Against Gaussian conditioning cell by cell, without a Cholesky factor or an inverse. */
class CellRegressionTest {
    private val grid = Grid.unit(4, 4)
    private val covariances = FieldCovariances(grid)
    private val regression = CellRegression(grid, covariances, grid.size)
    private val random = Random(3)
    private val seen = listOf(0, 1, 2, 6, 10, 9, 13)
    private val values = DoubleArray(grid.size) { random.nextDouble() - 0.5 }
    private val errors = DoubleArray(grid.size) { 1e-4 + 0.05 * random.nextDouble() }
    private val amplitude = 0.07

    private fun covariance(candidate: Int) = Array(grid.size) { i ->
        DoubleArray(grid.size) { j ->
            val table = covariances.table(candidate)
            val smooth = covariances.smooth(table, i % 4 - j % 4, i / 4 - j / 4)
            val own = covariances.nugget(candidate)
            amplitude * (FieldCovariances.LEVEL + (1 - own) * smooth + if (i == j) own else 0.0)
        }
    }

    private fun oracle(candidate: Int, cells: List<Int>) = DenseGaussian.condition(
        DoubleArray(grid.size),
        covariance(candidate),
        cells.map { DenseGaussian.pick(it, grid.size) },
        DoubleArray(cells.size) { values[cells[it]] },
        DoubleArray(cells.size) { errors[cells[it]] },
    )

    private fun solve(candidate: Int): DoubleArray {
        regression.clear()
        for (cell in seen) regression.add(cell, values[cell], errors[cell])
        check(regression.solve(candidate, amplitude))
        regression.invert()
        return DoubleArray(seen.size).also { regression.precisions(it) }
    }

    /** One of each family and share, and the one without a smooth part. */
    private val candidates = (0 until covariances.size).filter { it % 5 == 0 || it == covariances.size - 1 }

    @Test
    fun predictsCellsWithoutDataAsConditioningDoes() {
        for (candidate in candidates) {
            solve(candidate)
            val expected = oracle(candidate, seen)
            for (cell in (0 until grid.size) - seen.toSet()) {
                // Conditions of up to 1e5, sixteen digits.
                assertEquals(expected.mean[cell], regression.mean(cell), 1e-9)
                assertEquals(expected.covariance[cell][cell], amplitude * regression.variance(), 1e-9)
            }
        }
    }

    @Test
    fun predictsACellWithDataFromTheOthersAsIfItHadNone() {
        for (candidate in candidates) {
            val precisions = solve(candidate)
            for ((i, cell) in seen.withIndex()) {
                val expected = oracle(candidate, seen - cell)
                assertEquals(expected.mean[cell], regression.meanLeftOut(i, precisions[i]), 1e-9)
                val variance = amplitude * regression.varianceLeftOut(i, precisions[i], amplitude)
                assertEquals(expected.covariance[cell][cell], variance, 1e-9)
            }
        }
    }

    @Test
    fun likelihoodIsTheProductOfThePredictionsOneAfterAnother() {
        for (candidate in candidates) {
            solve(candidate)
            var misfit = 0.0
            var logDeterminant = 0.0
            for (k in seen.indices) {
                val before = oracle(candidate, seen.take(k))
                val cell = seen[k]
                val variance = (before.covariance[cell][cell] + errors[cell]) / amplitude
                misfit += (values[cell] - before.mean[cell]).let { it * it } / variance
                logDeterminant += ln(variance)
            }
            assertEquals(misfit, regression.misfit, 1e-8 * misfit)
            assertEquals(logDeterminant, regression.logDeterminant, 1e-8)
        }
    }
}
