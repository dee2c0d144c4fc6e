package stillwater.estimate

import kotlin.math.abs
import kotlin.math.sqrt

/**
 * Eigenvalues and eigenvectors of a small symmetric matrix by Jacobi's rotations, largest value first.
 *
 * @param matrix `n × n`, symmetric. Not modified.
 * @property values n. @property vectors `n × n`, row k the unit vector of value k.
 */
internal class SymmetricEigen(matrix: Array<DoubleArray>) {
    val values: DoubleArray
    val vectors: Array<DoubleArray>

    init {
        val n = matrix.size
        val a = Array(n) { matrix[it].copyOf() }
        val v = Array(n) { i -> DoubleArray(n) { if (it == i) 1.0 else 0.0 } }
        repeat(SWEEPS) { for (p in 0 until n) for (q in p + 1 until n) rotate(a, v, p, q) }
        val order = (0 until n).sortedByDescending { a[it][it] }
        values = DoubleArray(n) { a[order[it]][order[it]] }
        vectors = Array(n) { v[order[it]] }
    }

    /** Turns [a] in the plane of rows [p] and [q] so that a_pq becomes 0; the rows of [v] turn with it. */
    private fun rotate(a: Array<DoubleArray>, v: Array<DoubleArray>, p: Int, q: Int) {
        if (a[p][q] == 0.0) return
        val theta = (a[q][q] - a[p][p]) / (2 * a[p][q])
        val t = (if (theta >= 0) 1 else -1) / (abs(theta) + sqrt(theta * theta + 1))
        val c = 1 / sqrt(t * t + 1)
        val s = t * c
        for (k in a.indices) {
            val kp = a[k][p]
            val kq = a[k][q]
            a[k][p] = c * kp - s * kq
            a[k][q] = s * kp + c * kq
        }
        for (k in a.indices) {
            val pk = a[p][k]
            val qk = a[q][k]
            a[p][k] = c * pk - s * qk
            a[q][k] = s * pk + c * qk
            val vp = v[p][k]
            val vq = v[q][k]
            v[p][k] = c * vp - s * vq
            v[q][k] = s * vp + c * vq
        }
    }

    private companion object {
        /** Quadratic convergence: five do for up to four dimensions. */
        const val SWEEPS = 8
    }
}
