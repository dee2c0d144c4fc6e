package stillwater.estimate

import org.junit.jupiter.api.Tag
import org.junit.jupiter.api.Test
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.pow
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** A lag of 12 s at 1 m/s that is as much longer as the boat is slower. */
class FlowDependentLagTest {
    private val size = 3000
    private val speeds = DoubleArray(size) { 1 + 0.5 * sin(it / 45.0) }
    private val truth = DoubleArray(size) { sin(0.06 * it) + 0.7 * sin(0.037 * it) }
    private val times = DoubleArray(size) { it.toDouble() }
    private val flow = ResponseKind.FLOW.response(12.0, 1.0)

    /** What the sensor shows, with noise of [noise]. */
    private fun series(noise: Double = 0.0): TrackSeries {
        val random = Random(3)
        var shown = truth[0]
        val values = DoubleArray(size) { i ->
            val before = truth[maxOf(0, i - 1)]
            for (part in 1..STEPS) {
                val water = before + (part - 0.5) / STEPS * (truth[i] - before)
                shown += (1 - exp(-speeds[i] / 12 / STEPS)) * (water - shown)
            }
            shown + noise * random.nextDouble(-1.0, 1.0)
        }
        return TrackSeries(times, times, DoubleArray(size), values).withSpeeds(speeds, 1.0)
    }

    private fun rms(values: DoubleArray) = sqrt((300 until 2700).sumOf { (values[it] - truth[it]).pow(2) } / 2400)

    @Test
    fun phasesComeBackAtEachSpeed() {
        val corrected = DoubleArray(size).also { PhaseCorrection(series()).correct(flow, it) }
        val usual = DoubleArray(size).also { PhaseCorrection(series()).correct(Response(lags = flow.lags), it) }

        /** What is left beside the truth, whose amplitude is not given back. */
        fun left(values: DoubleArray): Double {
            val rows = 300 until 2700
            val share = rows.sumOf { values[it] * truth[it] } / rows.sumOf { truth[it] * truth[it] }
            return sqrt(rows.sumOf { (values[it] - share * truth[it]).pow(2) } / 2400) / share
        }
        // Two sines lose differently in amplitude: about a tenth of the water's 0.86.
        assertTrue(left(corrected) < 0.1, "${left(corrected)}")
        assertTrue(left(usual) > 2 * left(corrected), "${left(usual)} and ${left(corrected)}")
    }

    /** The same speeds behind the gap in turned order: their mean is the same, those next to the gap are not. */
    @Test
    fun speedsBehindAGapDoNotCountBeforeIt() {
        val half = size / 2
        val gapped = DoubleArray(size) { if (it < half) it.toDouble() else it + 1000.0 }
        val one = DoubleArray(size) { if (it < half || it > half + half / 2) 0.5 else 2.0 }
        val other = DoubleArray(size) { if (it < half) one[it] else one[size - 1 - (it - half)] }
        val (first, second) = listOf(one, other).map { speeds ->
            val series = TrackSeries(gapped, gapped, DoubleArray(size), truth).withSpeeds(speeds, 1.0)
            DoubleArray(size).also { PhaseCorrection(series).correct(flow, it) }
        }
        for (i in 0 until half) assertEquals(first[i], second[i], 1e-6, "row $i")
        assertTrue((half until size).any { abs(first[it] - second[it]) > 0.01 })
    }

    @Test
    fun referenceTellsTheExponent() {
        val series = series(noise = 0.02)
        val learner = ReferenceLearner(series, truth)
        val found = ResponseChoice.of(ResponseKind.entries.mapNotNull(learner::candidate), Random(1))
        assertEquals(ResponseKind.FLOW, found.first.kind)
        assertFalse(found.open.any { it.kind == ResponseKind.FIRST_ORDER })
        // A twentieth: ten of the errors that noise of 0.012 leaves.
        assertEquals(12.0, found.first.parameters[0], 0.6)
        assertEquals(1.0, found.first.parameters[1], 0.05)
    }

