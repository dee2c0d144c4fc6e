package stillwater.estimate

import stillwater.model.Grid
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * Regression of a Gaussian process on cells with data: dense, for as many cells as it has room for. A reusable workspace;
 * no allocation.
 *
 * With R the correlations of the cells with data, D their error variances over s², A = R + D = L Lᵀ and y their values:
 * what the other cells say of one of them is, by Sundararajan and Keerthi 2001 (doi:10.1162/08997660151134343),
 *
 *     mean y_i − [A⁻¹y]_i / [A⁻¹]_ii,   variance s² (1 / [A⁻¹]_ii − D_i),
 *
 * and what all say of another cell, with r its correlations with them,
 *
 *     mean rᵀA⁻¹y,   variance s² (1 + level − rᵀA⁻¹r).
 *
 * @param capacity cells with data it can hold.
 */
internal class CellRegression(private val grid: Grid, private val covariances: FieldCovariances, capacity: Int) {
    private val cells = IntArray(capacity)
    private val columns = IntArray(capacity)
    private val rows = IntArray(capacity)
    private val values = DoubleArray(capacity)
    private val errors = DoubleArray(capacity)
    private val factors = DoubleArray(capacity * capacity)
    private val inverse = DoubleArray(capacity * capacity)
    private val stride = capacity

    /** A⁻¹ y. */
    private val weights = DoubleArray(capacity)
    private val work = DoubleArray(capacity)
    private var table = DoubleArray(0)
    private var nugget = 0.0

    /** Cells with data it holds. */
    var size: Int = 0
        private set

    /** yᵀ A⁻¹ y of the last [solve]. */
    var misfit: Double = 0.0
        private set

    /** ln |A| of the last [solve]. */
    var logDeterminant: Double = 0.0
        private set

    /** What [solve] takes, multiplications and additions, about; [invert] takes the same. */
    val solving: Double get() = size.toDouble() * size * size / 6

    /** What [mean] and [variance] of one cell take. */
    val predicting: Double get() = size.toDouble() * size / 2

    /** Forgets all cells. */
    fun clear() {
        size = 0
    }

    /** Number [i] of the cells with data. */
    fun cell(i: Int): Int = cells[i]

    /** Adds [cell] with a scaled value and error variance. */
    fun add(cell: Int, value: Double, variance: Double) {
        cells[size] = cell
        columns[size] = cell % grid.columns
        rows[size] = cell / grid.columns
        values[size] = value
        errors[size++] = variance
    }

    /**
     * Solves for [candidate] with [amplitude] as s², scaled.
     *
     * @return false if numbers do not allow it; then there is no solution.
     */
    fun solve(candidate: Int, amplitude: Double): Boolean {
        table = covariances.table(candidate)
        nugget = covariances.nugget(candidate)
        logDeterminant = 0.0
        misfit = 0.0
        for (i in 0 until size) {
            val row = i * stride
            for (j in 0 until i) {
                val sum = dot(factors, row, factors, j * stride, j)
                factors[row + j] =
                    (correlation(columns[i] - columns[j], rows[i] - rows[j]) - sum) / factors[j * stride + j]
            }
            val diagonal = 1 + FieldCovariances.LEVEL + maxOf(errors[i] / amplitude, LEAST_ERROR) -
                dot(factors, row, factors, row, i)
            if (!(diagonal > 0)) return false
            val root = sqrt(diagonal)
            factors[row + i] = root
            logDeterminant += 2 * ln(root)
            val scaled = (values[i] - dot(factors, row, work, 0, i)) / root
            work[i] = scaled
            misfit += scaled * scaled
        }
        return misfit.isFinite()
    }

    /** After [solve]: what [precisions] and what is left out of each reading need. */
    fun invert() {
        for (i in 0 until size) {
            val row = i * stride
            val root = factors[row + i]
            for (j in 0..i) inverse[row + j] = 0.0
            for (k in 0 until i) {
                val factor = factors[row + k] / root
                val other = k * stride
                for (j in 0..k) inverse[row + j] -= factor * inverse[other + j]
            }
            inverse[row + i] = 1 / root
        }
        for (i in 0 until size) weights[i] = 0.0
        for (k in 0 until size) {
            val row = k * stride
            val scaled = work[k]
            for (i in 0..k) weights[i] += inverse[row + i] * scaled
        }
    }

    /** [A⁻¹]_ii of each cell. Written into [into], length at least [size]. Modified. */
    fun precisions(into: DoubleArray) {
        for (i in 0 until size) into[i] = 0.0
        for (k in 0 until size) {
            val row = k * stride
            for (i in 0..k) into[i] += inverse[row + i] * inverse[row + i]
        }
    }

    /** Mean of cell [i] of those with data, by the others, [precision] being its [A⁻¹]_ii. */
    fun meanLeftOut(i: Int, precision: Double): Double = values[i] - weights[i] / precision

    /** Variance over s² of the same. */
    fun varianceLeftOut(i: Int, precision: Double, amplitude: Double): Double =
        1 / precision - maxOf(errors[i] / amplitude, LEAST_ERROR)

    /** Mean of a cell without data. */
    fun mean(cell: Int): Double {
        val column = cell % grid.columns
        val row = cell / grid.columns
        for (i in 0 until size) work[i] = correlation(columns[i] - column, rows[i] - row)
        return dot(work, 0, weights, 0, size)
    }

    /** Variance over s² of the cell of which [mean] was just asked. */
    fun variance(): Double {
        var known = 0.0
        for (i in 0 until size) {
            val part = dot(inverse, i * stride, work, 0, i + 1)
            known += part * part
        }
        return 1 + FieldCovariances.LEVEL - known
    }

    /** Of two different cells. */
    private fun correlation(columnsApart: Int, rowsApart: Int) =
        FieldCovariances.LEVEL + (1 - nugget) * covariances.smooth(table, columnsApart, rowsApart)

    private companion object {
        /** Least error variance over s² that the numbers' precision allows. */
        const val LEAST_ERROR = 1e-8

        /** Four sums at once: one alone waits for its own last addition. */
        fun dot(a: DoubleArray, atA: Int, b: DoubleArray, atB: Int, length: Int): Double {
            var s0 = 0.0
            var s1 = 0.0
            var s2 = 0.0
            var s3 = 0.0
            var k = 0
            while (k + 3 < length) {
                s0 += a[atA + k] * b[atB + k]
                s1 += a[atA + k + 1] * b[atB + k + 1]
                s2 += a[atA + k + 2] * b[atB + k + 2]
                s3 += a[atA + k + 3] * b[atB + k + 3]
                k += 4
            }
            while (k < length) {
                s0 += a[atA + k] * b[atB + k]
                k++
            }
            return s0 + s1 + (s2 + s3)
        }
    }
}
