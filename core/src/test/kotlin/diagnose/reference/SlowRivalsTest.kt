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
import kotlin.test.assertIs

/** What looks like jumps or a drift of the calibration on few legs, and is none. */
class SlowRivalsTest {
    /** Four legs of 250 s to and fro at 1 m/s, the last one cut short. */
    private val x = DoubleArray(ROWS) { i -> (i % (2 * LEG)).let { if (it < LEG) it else 2 * LEG - it }.toDouble() }
    private val y = DoubleArray(ROWS) { i -> 4.0 * (i / LEG) }
    private val truth = DoubleArray(ROWS) { 8 + sin(x[it] / 11 + y[it]) + 0.6 * sin(x[it] / 29) }

    /** A lag of 6 s that is stepped finely, with what [shown] makes of it at a row. */
    private fun log(shown: (Int, Double) -> Double): MeasuredSeries {
        val random = Random(SEED)
        var state = truth[0]
        val values = DoubleArray(ROWS) { row ->
            if (row > 0) {
                repeat(FINE) { k ->
                    val here = truth[row - 1] + (k + 0.5) / FINE * (truth[row] - truth[row - 1])
                    state += (1 - exp(-1 / (FINE * LAG))) * (here - state)
                }
            }
            shown(row, state) + NOISE * random.nextGaussian()
        }
        return MeasuredSeries(DoubleArray(ROWS) { it.toDouble() }, x, y, values, truth)
    }

    private fun isBack(row: Int) = row / LEG % 2 == 1

    @Test
    fun anOffsetThatGoesWithTheHeadingIsNoJumps() {
        val verdict = Diagnosis(log { row, state -> state + if (isBack(row)) 0.06 else 0.0 }).run().verdict
        assertContains(assertIs<Verdict.Unexplained>(verdict, "seed $SEED, $verdict").what, "goes with the heading")
    }

    @Test
    fun jumpsElsewhereAreJumps() {
        val verdict = Diagnosis(log { row, state -> state + if (row in 180..420) 0.06 else 0.0 }).run().verdict
        assertEquals(Verdict.Named(listOf(Cause.OFFSET_STEPS)), verdict, "seed $SEED")
    }

    @Test
    fun aGainThatDriftsIsNoDrift() {
        val verdict = Diagnosis(log { row, state -> state * (1 - 0.01 * row / ROWS) }).run().verdict
        val words = assertIs<Verdict.Unexplained>(verdict, "seed $SEED, $verdict").what
        assertContains(words, Regex("a gain that falls by (0.9\\d?|1|1.[01]) % over the log"))
    }

    private companion object {
        const val SEED = 20261127L
        const val ROWS = 950
        const val LEG = 250
        const val FINE = 20
        const val LAG = 6.0
        const val NOISE = 0.01
    }
}