    /** Fourteen legs of 120 m, 7 m apart, over water that changes over some 15 m, at 0.5 to 1.3 m/s. */
    private fun survey(exponent: Double): TrackSeries {
        val random = Random(8)
        val waves = List(40) { List(3) { random.nextDouble(-1.0, 1.0) } }
        val rows = ArrayList<DoubleArray>()
        var way = 0.0
        var shown = 0.0
        while (way < 14 * 127.0) {
            val speed = 0.9 + 0.4 * sin(rows.size / 35.0)
            var at = 0.0 to 0.0
            for (part in 1..STEPS) {
                way += speed / STEPS
                val along = minOf(way % 127, 120.0)
                val leg = (way / 127).toInt()
                at = 7.0 * leg + maxOf(0.0, way % 127 - 120) to if (leg % 2 == 0) along else 120 - along
                val water = waves.sumOf { (a, b, c) -> 0.2 * sin((a * at.first + b * at.second) / 8 + 3 * c) }
                shown += (1 - exp(-speed.pow(exponent) / 10 / STEPS)) * (water - shown)
            }
            rows += doubleArrayOf(rows.size.toDouble(), at.first, at.second, shown + random.nextDouble(0.02), speed)
        }
        fun column(k: Int) = DoubleArray(rows.size) { rows[it][k] }
        return TrackSeries(column(0), column(1), column(2), column(3)).withSpeeds(column(4), 1.0)
    }

    @Test
    @Tag("long")
    fun passesTellALagThatFollowsTheSpeed() {
        fun ahead(exponent: Double): Double {
            val learner = RevisitLearner.of(survey(exponent))
            val found = ResponseChoice.of(
                listOf(ResponseKind.FIRST_ORDER, ResponseKind.FLOW).mapNotNull(learner::candidate),
                Random(1),
            )
            val scores = found.standings.associate { it.candidate.kind to it.candidate.heldOutScore }
            return scores.getValue(ResponseKind.FLOW) - scores.getValue(ResponseKind.FIRST_ORDER)
        }
        assertTrue(ahead(2.0) > 20, "${ahead(2.0)}")
        // Of a lag that is always the same, no more than chance.
        assertTrue(ahead(0.0) < 4, "${ahead(0.0)}")
    }

    @Test
    fun noSpeedNoSuchLag() {
        val series = series()
        val still = TrackSeries(times, times, DoubleArray(size), series.values)
        assertEquals(null, ReferenceLearner(still, truth).candidate(ResponseKind.FLOW))
        val even = still.withSpeeds(DoubleArray(size) { 1.0 }, 1.0)
        assertEquals(null, ReferenceLearner(even, truth).candidate(ResponseKind.FLOW))
    }

    @Test
    fun valuesAreCorrectedForTheSpeed() {
        fun corrected(response: Response) =
            TrackCorrector(series(noise = 0.01)).correct(listOf(LikelyResponse(listOf(response), 1.0))).values
        val error = rms(corrected(flow))
        // The lag at the usual speed leaves a fifth of the water.
        assertTrue(error < 0.02, "$error")
        assertTrue(rms(corrected(Response(lags = flow.lags))) > 5 * error)
    }

    @Test
    fun aSpurtIsNoGap() {
        val speeds = DoubleArray(100) { if (it in 40..60) 4.0 else 1.0 }
        val rows = DoubleArray(100) { if (it < 80) it.toDouble() else it + 30.0 }
        val series = TrackSeries(rows, rows, rows, rows).withSpeeds(speeds, 1.0)
        val paced = series.inTimeOf(ResponseKind.FLOW.response(10.0, 2.0))
        assertEquals(16.0, paced.times[51] - paced.times[50], 1e-9)
        assertEquals(listOf(80), (0 until 100).filter(paced::isAfterGap))
        assertEquals(listOf(80), (0 until 100).filter(series::isAfterGap))
    }

    private companion object {
        const val STEPS = 20
    }
}
