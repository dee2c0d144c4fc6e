package stillwater.diagnose.response

import org.junit.jupiter.api.Assertions.assertArrayEquals
import stillwater.diagnose.Cause
import stillwater.diagnose.MeasuredSeries
import kotlin.math.PI
import kotlin.math.exp
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.test.Test
import kotlin.test.assertTrue

/** What a sensor with a cause shows, against the same in steps far finer than the rows. */
class ResponseModelTest {
    private val n = 300
    private val times = DoubleArray(n) { it.toDouble() }

    private fun truth(t: Double) = sin(2 * PI * t / 9.3) + 0.3 * sin(2 * PI * t / 23)

    private fun play(state: Double, at: Double) = state.coerceIn(at - WIDTH / 2, at + WIDTH / 2)

    @Test
    fun aPlayTurnsBetweenTheRows() {
        val truth = DoubleArray(n) { truth(times[it]) }
        val fine = DoubleArray(n)
        var state = truth[0]
        for (i in 1 until n) {
            for (k in 1..FINER) state = play(state, truth(i - 1 + k.toDouble() / FINER))
            fine[i] = state
        }
        val coarse = DoubleArray(n)
        coarse[0] = truth[0]
        for (i in 1 until n) coarse[i] = play(coarse[i - 1], truth[i])

        val series = MeasuredSeries(times, times, DoubleArray(n), truth, truth)
        val model = ResponseModel(series, listOf(Term(Cause.HYSTERESIS)), Steps.EVEN, Scales(series))
        val shown = DoubleArray(n)
        model.predict(doubleArrayOf(1e-3, 1.0, 0.0, 0.0, WIDTH), shown)

        fun off(column: DoubleArray) = sqrt((FIRST until n).sumOf { (column[it] - fine[it]).let { e -> e * e } })
        assertTrue(off(shown) < off(coarse) / 3, "${off(shown)} for ${off(coarse)} at the rows alone")
    }

    /** The two ways in which simulations step a sensor once a row. */
    @Test
    fun heldStepsAreShownAsASimulationInSuchStepsShowsThem() {
        val truth = DoubleArray(n) { truth(times[it]) }
        for ((steps, rowsBefore) in mapOf(Steps.HELD to 0, Steps.UNTIL_NEXT to 1)) {
            val stepped = DoubleArray(n)
            stepped[0] = truth[0]
            for (i in 1 until n) {
                stepped[i] = stepped[i - 1] + (1 - exp(-1 / 6.0)) * (truth[i - rowsBefore] - stepped[i - 1])
            }
            val series = MeasuredSeries(times, times, DoubleArray(n), truth, truth)
            val shown = DoubleArray(n)
            ResponseModel(series, emptyList(), steps, Scales(series)).predict(doubleArrayOf(6.0, 1.0, 0.0, 0.0), shown)
            assertArrayEquals(stepped, shown, 1e-12, "$steps")
        }
    }

    private companion object {
        const val WIDTH = 0.5
        const val FINER = 200
        const val FIRST = 10
    }
}
