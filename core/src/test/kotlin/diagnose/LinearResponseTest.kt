package stillwater.diagnose

import org.junit.jupiter.api.Test
import org.junit.jupiter.api.assertAll
import kotlin.math.abs
import kotlin.math.sin
import kotlin.test.assertEquals

class LinearResponseTest {
    private val times = DoubleArray(60) { it + 0.2 * sin(it * 1.3) + if (it > 40) 90.0 else 0.0 }
    private val series = MeasuredSeries(
        times,
        DoubleArray(60) { 1.5 * it },
        DoubleArray(60) { sin(it * 0.2) },
        DoubleArray(60) { sin(it * 0.1) },
        null,
    )
    private val scales = Scales(series)

    /** One more than a multiple of four. */
    private val waters = Array(5) { k -> DoubleArray(60) { sin(it * (k + 1) * 0.13) } }

    private fun models() = listOf(
        emptyList<Term>() to doubleArrayOf(),
        listOf(Term(Cause.DEAD_TIME)) to doubleArrayOf(3.3),
        listOf(Term(Cause.SECOND_ORDER_RESPONSE)) to doubleArrayOf(2.7),
        listOf(Term(Cause.TWO_PATH_RESPONSE)) to doubleArrayOf(6.0, 0.3),
        listOf(Term(Cause.FLOW_DEPENDENT_RESPONSE), Term(Cause.POSITION_OFFSET)) to doubleArrayOf(0.4, 5.0),
    )

    @Test
    fun manyWatersAreShownAsEachByItself() {
        val checks = models().flatMap { (terms, own) ->
            listOf(true, false).flatMap { held -> listOf(0.02, 4.0, 50.0).map { Triple(terms, it to own, held) } }
        }.map { (terms, numbers, held) ->
            {
                val p = doubleArrayOf(numbers.first, 1.0, 0.0, 0.0) + numbers.second
                val shown = ResponseModel(series.withReference(waters[0]), terms, held, scales).linear(p)
                    .of(waters, Loops.IN_TURN)
                for ((k, water) in waters.withIndex()) {
                    val one = DoubleArray(60)
                    ResponseModel(series.withReference(water), terms, held, scales).predict(p, one)
                    // A lag of fifty rows cancels its cube, 1e5, in each step: 1e-16 of that, fifty times over.
                    val worst = one.indices.maxOf { abs(one[it] - shown[k][it]) }
                    assertEquals(0.0, worst, 1e-9, "$terms, ${numbers.first} s, held $held, water $k")
                }
            }
        }
        assertAll(checks)
    }

    @Test
    fun aFactorTimesItselfIsWhatWasFactorised() {
        // Sizes that are and are not a multiple of the rows done at once.
        for (n in listOf(1, 3, 4, 9, 16)) {
            val matrix = Array(n) { i -> DoubleArray(n) { j -> sin(i * j + 1.0) / 9 + if (i == j) n.toDouble() else 0.0 } }
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
