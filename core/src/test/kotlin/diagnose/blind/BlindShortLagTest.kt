package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.CrossingTrack
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.response.Term
import kotlin.test.Test
import kotlin.test.assertTrue

/** A second lag of a small part of a row does to slow water what a dead time as long does. */
class BlindShortLagTest {
    private val track = CrossingTrack(700)

    @Test
    fun aSecondLagOfASmallPartOfARowIsTriedWhereItIs() {
        val random = java.util.Random(11)
        val values = track.shown(4.0, SHORT).map { it + 0.0005 * random.nextGaussian() }.toDoubleArray()
        val search = BlindSearch(MeasuredSeries(track.times, track.x, track.y, values, null))
        val state = search.still(search.best())
        val tries = BlindTrials(search, state)
        val delay = tries.attempt(Term(Cause.DEAD_TIME)).gain
        val lag = tries.attempt(Term(Cause.SECOND_ORDER_RESPONSE)).gain
        assertTrue(delay > 30, "a dead time gains $delay")
        assertTrue(lag > 0.8 * delay, "a second lag $lag, a dead time $delay")
    }

    private companion object {
        /** Seconds, of rows a second apart. */
        const val SHORT = 0.05
    }
}
