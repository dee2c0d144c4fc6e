package stillwater.correct

import stillwater.estimate.TrackSeries
import stillwater.estimate.UnusableReadings
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.PI
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertEquals

/** A reference from a clock that is behind is found, and what is no such thing is not taken for one. */
class LateReferenceTest {
    private val n = 900

    private fun water(seed: Long): (Double) -> Double {
        val random = java.util.Random(seed)
        val waves = List(16) {
            val period = 20 * Math.pow(10.0, random.nextDouble())
            Triple(2 * PI / period, 2 * PI * random.nextDouble(), 0.3)
        }
        return { time -> waves.sumOf { (rate, phase, height) -> height * sin(rate * time + phase) } }
    }

    /** What a sensor of [stages] shows each second, the reference that of [late] s before. */
    private fun late(seed: Long, late: Double, noise: Double = 0.0, vararg stages: SensorStage): Double {
        val random = java.util.Random(seed)
        val water = water(seed)
        val sensor = SensorSpec("", stages.toList()).build(water(0.0), kotlin.random.Random(seed))
        val values = DoubleArray(n) { row ->
            var shown = 0.0
            for (part in 1..20) shown = sensor.step(water(row - 1 + (part - 0.5) / 20), 0.05, Conditions.NONE)
            shown + 0.01 * random.nextGaussian()
        }
        val times = DoubleArray(n) { it.toDouble() }
        // In rows 300 to 320 there is none.
        val reference = DoubleArray(n) {
            if (it in 300..320) Double.NaN else water(it - late) + noise * random.nextGaussian()
        }
        val series = TrackSeries(times, times, DoubleArray(n), values)
        return LateReference.seconds(series, reference, UnusableReadings.none(n))
    }

    @Test
    fun aClockThatIsBehindIsFound() {
        for ((seed, behind) in listOf(1L to 2.0, 2L to 2.0, 3L to 6.0, 4L to 20.0, 5L to 1.6, 6L to 2.5)) {
            val found = late(seed, behind, 0.0, SensorStage.Lag(8.0))
            // A tenth of a row: the water between rows is taken for straight.
            assertEquals(behind, found, 0.1, "seed $seed")
        }
    }

    @Test
    fun otherSensorsAreNoLateReference() {
        val sensors = listOf(
            listOf(SensorStage.Lag(8.0)),
            listOf(SensorStage.Lag(8.0), SensorStage.Lag(3.0)),
            listOf(SensorStage.Delay(3.0), SensorStage.Lag(8.0)),
            listOf(SensorStage.TwoPath(2.0, 30.0, 0.5)),
            listOf(SensorStage.Asymmetric(5.0, 12.0)),
            listOf(SensorStage.Slew(0.05)),
            listOf(SensorStage.Lag(0.2)),
            emptyList(),
        )
        for ((index, stages) in sensors.withIndex()) {
            for (noise in listOf(0.0, 0.1)) {
                val seed = 10L + index
                assertEquals(0.0, late(seed, 0.0, noise, *stages.toTypedArray()), "$stages, noise $noise, seed $seed")
            }
        }
    }

    @Test
    fun aSensorAtItsRateLimitIsNoLateReference() {
        for (seed in 3511L..3515L) assertEquals(0.0, late(seed, 0.0, 0.01, SensorStage.Slew(0.05)), "seed $seed")
    }

    /** The mean of two rows is better than each where the reference is noise, and a lag of half a row puts it right. */
    @Test
    fun noiseOfAReferenceBesideNoLagIsNotLate() {
        for (seed in 3911L..3920L) assertEquals(0.0, late(seed, 0.0, 0.1), "seed $seed")
    }

    @Test
    fun whatIsTakenEarlierIsThatAndNothingOverGaps() {
        val times = DoubleArray(40) { if (it < 20) it.toDouble() else it + 100.0 }
        val series = TrackSeries(times, times, DoubleArray(40), times)
        val reference = DoubleArray(40) { if (it == 10) Double.NaN else 3 * times[it] }
        val earlier = LateReference.earlier(series, reference, 1.5)
        for (row in 0 until 40) {
            val isKnown = row !in listOf(18, 19, 38, 39)
            val expected = if (isKnown) 3 * (times[row] + 1.5) else Double.NaN
            assertEquals(expected, earlier[row], "row $row")
        }
    }
}
