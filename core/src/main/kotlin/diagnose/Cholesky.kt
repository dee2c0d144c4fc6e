package stillwater.diagnose

import kotlin.math.ln
import kotlin.math.sqrt

/**
 * L with L Lᵀ = [lower], of which row i holds the first i + 1 elements at least; modified.
 *
 * Rows are arrays of their own, and innermost loops run along them, so that several neighbours are done in one step.
 */
internal class Cholesky(private val lower: Array<DoubleArray>) {
    private val n = lower.size

    /** Logarithm of the determinant. */
    val logDeterminant: Double

    init {
        var sum = 0.0
        val column = DoubleArray(n)
        for (j in 0 until n) {
            val pivot = sqrt(maxOf(lower[j][j], TINY))
            sum += 2 * ln(pivot)
            lower[j][j] = pivot
            for (i in j + 1 until n) {
                column[i] = lower[i][j] / pivot
                lower[i][j] = column[i]
            }
            for (i in j + 1 until n) subtract(lower[i], column[i], column, j + 1, i + 1)
        }
        logDeterminant = sum
    }

    /** Lᵀ, row by row, each as long as the matrix is wide. */
    private val upper by lazy { Array(n) { k -> DoubleArray(n) { if (it >= k) lower[it][k] else 0.0 } } }

    /** L⁻¹ [right]; new. */
    fun half(right: DoubleArray): DoubleArray {
        val out = right.copyOf()
        for (k in 0 until n) {
            out[k] /= lower[k][k]
            subtract(out, out[k], upper[k], k + 1, n)
        }
        return out
    }

    /** L⁻ᵀ [right]; new. */
    fun back(right: DoubleArray): DoubleArray {
        val out = right.copyOf()
        for (i in n - 1 downTo 0) {
            out[i] /= lower[i][i]
            subtract(out, out[i], lower[i], 0, i)
        }
        return out
    }

    /** The diagonal of the inverse of what was factorised. */
    fun inverseDiagonal(): DoubleArray {
        val inverse = Array(n) { DoubleArray(it + 1) }
        val out = DoubleArray(n)
        for (i in 0 until n) {
            val own = inverse[i]
            for (k in 0 until i) subtract(own, lower[i][k], inverse[k], 0, k + 1)
            val pivot = lower[i][i]
            for (j in 0 until i) own[j] /= pivot
            own[i] = 1 / pivot
            for (j in 0..i) out[j] += own[j] * own[j]
        }
        return out
    }

    private fun subtract(from: DoubleArray, times: Double, what: DoubleArray, start: Int, end: Int) {
        for (k in start until end) from[k] -= times * what[k]
    }

    private companion object {
        const val TINY = 1e-12
    }
}
