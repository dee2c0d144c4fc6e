package stillwater.diagnose

import kotlin.math.sin

/** A way of [rows] rows, one a second, that crosses itself often, in all directions, at up to 1 m/s. */
internal class CrossingTrack(rows: Int) {
    /** Seconds. */
    val times = DoubleArray(rows) { it.toDouble() }

    /** Metres east. */
    val x = DoubleArray(rows) { 15 * sin(it / 19.0) }

    /** Metres north. */
    val y = DoubleArray(rows) { 15 * sin(it / 25.0 + 1) }

    /** Water of three waves along it. */
    val truth = DoubleArray(rows) { sin(x[it] / 4) + sin(y[it] / 5 + 1) + sin((x[it] + y[it]) / 7) }
}
