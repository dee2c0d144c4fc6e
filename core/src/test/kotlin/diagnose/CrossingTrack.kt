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
    fun shown(vararg lags: Double, water: (Double, Double) -> Double = ::water): DoubleArray =
        stepped(lags.size, water) { i, _ -> lags[i] }

    /** The same of one lag of [rising] s, and of [falling] s where the water is below what it shows. */
    fun shownUnevenly(rising: Double, falling: Double): DoubleArray =
        stepped(1, ::water) { _, above -> if (above > 0) rising else falling }

    /** What the last of [count] lags in a row shows; [lag] is told which, and how far what it follows is above it. */
    private inline fun stepped(
        count: Int,
        water: (Double, Double) -> Double,
        lag: (Int, Double) -> Double,
    ): DoubleArray {
        val states = DoubleArray(count) { water(x[0], y[0]) }
        return DoubleArray(rows) { row ->
            for (k in 0 until if (row > 0) STEPS else 0) {
                val time = row - 1 + (k + 0.5) / STEPS
                var input = water(east(time), north(time))
                for (i in states.indices) {
                    val above = input - states[i]
                    states[i] += (1 - exp(-1 / (STEPS * lag(i, above)))) * above
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
