package stillwater.diagnose.response

import org.junit.jupiter.api.Test
import stillwater.diagnose.Cause
import stillwater.diagnose.Loops
import stillwater.diagnose.MeasuredSeries
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
        for ((terms, own) in models()) {
            for (lag in listOf(0.02, 4.0, 20.0)) {
                for (steps in Steps.entries) check(terms, doubleArrayOf(lag, 1.0, 0.0, 0.0) + own, steps)
            }
        }
    }

    private fun check(terms: List<Term>, p: DoubleArray, steps: Steps) {
        fun model(water: DoubleArray) = ResponseModel(series.withReference(water), terms, steps, scales)
        val shown = List(waters.size) { DoubleArray(60) }
        model(waters[0]).linear(p).of(waters, Loops.IN_TURN, shown)
        for ((k, water) in waters.withIndex()) {
            val one = DoubleArray(60).also { model(water).predict(p, it) }
            // A lag of twenty rows or some forty, where the boat is slow, cancels its cube, 1e5, in each step.
            val worst = one.indices.maxOf { abs(one[it] - shown[k][it]) }
            assertEquals(0.0, worst, 1e-9, "$terms, ${p[0]} s, $steps, water $k")
        }
    }
}
