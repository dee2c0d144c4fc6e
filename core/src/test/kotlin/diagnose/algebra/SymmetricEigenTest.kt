package stillwater.diagnose.algebra

import org.junit.jupiter.api.Test
import kotlin.math.sin
import kotlin.test.assertEquals

class SymmetricEigenTest {
    private fun check(matrix: Array<DoubleArray>, tolerance: Double) {
        val n = matrix.size
        val eigen = SymmetricEigen(Array(n) { matrix[it].copyOf() })
        for (k in 0 until n) {
            val vector = eigen.vectors[k]
            for (i in 0 until n) {
                assertEquals(eigen.values[k] * vector[i], dot(matrix[i], vector), tolerance, "row $i of $n, vector $k")
            }
            for (other in 0..k) {
                val expected = if (other == k) 1.0 else 0.0
                assertEquals(expected, dot(vector, eigen.vectors[other]), 1e-12, "vectors $k and $other of $n")
            }
        }
    }

    @Test
    fun aMatrixTimesAVectorIsTheVectorTimesItsValue() {
        // With one, some and many columns in the last stretch, and more rotations than are noted at once.
        for (n in listOf(1, 2, 3, 5, 64, 65, 250)) {
            val matrix = Array(n) { i -> DoubleArray(n) { sin(i * it + 1.0) } }
            for (i in 0 until n) for (j in 0 until i) matrix[j][i] = matrix[i][j]
            check(matrix, 1e-11)
        }
    }

    @Test
    fun valuesMayBeAlikeOrNothing() {
        check(Array(6) { DoubleArray(6) }, 0.0)
        check(Array(6) { i -> DoubleArray(6) { if (it == i) 2.0 else 0.0 } }, 1e-15)
        // One of 5 and four of 0.
        check(Array(5) { DoubleArray(5) { 1.0 } }, 1e-14)
        check(arrayOf(doubleArrayOf(0.0, 1.0, 0.0), doubleArrayOf(1.0, 0.0, 0.0), doubleArrayOf(0.0, 0.0, 1e9)), 1e-6)
    }
}
