package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.CrossingTrack
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.Verdict
import stillwater.diagnose.evidence.CoarseRounding
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.cos
import kotlin.math.round
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** What a log without a reference can show and the waves of the water would hide, and what it cannot. */
class BlindLimitsTest {
    private val n = 900
    private val track = CrossingTrack(n)
    private val times = track.times

    private val x = track.x
    private val y = track.y
    private val truth = track.truth

    private fun readings(vararg stages: SensorStage): DoubleArray {
        val sensor = SensorSpec("hidden", stages.toList()).build(truth[0], Random(7))
        return DoubleArray(n) { sensor.step(truth[it], 1.0, Conditions.NONE) }
    }

    private fun sets(verdict: Verdict): List<List<Cause>> = when (verdict) {
        is Verdict.Named -> verdict.causes.map { listOf(it) }
        is Verdict.Ambiguous -> verdict.sets
        else -> emptyList()
    }

    @Test
    fun anEndOfTheRangeIsNamedAndFound() {
        val values = readings(SensorStage.Lag(4.0), SensorStage.Range(null, 1.2), SensorStage.Noise(0.01))
        val result = Diagnosis(MeasuredSeries(times, x, y, values, null)).run()
        assertTrue(listOf(Cause.SATURATION) in sets(result.verdict), "${result.verdict}")
        val upper = checkNotNull(result.extended).parameters.first { it.name == "upper" }
        // A tenth of the noise's deviation over the root of some hundred rows at the end would be 0.001.
        assertEquals(1.2, upper.value, 0.01)
    }

    /** Rows at an end say little of how stretches of a log agree, and all of one another. */
    @Test
    fun anEndOfTheRangeThatFewRowsReachIsNamed() {
        val free = readings(SensorStage.Lag(4.0), SensorStage.Noise(0.01))
        val end = free.sortedArray()[n - 1 - AT_END] - 0.05
        val values = readings(SensorStage.Lag(4.0), SensorStage.Range(null, end), SensorStage.Noise(0.01))
        val reached = free.count { it > end }
        assertTrue(reached < 3 * AT_END, "$reached rows")
        val verdict = Diagnosis(MeasuredSeries(times, x, y, values, null)).run().verdict
        assertTrue(listOf(Cause.SATURATION) in sets(verdict), "$verdict")
    }

    /** Five readings of one crest: wrong ones would hardly be just there. */
    @Test
    fun anEndOfTheRangeThatOneCrestReachesIsNamed() {
        val free = readings(SensorStage.Lag(4.0), SensorStage.Noise(0.01))
        val top = free.indices.maxBy { free[it] }
        val end = free[top] - 0.1
        val values = readings(SensorStage.Lag(4.0), SensorStage.Range(null, end), SensorStage.Noise(0.01))
        assertEquals((top - 2..top + 2).toList(), free.indices.filter { free[it] > end })
        val verdict = Diagnosis(MeasuredSeries(times, x, y, values, null)).run().verdict
        assertTrue(listOf(Cause.SATURATION) in sets(verdict), "$verdict")
    }

    @Test
    fun twoWrongReadingsAtCrestsAreNoEnd() {
        val values = readings(SensorStage.Lag(4.0), SensorStage.Noise(0.01))
        val crests = (1 until n - 1).filter { values[it] > values[it - 1] && values[it] > values[it + 1] }
            .sortedByDescending { values[it] }
        val first = crests.first()
        val second = crests.first { kotlin.math.abs(it - first) > 50 }
        val end = minOf(values[first], values[second]) - 0.1
        values[first] = end
        values[second] = end
        val verdict = Diagnosis(MeasuredSeries(times, x, y, values, null)).run().verdict
        assertTrue(sets(verdict).none { Cause.SATURATION in it }, "$verdict")
    }

    @Test
    fun aDeadTimeBesideALagIsTold() {
        val values = readings(SensorStage.Delay(6.0), SensorStage.Lag(4.0), SensorStage.Noise(0.03))
        // Fixes that jitter by a third of a metre.
        val random = Random(3)
        fun jittering(way: DoubleArray) = DoubleArray(n) { way[it] + random.nextDouble(-0.5, 0.5) }
        val result = Diagnosis(MeasuredSeries(times, jittering(x), jittering(y), values, null)).run()
        val isTold = sets(result.verdict).any { Cause.DEAD_TIME in it && Cause.TIME_CONSTANT !in it }
        assertTrue(isTold, "${result.verdict}")
        val delay = checkNotNull(result.extended).parameters.first { it.name == "dead_time_s" }
        // The sensor holds its input over a step, which is half a step less of a delay.
        assertEquals(5.5, delay.value, 0.5)
    }

    /** Salinity that goes with time as well as with place: the sensor may show it, or the water may go with it. */
    @Test
    fun whatIsMeasuredInTheWaterMayBeTheWatersOwn() {
        val salinity = DoubleArray(n) { 30 + cos(x[it] / 11) + 0.8 * sin(it / 70.0) }
        val plain = readings(SensorStage.Lag(4.0), SensorStage.Noise(0.01))
        val values = DoubleArray(n) { plain[it] + 0.5 * salinity[it] }
        val series = MeasuredSeries(times, x, y, values, null, mapOf("salinity" to salinity))
        val result = Diagnosis(series).run()
        val sets = sets(result.verdict).filter { Cause.CROSS_SENSITIVITY in it }
        assertTrue(sets.isNotEmpty() && sets.all { Cause.TIME_VARYING_FIELD in it }, "${result.verdict}")
        assertTrue(result.warnings.any { "salinity may go with the value in the water" in it }, "${result.warnings}")
    }

    @Test
    fun roundingIsCoarseWhereItMakesMostOfTheScatter() {
        val random = Random(5)
        // The sum of twelve even numbers is nearly normal, of variance 1.
        val noise = DoubleArray(n) { List(12) { random.nextDouble() }.sum() - 6 }
        fun rounding(step: Double): CoarseRounding {
            val values = DoubleArray(n) { step * round((20 * sin(it / 50.0) + noise[it]) / step) }
            return CoarseRounding(MeasuredSeries(times, x, y, values, null), BooleanArray(n) { true }, step)
        }
        // 4²/12 of 1 + 4²/12 is 0.57; the noise's own estimate is within a tenth.
        assertEquals(0.57, rounding(4.0).share, 0.06)
        assertTrue(rounding(4.0).isCoarse(spread = 1.5))
        assertFalse(rounding(4.0).isCoarse(spread = 6.0), "slower errors are far larger")
        assertEquals(0.25, rounding(2.0).share, 0.04)
        assertFalse(rounding(2.0).isCoarse(spread = 1.2))
        assertEquals(0.0, CoarseRounding(MeasuredSeries(times, x, y, noise, null), BooleanArray(n) { true }, 0.0).share)
    }

    private companion object {
        const val AT_END = 4
    }
}
