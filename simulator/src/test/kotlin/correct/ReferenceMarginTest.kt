package stillwater.correct

import stillwater.estimate.LikelyResponse
import stillwater.estimate.Response
import stillwater.estimate.TrackCorrector
import stillwater.estimate.TrackSeries
import kotlin.math.abs
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class ReferenceMarginTest {
    private val random = Random(2)
    private val times = DoubleArray(ROWS) { it.toDouble() }
    private val water = DoubleArray(ROWS) { 8 + sin(it / 23.0) + 0.5 * sin(it / 9.0) }

    private fun normal(deviation: Double) = deviation * (List(12) { random.nextDouble() }.sum() - 6)

    /** Readings without a lag, off by [error]; corrected as without a lag. */
    private fun margin(referenceNoise: Double, error: (Int) -> Double): Pair<ReferenceMargin, Double> {
        val readings = DoubleArray(ROWS) { water[it] + error(it) + normal(0.01) }
        val series = TrackSeries(times, times, DoubleArray(ROWS), readings)
        val track = TrackCorrector(series).correct(listOf(LikelyResponse(listOf(Response()), 1.0)))
        val margin = ReferenceMargin.of(series, track, DoubleArray(ROWS) { water[it] + normal(referenceNoise) })
        val wide = margin.widened(track)
        return margin to water.indices.count { water[it] in wide.lower[it]..wide.upper[it] } / ROWS.toDouble()
    }

    @Test
    fun anEffectThatIsNotInTheModelIsInTheIntervals() {
        val (margin, covered) = margin(referenceNoise = 0.01) { 0.2 * maxOf(0.0, sin(it / 60.0)) }
        assertTrue(margin.isMisfit && margin.covered < 0.8, "${margin.covered}")
        // What is asked for, and what a tenth of the log that had no say comes to.
        assertEquals(0.95, covered, 0.02)
        assertTrue(abs(margin.heldOut - 0.95) < 0.04, "${margin.heldOut}")
    }

    /** The reference's own noise is no fault of the intervals. */
    @Test
    fun aNoisyReferenceWidensNothing() {
        for (noise in listOf(0.01, 0.25)) assertFalse(margin(noise) { 0.0 }.first.isMisfit, "$noise")
    }

    /** What the correction does between rows far apart is no noise of the reference's. */
    @Test
    fun rowsAcrossGapsSayNothingOfTheReferencesNoise() {
        val readings = DoubleArray(ROWS) { water[it] + (if (it / 10 % 2 == 0) 0.2 else -0.2) + normal(0.01) }
        val series = TrackSeries(times, times, DoubleArray(ROWS), readings)
        val track = TrackCorrector(series).correct(listOf(LikelyResponse(listOf(Response()), 1.0)))
        val references = DoubleArray(ROWS) { if (it % 10 == 5) water[it] else Double.NaN }
        val margin = ReferenceMargin.of(series, track, references)
        assertTrue(margin.isMisfit && margin.covered < 0.5, "${margin.covered}, ${margin.factor}")
    }

    /** Of 60 rows, that an offset as large as the water's waves is outside is no chance; a tenth too narrow would be. */
    @Test
    fun fewRowsWidenIntervalsThatAreFarTooNarrow() {
        fun margin(offset: Double): ReferenceMargin {
            val few = times.copyOf(60)
            val rows = TrackSeries(few, few, DoubleArray(60), DoubleArray(60) { water[it] + normal(0.01) })
            val track = TrackCorrector(rows).correct(listOf(LikelyResponse(listOf(Response()), 1.0)))
            return ReferenceMargin.of(rows, track, DoubleArray(60) { water[it] + offset + normal(0.01) })
        }
        assertTrue(margin(0.8).isMisfit)
        assertFalse(margin(0.0).isMisfit)
    }

    @Test
    fun noFactorIsAskedOfIntervalsWithoutWidth() {
        val series = TrackSeries(times, times, DoubleArray(ROWS), DoubleArray(ROWS) { water[it] + normal(0.01) })
        val track = TrackCorrector(series).correct(listOf(LikelyResponse(listOf(Response()), 1.0))).scaledBy(0.0)
        val margin = ReferenceMargin.of(series, track, DoubleArray(ROWS) { water[it] + 1 })
        assertEquals(1.0, margin.factor)
        assertEquals(0.0, margin.covered)
        assertTrue(margin.widened(track).lower.all { it.isFinite() })
    }

    private companion object {
        const val ROWS = 1500
    }
}
