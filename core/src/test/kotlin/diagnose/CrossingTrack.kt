package stillwater.diagnose

import kotlin.math.exp
import kotlin.math.sin

/** A way of [rows] rows, one a second, that crosses itself often, in all directions, at up to 1 m/s. */
internal class CrossingTrack(private val rows: Int) {
    /** Seconds. */
    val times = DoubleArray(rows) { it.toDouble() }

    /** Metres east. */
    val x = DoubleArray(rows) { east(times[it]) }

    /** Metres north. */
    val y = DoubleArray(rows) { north(times[it]) }

    /** Water of three waves along it. */
    val truth = DoubleArray(rows) { water(x[it], y[it]) }

    /** What the last of [lags], s, in a row shows of [water] at each row, stepped a hundred times as often. */
    fun shown(vararg lags: Double, water: (Double, Double) -> Double = ::water): DoubleArray {
        val states = DoubleArray(lags.size) { water(x[0], y[0]) }
        return DoubleArray(rows) { row ->
            for (k in 0 until if (row > 0) STEPS else 0) {
                val time = row - 1 + (k + 0.5) / STEPS
                var input = water(east(time), north(time))
                for (i in lags.indices) {
                    states[i] += (1 - exp(-1 / (STEPS * lags[i]))) * (input - states[i])
                    input = states[i]
                }
            }
            states.last()
        }
    }

    private fun east(time: Double) = 15 * sin(time / 19)

    private fun north(time: Double) = 15 * sin(time / 25 + 1)

    private fun water(x: Double, y: Double) = sin(x / 4) + sin(y / 5 + 1) + sin((x + y) / 7)

    private companion object {
        const val STEPS = 100
    }
}
