package stillwater.diagnose.reference

import stillwater.diagnose.Cause
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.DiagnosisResult
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import java.util.Random
import kotlin.math.PI
import kotlin.math.exp
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals

/** Logs with a reference whose rows are few to the shortest waves of the water, which the sensor has seen between the rows. */
class RowsApartTest {
    private val rows = 900

    /** Waves from [shortest] rows up to eight times as long, all as high. */
    private class Water(random: Random, shortest: Double) {
        private val waves = List(COUNT) {
            val length = shortest * exp(random.nextDouble() * LONGER)
            Pair(2 * PI / length, 2 * PI * random.nextDouble())
        }

        fun at(row: Double): Double = waves.sumOf { (number, phase) -> sin(number * row + phase) } / HEIGHT
    }

    private fun diagnosed(seed: Long, lag: Double, delay: Double = 0.0): DiagnosisResult {
        val random = Random(seed)
        val water = Water(random, SHORTEST)
        var state = 0.0
        val values = DoubleArray(rows) { row ->
            // The sensor had been in the water for long.
            for (step in 0 until STEPS * if (row > 0) 1 else BEFORE) {
                val ago = if (row > 0) 1.0 else BEFORE.toDouble()
                val seen = water.at(row - ago + (step + 0.5) / STEPS - delay)
                state += (1 - exp(-1 / (STEPS * lag))) * (seen - state)
            }
            state + NOISE * random.nextGaussian()
        }
        val times = DoubleArray(rows) { it.toDouble() }
        val reference = DoubleArray(rows) { water.at(it.toDouble()) }
        return Diagnosis(MeasuredSeries(times, DoubleArray(rows), DoubleArray(rows), values, reference)).run()
    }

    private fun timeConstant(result: DiagnosisResult) =
        (result.extended ?: result.baseline).parameters.first { it.name == "time_constant_s" }

    @Test
    fun aLagAloneIsConsistentAndItsIntervalHoldsIt() {
        for (seed in 1L..2L) {
            for (lag in listOf(1.5, 3.0)) {
                val result = diagnosed(seed, lag)
                assertEquals(Verdict.Consistent, result.verdict, "seed $seed, lag $lag")
                val found = timeConstant(result)
                assertContains(checkNotNull(found.interval).let { it.lower..it.upper }, lag, "$found, seed $seed")
            }
        }
    }

    @Test
    fun aDeadTimeIsNamedAloneThoughItsFirstRowsShowWhatCameBefore() {
        for (seed in 11L..12L) {
            val result = diagnosed(seed, lag = 3.0, delay = 1.6)
            assertEquals(Verdict.Named(listOf(Cause.DEAD_TIME)), result.verdict, "seed $seed")
            val delay = checkNotNull(result.extended).parameters.first { it.name == "dead_time_s" }
            assertEquals(1.6, delay.value, 0.02, "seed $seed")
        }
    }

    private companion object {
        const val COUNT = 40
        const val HEIGHT = 4.5

        /** Logarithm of how much longer the longest wave is. */
        const val LONGER = 2.1

        /** Rows. */
        const val SHORTEST = 3.5
        const val STEPS = 40
        const val BEFORE = 40

        /** Of water with a standard deviation of one. */
        const val NOISE = 0.004
    }
}
