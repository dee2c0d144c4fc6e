package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.CrossingTrack
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.noise.CorrelatedNoise
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Term
import stillwater.diagnose.track.SmoothTrack
import stillwater.diagnose.water.WaterModes
import stillwater.model.Conditions
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Outliers of which few are far enough off to be told by themselves. */
class BlindOutliersTest {
    private val n = 900
    private val track = CrossingTrack(n)
    private val times = track.times
    private val x = track.x
    private val y = track.y
    private val truth = DoubleArray(n) { sin(x[it] / 4) + sin(y[it] / 5 + 1) }

    /** The readings of a lag of 4 s under noise of 0.02, one in [every] of them [off], by up to 0.14, to [end] at most. */
    private fun outliers(
        every: Int,
        noise: Double = 0.02,
        off: (Random) -> Double = { it.nextDouble(-0.14, 0.14) },
        truth: DoubleArray = this.truth,
        end: Double? = null,
        added: (Int) -> Double = { 0.0 },
    ): BlindOutliers {
        val ends = listOfNotNull(end?.let { SensorStage.Range(null, it) })
        val stages = listOf(SensorStage.Lag(4.0), SensorStage.Noise(noise)) + ends
        val sensor = SensorSpec("hidden", stages).build(truth[0], Random(7))
        val random = Random(8)
        val values = DoubleArray(n) { i ->
            val wrong = if (i % every == every / 2) off(random) else 0.0
            sensor.step(truth[i], 1.0, Conditions.NONE) + wrong + added(i)
        }
        val series = MeasuredSeries(times, x, y, values, null)
        val modes = WaterModes.flat(series, SmoothTrack.of(series), MOST, SHORTEST)
        val white = CorrelatedNoise(times, 0.0, 10.0, BooleanArray(n) { true })
        val even = BlindNoise(white, DoubleArray(n) { 1.0 })
        val terms = ends.map { Term(Cause.SATURATION) }
        val numbers = doubleArrayOf(3.5, 1.0, 0.0, 0.0) + listOfNotNull(end?.let { -ResponseModel.NO_END }, end)
        val search = BlindSearch(series)
        return BlindOutliers(search, search.settled(terms, numbers, even, DoubleArray(0), ROUNDS, modes))
    }

    @Test
    fun theTailsOfAllReadingsTellOfOutliers() {
        val found = outliers(every = 30, off = { it.nextDouble(-0.28, 0.28) })
        assertTrue(found.pValue < 1e-6, "${found.pValue} ${found.rows}")
    }

    @Test
    fun aWildRowCountsOnce() {
        // Rows 75, 225 and so on, by half of what the water has.
        assertEquals(List(6) { 75 + 150 * it }, outliers(every = 150, off = { 1.0 }).rows)
    }

    @Test
    fun noiseAloneHasNone() {
        val none = outliers(every = 10 * n)
        assertTrue(none.pValue > 0.01, "${none.pValue}")
    }

    @Test
    fun rowsAtAnEndOfTheRangeMakeNoTails() {
        // So slow that half a minute and more is spent at the end.
        for (slow in listOf(2.0, 3.0, 5.0)) {
            val water = DoubleArray(n) { sin(x[it] / 4 / slow) + sin(y[it] / 5 / slow + 1) }
            val sorted = water.sorted()
            for (share in listOf(0.7, 0.8, 0.9)) {
                val end = sorted[(n * share).toInt()]
                val none = outliers(every = 10 * n, truth = water, end = end)
                assertTrue(none.pValue > 0.01, "$slow, $share: ${none.pValue}")
                val some = outliers(every = 30, truth = water, end = end, off = { it.nextDouble(-0.28, 0.28) })
                assertTrue(some.pValue < 1e-4, "$slow, $share: ${some.pValue}")
            }
        }
    }

    @Test
    fun jumpsAreNone() {
        // By twelve deviations of the noise, each way.
        val jumps = outliers(every = 10 * n, added = { if (it in 300 until 640) 0.24 else 0.0 })
        assertTrue(jumps.pValue > 0.01 && jumps.rows.isEmpty(), "${jumps.pValue} ${jumps.rows}")
    }

    @Test
    fun noiseWithHeavyTailsHasNone() {
        val named = (0 until LOGS).filter { log ->
            val random = java.util.Random(SEED + log)
            val heavy = DoubleArray(n) {
                val squares = (1..FREEDOMS).sumOf { random.nextGaussian().let { g -> g * g } }
                0.02 * random.nextGaussian() / sqrt(squares / FREEDOMS)
            }
            outliers(every = 10 * n, noise = 1e-4, added = { heavy[it] }).pValue < 1e-4
        }
        assertTrue(named.size <= 1, "$named of $LOGS logs, seeds from $SEED")
    }

    private companion object {
        const val SEED = 20261123L
        const val LOGS = 12

        /** Of Student's t. */
        const val FREEDOMS = 5
        const val MOST = 150
        const val ROUNDS = 5

        /** Below the water's own, of 8π and 10π m. */
        const val SHORTEST = 15.0
    }
}
