package stillwater.diagnose.reference

import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.response.Swing
import stillwater.diagnose.response.UnknownTruth
import stillwater.diagnose.response.WayTimes
import stillwater.diagnose.track.SmoothTrack
import kotlin.math.hypot
import kotlin.math.sqrt

/**
 * A probe on a rigid arm beside a reference that is known along the boat's way: in turns the arm's end leaves the way, and
 * what [truth] is there is not known.
 */
internal class ArmSwing(private val series: MeasuredSeries, private val truth: DoubleArray) : Swing {
    private val way by lazy { WayTimes(series) }
    private val track by lazy { SmoothTrack.of(series) }
    private val most = MOST * UnknownTruth.deviation(truth)

    /** What the truth changes by in a metre, root mean square of the whole way or of that near each row if it is more. */
    private val slopes: DoubleArray by lazy {
        val usual = slope(1, series.size)
        DoubleArray(series.size) { maxOf(usual, slope(maxOf(it - NEAR, 1), minOf(it + NEAR, series.size))) }
    }

    private fun slope(from: Int, until: Int): Double {
        var squares = 0.0
        var ways = 0.0
        for (i in from until until) {
            val moved = hypot(track.x[i] - track.x[i - 1], track.y[i] - track.y[i - 1])
            val change = truth[i] - truth[i - 1]
            squares += change * change
            ways += moved * moved
        }
        return if (ways > 0) sqrt(squares / ways) else 0.0
    }

    /** Where the boat keeps its course nothing is in doubt. */
    override fun doubts(behind: Double): DoubleArray {
        val arm = track.onArm(behind)
        val walk = way.at(-behind)
        val times = series.times
        var from = 0
        return DoubleArray(series.size) { i ->
            val time = walk.timeAt(i)
            while (from < times.size - 2 && times[from + 1] < time) from++
            while (from > 0 && times[from] > time) from--
            val share = ((time - times[from]) / (times[from + 1] - times[from])).coerceIn(0.0, 1.0)
            val x = track.x[from] + share * (track.x[from + 1] - track.x[from])
            val y = track.y[from] + share * (track.y[from + 1] - track.y[from])
            val off = hypot(arm.x[i] - x, arm.y[i] - y)
            minOf(LASTING * maxOf(slopes[from], slopes[i]) * off, most)
        }
    }

    private companion object {
        /** Rows on either side that are near. */
        const val NEAR = 3

        /** What is off in a row of a turn is off alike in those beside it, which shocks of each row for itself are not. */
        const val LASTING = 2.0

        /** Standard deviations of the truth that two places far apart differ by. */
        val MOST = sqrt(2.0)
    }
}
