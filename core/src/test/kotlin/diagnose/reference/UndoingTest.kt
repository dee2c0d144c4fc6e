package stillwater.diagnose.reference

import stillwater.diagnose.Cause
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.DiagnosisResult
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import java.util.Random
import kotlin.math.exp
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertEquals

/** A probe ahead of the fixes on a hose: at the usual speed one undoes the other. */
class UndoingTest {
    private val rows = 1000

    /** Metres along a straight way after [time] s, at 0.4 to 0.8 m/s. */
    private fun way(time: Double) = 0.6 * time + 2.6 * sin(time / 13)

    private fun water(way: Double) = sin(way / 3) + sin(way / 5 + 1) + 0.7 * sin(way / 8)

    private fun diagnosed(seed: Long, ahead: Double, delay: Double): DiagnosisResult {
        val random = Random(seed)
        var state = water(ahead)
        val values = DoubleArray(rows) { row ->
            for (step in 0 until if (row > 0) STEPS else 0) {
                val seen = water(way(row - 1 + (step + 0.5) / STEPS - delay) + ahead)
                state += (1 - exp(-1 / (STEPS * LAG))) * (seen - state)
            }
            state + NOISE * random.nextGaussian()
        }
        val times = DoubleArray(rows) { it.toDouble() }
        val x = DoubleArray(rows) { way(times[it]) }
        return Diagnosis(MeasuredSeries(times, x, DoubleArray(rows), values, DoubleArray(rows) { water(x[it]) })).run()
    }

    @Test
    fun aProbeAheadAndADelayAreFoundTogether() {
        for (seed in 1L..2L) {
            val result = diagnosed(seed, ahead = 1.2, delay = 2.0)
            val named = (result.verdict as? Verdict.Named)?.causes.orEmpty().toSet()
            assertEquals(setOf(Cause.POSITION_OFFSET, Cause.DEAD_TIME), named, "${result.verdict}, seed $seed")
            val numbers = checkNotNull(result.extended).parameters.associate { it.name to it.value }
            assertEquals(-1.2, numbers.getValue("behind_m"), 0.12, "$numbers, seed $seed")
            assertEquals(2.0, numbers.getValue("dead_time_s"), 0.2, "$numbers, seed $seed")
        }
    }

    @Test
    fun whereThereIsNeitherNoneIsFound() {
        for (seed in 1L..4L) {
            assertEquals(Verdict.Consistent, diagnosed(seed, ahead = 0.0, delay = 0.0).verdict, "seed $seed")
        }
    }

    private companion object {
        const val LAG = 6.0
        const val NOISE = 0.05
        const val STEPS = 50
    }
}
