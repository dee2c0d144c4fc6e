package stillwater.diagnose.response

import stillwater.diagnose.MeasuredSeries

/** When the boat was a way further or less far along its track. */
internal class WayTimes(private val series: MeasuredSeries) {
    private val smooth: DoubleArray = smoothed()

    /** The way as the sum of smoothed speeds: jitter of fixes would make it too long. */
    private fun smoothed(): DoubleArray {
        val way = DoubleArray(series.size)
        for (i in 1 until series.size) {
            val dt = series.times[i] - series.times[i - 1]
            way[i] = way[i - 1] + maxOf((series.speed[i] + series.speed[i - 1]) / 2 * dt, 1e-9)
        }
        return way
    }

    /** The times at which the way was [distance] m further than at each row, asked for row after row. */
    fun at(distance: Double): Walk = Walk(distance)

    /** Goes along the track [distance] m ahead of the rows. */
    inner class Walk(private val distance: Double) {
        private var after = 0

        /** The time that belongs to row [i], no earlier than the last one asked for, s; beyond the ends with the speed there. */
        fun timeAt(i: Int): Double {
            val times = series.times
            val wanted = smooth[i] + distance
            while (after < smooth.size && smooth[after] < wanted) after++
            if (after == smooth.size) {
                return times.last() + (wanted - smooth.last()) / maxOf(series.speed.last(), SLOWEST)
            }
            if (smooth[after] == wanted) return times[after]
            if (after == 0) return times[0] + (wanted - smooth[0]) / maxOf(series.speed[0], SLOWEST)
            val share = (wanted - smooth[after - 1]) / (smooth[after] - smooth[after - 1])
            return times[after - 1] + share * (times[after] - times[after - 1])
        }
    }

    private companion object {
        /** Of a boat at an end of its log, m/s. */
        const val SLOWEST = 0.01
    }
}
