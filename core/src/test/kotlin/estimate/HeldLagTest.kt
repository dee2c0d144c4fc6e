package stillwater.estimate

import stillwater.sensor.SensorStage
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** A lag that is itself held at a rate limit remembers nothing of the water that it missed. */
class HeldLagTest {
    private fun corrected(log: LawnmowerLog, response: Response) =
        TrackCorrector(log.series, 0.01).correct(listOf(LikelyResponse(listOf(response), 1.0)))

    private fun squares(log: LawnmowerLog, values: DoubleArray) =
        values.indices.sumOf { (values[it] - log.truth[it]) * (values[it] - log.truth[it]) }

    private val held = Response(lags = listOf(ResponseLag(10.0)), slewRate = 0.04, isLimitWithin = true)

    @Test
    fun valuesAreNearerTheWaterThanReadingsAndThanThoseOfALagAlone() {
        var own = 0.0
        var alone = 0.0
        var read = 0.0
        for (seed in 41..43) {
            val log = LawnmowerLog(seed, listOf(SensorStage.LimitedLag(10.0, 0.04)))
            val track = corrected(log, held)
            val share = track.silent.count { it } / track.silent.size.toDouble()
            assertTrue(share > 0.1, "seed $seed: at its limit in $share of the rows")
            // 95 % of 2700 rows that are alike over some ten rows: two standard errors of 270 rows are 2.7 %.
            val inside = log.truth.indices.count { log.truth[it] in track.lower[it]..track.upper[it] }
            assertEquals(0.95, inside.toDouble() / log.truth.size, 0.04, "seed $seed")
            own += squares(log, track.values)
            alone += squares(log, corrected(log, Response(lags = held.lags)).values)
            read += squares(log, log.series.values)
        }
        assertTrue(own < read / 4, "$own for $read of the readings")
        assertTrue(own < alone, "$own for $alone of a lag alone")
    }

    @Test
    fun aLimitThatIsNeverReachedChangesNothing() {
        val log = LawnmowerLog(44, listOf(SensorStage.Lag(10.0)), legs = 4)
        val far = corrected(log, held.copy(slewRate = 100.0))
        val none = corrected(log, Response(lags = held.lags))
        assertEquals(0, far.silent.count { it })
        for (row in far.values.indices) assertEquals(none.values[row], far.values[row], "row $row")
    }

    /** 0.1 s a row for 40 rows, level before and after: four rows of the run are beyond what slopes over a row tell. */
    @Test
    fun aRunEndsWhereReadingsLeaveItsLine() {
        val random = java.util.Random(45)
        val times = DoubleArray(200) { it.toDouble() }
        for (noise in listOf(0.002, 0.04)) {
            val values = DoubleArray(200) { (it - 80).coerceIn(0, 40) * 0.1 + noise * random.nextGaussian() }
            val series = TrackSeries(times, times, DoubleArray(200), values)
            val silent = SensorSides(series, Response(slewRate = 0.1), 0.0).silent
            val ends = silent.indices.filter { silent[it] }.let { it.first() to it.last() }
            // Two rows, or three deviations' worth of rows where that is more.
            val slack = maxOf(2, (3 * noise / 0.1).toInt() + 1)
            assertEquals(80.0, ends.first.toDouble(), slack.toDouble(), "noise $noise")
            assertEquals(120.0, ends.second.toDouble(), slack.toDouble(), "noise $noise")
        }
    }
}
