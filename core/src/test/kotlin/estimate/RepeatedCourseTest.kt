package stillwater.estimate

import kotlin.math.cos
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** A course that is sailed again and again the same way: there passes agree whatever the sensor's lag. */
class RepeatedCourseTest {
    private fun water(x: Double, y: Double) = sin(x / 9 + 1) + cos(y / 7 + x / 25)

    /** [rows] of one a second along [place], with fixes off by a decimetre and readings by little. */
    private fun series(rows: Int, place: (Double) -> Pair<Double, Double>): TrackSeries {
        val random = java.util.Random(4)
        val places = List(rows) { place(it.toDouble()) }
        val xs = DoubleArray(rows) { places[it].first + 0.1 * random.nextGaussian() }
        val ys = DoubleArray(rows) { places[it].second + 0.1 * random.nextGaussian() }
        val values = DoubleArray(rows) {
            val (x, y) = places[maxOf(0, it - 6)]
            water(x, y) + 0.005 * random.nextGaussian()
        }
        return TrackSeries(DoubleArray(rows) { it.toDouble() }, xs, ys, values)
    }

    /** Ten times round, at 0.8 m/s. */
    private val ring = series(2400) { 30 * sin(it / 38) to 30 * cos(it / 38) }

    /** Twelve times, at some 0.8 m/s; one crossing. */
    private val eight = series(3600) { 50 * sin(it / 48) to 25 * sin(it / 24) }

    private fun track(series: TrackSeries): CorrectedTrack {
        val none = BooleanArray(series.size)
        fun moved(by: Double) = DoubleArray(series.size) { series.values[it] + by }
        return CorrectedTrack(series.values, moved(-0.02), moved(0.02), none, none)
    }

    @Test
    fun nothingIsLearnedWhereAllPassesGoTheSameWay() {
        val learner = RevisitLearner.of(ring)
        assertEquals(0, learner.blocks)
        assertTrue(learner.alike > 50, "${learner.alike}")
    }

    @Test
    fun passesTheSameWayAreNoCheck() {
        val agreement = TrackAgreement.of(ring, track(ring))
        assertTrue(agreement.ratio.isNaN())
        assertEquals(0, agreement.crossings)
        assertTrue(agreement.alike > 100, "${agreement.alike}")
    }

    /** That a single crossing agrees with itself, time after time, would be one piece of evidence. */
    @Test
    fun oneCrossingIsOnePlaceHoweverOftenItIsPassed() {
        val none = BooleanArray(eight.size)
        fun wide(by: Double) = DoubleArray(eight.size) { eight.values[it] + by }
        val agreeing = TrackAgreement.of(eight, CorrectedTrack(eight.values, wide(-9.0), wide(9.0), none, none))
        assertTrue(agreeing.crossings >= TrackAgreement.FEWEST, "${agreeing.crossings}")
        assertTrue(agreeing.places < TrackAgreement.FEWEST, "${agreeing.places}")
        assertTrue(agreeing.ratio.isNaN())
        // That it disagrees, with the lag left in, is told all the same.
        assertTrue(TrackAgreement.of(eight, track(eight)).isContradicted)
    }

    /** One or two places rule out no response, and say less of a lag than as many runs elsewhere. */
    @Test
    fun whatFewPlacesSayCountsOnce() {
        val learner = RevisitLearner.of(eight)
        assertTrue(learner.blocks >= 8 && learner.alike > learner.blocks, "${learner.blocks} ${learner.alike}")
        assertTrue(learner.groups <= 3, "${learner.groups}")
        val late = checkNotNull(learner.candidate(ResponseKind.DEAD_TIME))
        assertTrue(6.0 in late.interval(0), "${late.interval(0)}")
        assertTrue(late.relativeErrors[0] > 0.05, "${late.relativeErrors}")
    }
}
