package stillwater.estimate

import stillwater.sensor.SensorStage
import kotlin.math.PI
import kotlin.math.abs
import kotlin.math.atan
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Even steps over gaps. */
class EvenPointsTest {
    private fun series(times: List<Double>, value: (Double) -> Double = { it }) = TrackSeries(
        times.toDoubleArray(),
        times.toDoubleArray(),
        DoubleArray(times.size),
        DoubleArray(times.size) { value(times[it]) },
    )

    private fun rows(range: IntRange) = range.map { it.toDouble() }

    @Test
    fun aShortGapIsBridgedAndHasNoPoints() {
        val points = EvenPoints(series(rows(0..599) + rows(620..1219)), 1.0)
        val (readings, at) = points.stretches.single()
        assertEquals(rows(0..1219), readings.toList())
        assertEquals(rows(0..599) + rows(620..1219), points.times)
        assertEquals(List(600) { 0 } + List(600) { 600 }, points.first)
        assertEquals((0..599).toList() + List(20) { -1 } + (600..1199), at.toList())
    }

    /** What lies between two casts is no leg with some rows missing. */
    @Test
    fun aGapOfATenthOfTheStretchesBesideItIsNone() {
        val points = EvenPoints(series(rows(0..299) + rows(330..629)), 1.0)
        assertEquals(listOf(300, 300), points.stretches.map { it.first.size })
        assertEquals(List(300) { 0 } + List(300) { 300 }, points.first)
    }

    @Test
    fun stepsThatMissTheRowsAfterAGapBeginWithTheNextOne() {
        val points = EvenPoints(series(rows(0..9) + rows(18..229).map { it + 0.5 }), 1.0)
        assertEquals(rows(0..9) + rows(19..229), points.times)
        assertEquals(List(10) { 0 } + List(211) { 10 }, points.first)
    }

    @Test
    fun aShortGapHardlyChangesTheLagThatIsLearned() {
        val whole = LawnmowerLog(seed = 44, listOf(SensorStage.Lag(8.0)), legs = 8).series
        fun lag(series: TrackSeries) =
            checkNotNull(RevisitLearner.of(series).candidate(ResponseKind.FIRST_ORDER)).parameters[0]
        val gapped = whole.at((0 until whole.size).filter { it !in 400..424 })
        // A quarter of its standard error: 25 of some 1800 rows are missing. Before gaps were bridged it was 0.55.
        assertEquals(lag(whole), lag(gapped), 0.2)
    }

    @Test
    fun readingsBesideAGapArePutWhereTheyWereTaken() {
        val lag = 12.0
        val omega = 2 * PI / 200
        val times = rows(0..799) + rows(825..1599)
        val shown = series(times) { sin(omega * it - atan(omega * lag)) }
        val even = PhaseCorrection(shown)
        val water = DoubleArray(even.size).also { even.correct(Response(lags = listOf(ResponseLag(lag))), it) }
        val beside = even.times.indices.filter { even.times[it] in 760.0..864.0 }
        val error =
            sqrt(beside.sumOf { (water[it] - sin(omega * even.times[it])).let { off -> off * off } } / beside.size)
        // The bridge is off by the bend of the wave, a tenth of its height; half of that, root mean square, is left.
        assertTrue(error < 0.05, "$error")
        assertTrue(abs(water[0]) < 0.3, "the log's own ends are what they were: ${water[0]}")
    }
}
