package stillwater.diagnose

import kotlin.math.exp
import kotlin.math.sin
import kotlin.test.Test
import kotlin.test.assertTrue

/** A second lag of a small part of a row does to slow water what a dead time as long does. */
class BlindShortLagTest {
    private val rows = 700
    private val track = CrossingTrack(rows)

    /** The water of the track at any [time], s. */
    private fun water(time: Double): Double {
        val x = 15 * sin(time / 19)
        val y = 15 * sin(time / 25 + 1)
        return sin(x / 4) + sin(y / 5 + 1) + sin((x + y) / 7)
    }

    @Test
    fun aSecondLagOfASmallPartOfARowIsTriedWhereItIs() {
        val random = java.util.Random(11)
        var first = water(0.0)
        var second = first
        val values = DoubleArray(rows) { row ->
            for (k in 0 until if (row > 0) 100 else 0) {
                first += (1 - exp(-0.01 / 4.0)) * (water(row - 1 + (k + 0.5) / 100) - first)
                second += (1 - exp(-0.01 / SHORT)) * (first - second)
            }
            second + 0.0005 * random.nextGaussian()
        }
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
