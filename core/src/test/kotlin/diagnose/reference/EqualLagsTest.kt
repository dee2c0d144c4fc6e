package stillwater.diagnose.reference

import stillwater.diagnose.Cause
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import stillwater.model.Conditions
import stillwater.model.Interval
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.PI
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertIs
import kotlin.test.assertNotNull
import kotlin.test.assertTrue

/** How far two equal lags are apart no derivative tells; how long they are shows all the same. */
class EqualLagsTest {
    private val n = 900

    private fun intervals(seed: Long, longer: Double, shorter: Double): List<Interval> {
        val random = java.util.Random(seed)
        val waves = List(12) {
            val period = 50 * Math.pow(10.0, random.nextDouble())
            Triple(2 * PI / period, 2 * PI * random.nextDouble(), 0.5)
        }
        fun water(time: Double) = 8 + waves.sumOf { (rate, phase, height) -> height * sin(rate * time + phase) }
        val stages = listOf(SensorStage.Lag(longer), SensorStage.Lag(shorter))
        val sensor = SensorSpec("", stages).build(water(0.0), kotlin.random.Random(seed))
        val values = DoubleArray(n) { row ->
            var shown = sensor.step(water(row.toDouble()), 0.0, Conditions.NONE)
            if (row > 0) {
                repeat(20) { k -> shown = sensor.step(water(row - 1 + (k + 0.5) / 20), 0.05, Conditions.NONE) }
            }
            shown + 0.05 * random.nextGaussian()
        }
        val times = DoubleArray(n) { it.toDouble() }
        val truth = DoubleArray(n) { water(times[it]) }
        val result = Diagnosis(MeasuredSeries(times, times, DoubleArray(n), values, truth)).run()
        val named = assertIs<Verdict.Named>(result.verdict, "seed $seed")
        assertEquals(setOf(Cause.SECOND_ORDER_RESPONSE), named.causes.toSet(), "seed $seed")
        val extended = assertNotNull(result.extended, "seed $seed")
        return listOf("time_constant_s", "second_time_constant_s").map { name ->
            assertNotNull(extended.parameters.single { it.name == name }.interval, "$name, seed $seed")
        }
    }

    @Test
    fun intervalsHoldEqualLagsAndAreNoWiderThanTheirSumAllows() {
        val held = SEEDS.count { seed ->
            val shorter = if (seed % 2 == 0L) 12.0 else 10.8
            val (first, second) = intervals(seed, 12.0, shorter)
            // A difference that shows by its square only: half as much or twice as much would show in these rows.
            assertTrue(first.upper < 2 * 12 && second.lower > shorter / 2, "$first, $second, seed $seed")
            12.0 in first.lower..first.upper && shorter in second.lower..second.upper
        }
        // Of 90 % of eight fewer than five are one in two hundred.
        assertTrue(held >= 5, "$held of 8, seeds $SEEDS")
    }

    private companion object {
        val SEEDS = 1L..8L
    }
}
