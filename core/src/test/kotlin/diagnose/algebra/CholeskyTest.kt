package stillwater.diagnose.algebra

import org.junit.jupiter.api.Test
import kotlin.math.sin
import kotlin.test.assertEquals

class CholeskyTest {
    @Test
    fun aFactorTimesItselfIsWhatWasFactorised() {
        // Sizes that are and are not a multiple of the rows done at once.
        for (n in listOf(1, 3, 4, 9, 16)) {
            val matrix = Array(n) { i -> DoubleArray(n) { sin(i * it + 1.0) / 9 + if (it == i) n.toDouble() else 0.0 } }
            for (i in 0 until n) for (j in 0 until i) matrix[j][i] = matrix[i][j]
            val factor = Cholesky(Array(n) { matrix[it].copyOf() })
            val right = DoubleArray(n) { it - 1.5 }
            val solved = factor.back(factor.half(right))
            // A few roundings of numbers near one.
            for (i in 0 until n) assertEquals(right[i], dot(matrix[i], solved), 1e-12, "row $i of $n")
            val diagonal = factor.inverseDiagonal()
            for (i in 0 until n) {
                val unit = factor.back(factor.half(DoubleArray(n) { if (it == i) 1.0 else 0.0 }))
                assertEquals(unit[i], diagonal[i], 1e-13, "element $i of $n")
            }
        }
    }
}
