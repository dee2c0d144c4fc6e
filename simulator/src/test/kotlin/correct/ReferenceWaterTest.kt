package stillwater.correct

import stillwater.estimate.ReferenceLearner
import stillwater.estimate.ResponseKind
import stillwater.estimate.TrackSeries
import stillwater.estimate.UnusableReadings
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.PI
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertNotNull
import kotlin.test.assertNull
import kotlin.test.assertTrue

/** A noisy or coarse reference is smoothed before a sensor is learned from it, which else looks too slow. */
class ReferenceWaterTest {
    private val n = 900
    private val times = DoubleArray(n) { it.toDouble() }

    /** Readings and references of one log; what the reference was before noise. */
    private class Log(val series: TrackSeries, val reference: DoubleArray, val water: DoubleArray)

    private fun log(seed: Long, stages: List<SensorStage>, shown: (Double, java.util.Random) -> Double): Log {
        val random = java.util.Random(seed)
        val waves = List(16) {
            val period = 30 * Math.pow(10.0, random.nextDouble())
            2 * PI / period to 2 * PI * random.nextDouble()
        }
        fun water(time: Double) = waves.sumOf { (rate, phase) -> 0.3 * sin(rate * time + phase) }
        val sensor = SensorSpec("", stages).build(water(0.0), kotlin.random.Random(seed))
        val values = DoubleArray(n) { row ->
            var shows = 0.0
            for (part in 1..20) shows = sensor.step(water(row - 1 + (part - 0.5) / 20), 0.05, Conditions.NONE)
            shows + 0.01 * random.nextGaussian()
        }
        val truth = DoubleArray(n) { water(times[it]) }
        val reference = DoubleArray(n) { if (it in 400..420) Double.NaN else shown(truth[it], random) }
        return Log(TrackSeries(times, times, DoubleArray(n), values), reference, truth)
    }

    /** The time constant of a single lag that [references] tell, s. */
    private fun lag(log: Log, references: DoubleArray): Double {
        val rows = (0 until n).filter { references[it].isFinite() }
        val learner = ReferenceLearner(log.series.at(rows), DoubleArray(rows.size) { references[rows[it]] })
        return assertNotNull(learner.candidate(ResponseKind.FIRST_ORDER)).response.meanDelay
    }

    private fun smoothed(log: Log) = ReferenceWater.smoothed(log.series, log.reference, UnusableReadings.none(n))

    @Test
    fun noiseOfTheReferenceMakesNoLag() {
        val forms = listOf<Pair<String, (Double, java.util.Random) -> Double>>(
            "noise" to { truth, random -> truth + 0.2 * random.nextGaussian() },
            "steps" to { truth, _ -> 0.5 * Math.rint(truth / 0.5) },
        )
        for ((form, shown) in forms) {
            for (tau in listOf(3.0, 12.0)) {
                val log = log(21, listOf(SensorStage.Lag(tau)), shown)
                val water = assertNotNull(smoothed(log), "$form, $tau s")
                // As the noise of the smoothed water is correlated, a tenth of the time constant or half a row.
                assertEquals(tau, lag(log, water), maxOf(0.1 * tau, 0.5), "$form, $tau s")
                assertTrue(lag(log, log.reference) > lag(log, water), "$form, $tau s: noise alone looks slower")
            }
        }
    }

    @Test
    fun theWaterIsNearerThanTheReferenceAndNowhereElse() {
        val log = log(22, listOf(SensorStage.Lag(8.0))) { truth, random -> truth + 0.2 * random.nextGaussian() }
        val water = assertNotNull(smoothed(log))
        val rows = (0 until n).filter { log.reference[it].isFinite() }
        assertEquals(rows, (0 until n).filter { water[it].isFinite() })
        fun off(values: DoubleArray) = sqrt(rows.sumOf { (values[it] - log.water[it]).let { d -> d * d } } / rows.size)
        assertTrue(off(water) < off(log.reference) / 2, "${off(water)} for ${off(log.reference)}")
        val words = ReferenceWater.words(log.reference, water)
        val said = Regex("scatters by ([0-9.]+) ").find(words)?.groupValues?.get(1)?.toDouble()
        // Some of the noise is in what the water is taken for.
        assertEquals(0.2, said ?: 0.0, 0.03, words)
    }

    @Test
    fun whatHasNoNoiseStaysAsItIs() {
        val sensors = listOf(
            listOf(SensorStage.Lag(8.0)),
            listOf(SensorStage.Delay(3.0), SensorStage.Lag(8.0)),
            listOf(SensorStage.TwoPath(2.0, 30.0, 0.5)),
            emptyList(),
        )
        for ((index, stages) in sensors.withIndex()) {
            assertNull(smoothed(log(30L + index, stages) { truth, _ -> truth }), "$stages")
        }
        // Sharp steps are no noise: a probe moved between samples.
        val moved = DoubleArray(n) { (it / 60 * 7 % 5).toDouble() }
        val sensor = SensorStage.Lag(8.0).build(moved[0], kotlin.random.Random(1))
        val random = java.util.Random(40)
        val values = DoubleArray(n) { sensor.step(moved[it], 1.0, Conditions.NONE) + 0.01 * random.nextGaussian() }
        assertNull(ReferenceWater.smoothed(TrackSeries(times, times, times, values), moved, UnusableReadings.none(n)))
        // Nor is anything said of few rows, or of a reference that stands still.
        val still = DoubleArray(n) { 1.0 }
        assertNull(ReferenceWater.smoothed(TrackSeries(times, times, times, values), still, UnusableReadings.none(n)))
    }

    @Test
    fun waterBetweenRowsOfARareReferenceIsFilledIn() {
        for (stages in listOf(listOf(SensorStage.Lag(8.0)), listOf(SensorStage.Lag(3.0)))) {
            val log = log(51, stages) { truth, _ -> truth }
            val rare = DoubleArray(n) { if (it % 5 == 0) log.reference[it] else Double.NaN }
            val water = assertNotNull(ReferenceWater.filled(log.series, rare), "$stages")
            val rows = (0 until n).filter { water[it].isFinite() }
            // From the first row to the last one with a reference, but for the gap.
            assertEquals((0..895).filter { it !in 396..424 || it == 425 }, rows, "$stages")
            val off = sqrt(rows.sumOf { (water[it] - log.water[it]).let { d -> d * d } } / rows.size)
            val deviation = sqrt(log.water.sumOf { it * it } / n)
            assertTrue(off < 0.1 * deviation, "$stages: $off of $deviation")
            val lag = lag(log, log.reference)
            assertEquals(lag, lag(log, water), 0.1 * lag, "$stages")
            assertTrue("every 5 s" in ReferenceWater.filledWords(log.series, rare))
        }
    }

    @Test
    fun nothingIsFilledInWhereTheReferenceIsInEachRowOrSaysTooLittle() {
        val log = log(52, listOf(SensorStage.Lag(8.0))) { truth, _ -> truth }
        assertNull(ReferenceWater.filled(log.series, log.reference))
        // Waves are 30 s and longer: a row in 60 s says nothing of them.
        val seldom = DoubleArray(n) { if (it % 60 == 0) log.water[it] else Double.NaN }
        assertNull(ReferenceWater.filled(log.series, seldom))
        val few = DoubleArray(n) { if (it % 14 == 0) log.water[it] + 3 * sin(it * 0.9) else Double.NaN }
        assertNull(ReferenceWater.filled(log.series, few))
    }
}
