package stillwater.diagnose.algebra

import kotlin.math.sqrt

/** Normal equations of a least-squares problem. */
internal class SymmetricSystem(private val matrix: Array<DoubleArray>, private val right: DoubleArray) {
    private val size = right.size

    /** The step that solves (A + damping diag A) step = right; columns without weight stay where they are. */
    fun solve(damping: Double): DoubleArray {
        val scale = DoubleArray(size) { if (matrix[it][it] > 0) 1 / sqrt(matrix[it][it]) else 0.0 }
        val lower = factor(scale, damping + 1e-12)
        val step = DoubleArray(size) { right[it] * scale[it] }
        for (i in 0 until size) {
            for (j in 0 until i) step[i] -= lower[i][j] * step[j]
            step[i] /= lower[i][i]
        }
        for (i in size - 1 downTo 0) {
            for (j in i + 1 until size) step[i] -= lower[j][i] * step[j]
            step[i] /= lower[i][i]
        }
        return DoubleArray(size) { step[it] * scale[it] }
    }

    /** Element ([k], [k]) of the inverse. */
    fun inverseDiagonal(k: Int): Double {
        val unit = SymmetricSystem(matrix, DoubleArray(size) { if (it == k) 1.0 else 0.0 })
        return unit.solve(0.0)[k]
    }

    private fun factor(scale: DoubleArray, damping: Double): Array<DoubleArray> {
        val lower = Array(size) { DoubleArray(size) }
        for (i in 0 until size) {
            for (j in 0..i) {
                var sum = if (i == j) 1 + damping else matrix[i][j] * scale[i] * scale[j]
                for (k in 0 until j) sum -= lower[i][k] * lower[j][k]
                lower[i][j] = if (i == j) sqrt(maxOf(sum, 1e-14)) else sum / lower[j][j]
            }
        }
        return lower
    }

    companion object {
        /** The normal equations of [columns] and the vector [target]. */
        fun of(columns: Array<DoubleArray>, target: DoubleArray): SymmetricSystem {
            val matrix = Array(columns.size) { DoubleArray(columns.size) }
            val right = DoubleArray(columns.size)
            for ((i, column) in columns.withIndex()) {
                val products = dots(column, columns.take(i + 1) + target)
                for (j in 0..i) {
                    matrix[i][j] = products[j]
                    matrix[j][i] = products[j]
                }
                right[i] = products[i + 1]
            }
            return SymmetricSystem(matrix, right)
        }
    }
}
