package stillwater.diagnose

import stillwater.estimate.FixSmoother
import stillwater.estimate.LoggedFixes
import stillwater.estimate.TrackSeries

/**
 * Where the boat was, from fixes that jitter ([FixSmoother]). Where the log has speed and heading, what fixes are off the
 * way reckoned from these is smoothed as well, and taken if it is likelier.
 *
 * A fix that is repeated until the receiver has a new one counts once.
 *
 * @property x metres east, length n. @property y metres north, length n.
 */
internal class SmoothTrack private constructor(val x: DoubleArray, val y: DoubleArray) {
    companion object {
        /** The smoothed way of [series]. */
        fun of(series: MeasuredSeries): SmoothTrack {
            val fresh = TrackSeries(series.times, series.x, series.y, series.values).withFreshPositions()
            val rows = series.times.indices.filter { i ->
                i == 0 || series.x[i] != series.x[i - 1] || series.y[i] != series.y[i - 1]
            }
            val alone = Way(series, rows, fresh.xs, fresh.ys)
            val reckoned = DeadReckoning.of(series, fresh.xs, fresh.ys)
            if (reckoned != null) {
                val east = DoubleArray(series.size) { fresh.xs[it] - reckoned.x[it] }
                val north = DoubleArray(series.size) { fresh.ys[it] - reckoned.y[it] }
                val other = Way(series, rows, east, north)
                if (other.logLikelihood > alone.logLikelihood) {
                    return SmoothTrack(
                        DoubleArray(series.size) { other.x[it] + reckoned.x[it] },
                        DoubleArray(series.size) { other.y[it] + reckoned.y[it] },
                    )
                }
            }
            return SmoothTrack(alone.x, alone.y)
        }
    }

    /** [east] and [north] smoothed by those of the [rows] that have a fix of their own. */
    private class Way(series: MeasuredSeries, rows: List<Int>, east: DoubleArray, north: DoubleArray) {
        val x: DoubleArray
        val y: DoubleArray
        val logLikelihood: Double

        init {
            fun of(column: DoubleArray) = DoubleArray(rows.size) { column[rows[it]] }
            // Along a line there is one axis, which counts for both.
            val isLine = north.all { it == north[0] }
            val smoother = FixSmoother(LoggedFixes(of(series.times), of(east), of(if (isLine) east else north)))
            val (smoothX, smoothY) = smoother.at(series.times)
            fun known(smooth: DoubleArray, own: DoubleArray) =
                DoubleArray(series.size) { if (smooth[it].isNaN()) own[it] else smooth[it] }
            x = known(smoothX, east)
            y = if (isLine) north else known(smoothY, north)
            logLikelihood = smoother.logLikelihood
        }
    }
}
