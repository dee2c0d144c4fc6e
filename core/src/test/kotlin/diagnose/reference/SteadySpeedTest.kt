package stillwater.diagnose.reference

import stillwater.diagnose.Cause
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import java.util.Random
import kotlin.math.exp
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals

/** A boat on two crossing legs, whose probe is late: at one speed all the time nothing tells a dead time from a place. */
class SteadySpeedTest {
    private val rows = 800

    private fun diagnosed(way: (Double) -> Double) = Random(SEED).let { random ->
        fun x(time: Double) = if (way(time) < HALF) way(time) else HALF
        fun y(time: Double) = if (way(time) < HALF) 0.0 else way(time) - HALF
        fun water(time: Double) = sin(x(time) / 4) + sin(y(time) / 5 + x(time) / 9) + sin((x(time) + y(time)) / 7)
        var state = water(-DELAY)
        val values = DoubleArray(rows) { row ->
            for (step in 0 until if (row > 0) STEPS else 0) {
                val seen = water(row - 1 + (step + 0.5) / STEPS - DELAY)
                state += (1 - exp(-1 / (STEPS * LAG))) * (seen - state)
            }
            state + NOISE * random.nextGaussian()
        }
        val times = DoubleArray(rows) { it.toDouble() }
        fun of(column: (Double) -> Double) = DoubleArray(rows) { column(times[it]) }
        Diagnosis(MeasuredSeries(times, of(::x), of(::y), values, of(::water))).run()
    }

    @Test
    fun aDeadTimeMayBeAPlaceAndTwoSpeedsWouldTell() {
        val result = diagnosed { 0.5 * it }
        val both = listOf(Cause.DEAD_TIME, Cause.POSITION_OFFSET)
        assertEquals(Verdict.Ambiguous(listOf(both)), result.verdict, "seed $SEED")
        assertContains(checkNotNull(result.separatingManoeuvre), "speed")
    }

    @Test
    fun atSeveralSpeedsItIsADeadTime() {
        val result = diagnosed { 0.5 * it + 2 * sin(it / 15) }
        assertEquals(Verdict.Named(listOf(Cause.DEAD_TIME)), result.verdict, "seed $SEED")
    }

    private companion object {
        const val SEED = 20261129L
        const val HALF = 200.0
        const val DELAY = 3.0
        const val LAG = 6.0
        const val NOISE = 0.02
        const val STEPS = 50
    }
}
