package stillwater.estimate

import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.abs
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals

/** Responses of two numbers are found, wherever the likeliest single lag is. */
class ResponseSearchTest {
    @Test
    fun twoUnequalLagsInARowAreLearnedAndUndone() {
        for ((seed, lags) in listOf(17 to listOf(3.0, 10.0), 18 to listOf(10.0, 3.0), 19 to listOf(2.0, 40.0))) {
            val log = LawnmowerLog(seed, lags.map { SensorStage.Lag(it) }, legs = 8)
            val reference = ReferenceLearner(log.series, log.truth)
            val found = ResponseChoice.of(ResponseKind.entries.mapNotNull(reference::candidate), Random(1))
            assertEquals(ResponseKind.TWO_LAGS, found.first.kind, "lags $lags, seed $seed")
            val (shorter, longer) = found.first.parameters
            // As for two paths.
            assertEquals(lags.min(), shorter, 0.1 * lags.min(), "lags $lags, seed $seed")
            assertEquals(lags.max(), longer, 0.1 * lags.max(), "lags $lags, seed $seed")
        }
    }

    /** Casts of 80 s: the likeliest single lag may be four times as long as the sensor's, and leads to none of its numbers. */
    @Test
    fun aDeadTimeBeforeALagIsFoundOnCasts() {
        for (seed in 802L..806L) {
            val random = java.util.Random(seed)
            val waves = List(8) { Triple(0.05 + 0.6 * random.nextDouble(), 6.28 * random.nextDouble(), 0.4) }
            fun place(time: Double) = abs(Math.floorMod((10 * time).toLong(), 1600L) / 10.0 - 80) / 2
            fun water(time: Double) = waves.sumOf { (rate, phase, height) -> height * sin(rate * place(time) + phase) }
            val stages = listOf(SensorStage.Delay(4.0), SensorStage.Lag(10.0))
            val sensor = SensorSpec("", stages).build(water(0.0), Random(seed))
            val times = DoubleArray(801) { it.toDouble() }
            val values = DoubleArray(801) { row ->
                var shown = 0.0
                repeat(20) { part ->
                    shown = sensor.step(water(maxOf(0.0, row - 1 + (part + 0.5) / 20)), 0.05, Conditions.NONE)
                }
                shown + 0.01 * random.nextGaussian()
            }
            val series = TrackSeries(times, DoubleArray(801) { place(times[it]) }, DoubleArray(801), values)
            val found = checkNotNull(RevisitLearner.of(series).candidate(ResponseKind.DEAD_TIME_AND_LAG))
            // A tenth: nodes are longer than a row, and the water is learned as well.
            assertEquals(14.0, found.response.meanDelay, 1.4, "${found.parameters}, seed $seed")
        }
    }
}
