package stillwater.diagnose

import kotlin.math.exp

/**
 * What errors of fixes that wander do to readings: an error of e metres east and f north adds [east]·e + [north]·f, where e
 * and f are Ornstein-Uhlenbeck processes of one variance and one time.
 *
 * Source: McHutchon and Rasmussen 2011, Gaussian process training with input noise, for errors that do not wander.
 *
 * @property east slope of the water to the east as the sensor shows it, sensor units/m, length n. @property north the same
 *   to the north. @property variance of e and of f over the noise's, m² per squared sensor unit. @property time over
 *   which they wander, s.
 */
internal class FixWander(
    val east: DoubleArray,
    val north: DoubleArray,
    val variance: Double,
    val time: Double,
) {
    /** Mean square of the slopes, squared sensor units/m². */
    val usual: Double get() = (squares(east) + squares(north)) / east.size

    /** The same to readings of which each is divided by its [spread]. */
    fun over(spread: DoubleArray) = FixWander(
        DoubleArray(east.size) { east[it] / spread[it] },
        DoubleArray(north.size) { north[it] / spread[it] },
        variance,
        time,
    )

    /** The same errors of another [variance] that wander over another [time], s. */
    fun with(variance: Double, time: Double) = FixWander(east, north, variance, time)

    /** The two processes at the rows' [times], s. */
    fun processes(times: DoubleArray): List<ProcessFilter.Process> {
        val keep = DoubleArray(times.size) { if (it == 0) 1.0 else exp(-(times[it] - times[it - 1]) / time) }
        val added = DoubleArray(times.size) { variance * (1 - keep[it] * keep[it]) }
        return listOf(east, north).map { ProcessFilter.Process(keep, added, variance, it) }
    }
}
