package stillwater.diagnose.track

import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.algebra.SymmetricSystem
import stillwater.model.Conditions
import kotlin.math.cos
import kotlin.math.sin

/**
 * The way reckoned from a log's speed and heading, up to what is smooth in time.
 *
 * By which custom headings count, how speed is scaled and what current there is is told by the fixes: their way over
 * some rows is a linear function of the reckoned way and of the time that it took.
 *
 * @property x metres east, length n. @property y metres north, length n.
 */
internal class DeadReckoning private constructor(val x: DoubleArray, val y: DoubleArray) {
    companion object {
        private const val ROWS = 10
        private const val FEWEST = 50

        /** The way of [series], whose fixes are [x] and [y]; null where it has no speed and heading for all rows. */
        fun of(series: MeasuredSeries, x: DoubleArray, y: DoubleArray): DeadReckoning? {
            val speed = series.conditions[Conditions.SPEED] ?: return null
            val heading = series.conditions[Conditions.HEADING] ?: return null
            val n = series.size
            if (!speed.all { it.isFinite() } || !heading.all { it.isFinite() }) return null
            val ways = arrayOf(
                summed(series) { speed[it] * cos(heading[it]) },
                summed(series) { speed[it] * sin(heading[it]) },
                DoubleArray(n) { series.times[it] - series.times[0] },
            )
            // What the boat did over a gap is in no column.
            val from = (0 until n - ROWS).filter { i ->
                (i until i + ROWS).none { series.times[it + 1] - series.times[it] > series.gap }
            }
            if (from.size < FEWEST) return null
            fun steps(column: DoubleArray) = DoubleArray(from.size) { column[from[it] + ROWS] - column[from[it]] }
            val steps = Array(ways.size) { steps(ways[it]) }
            fun along(fixes: DoubleArray): DoubleArray {
                val shares = SymmetricSystem.of(steps, steps(fixes)).solve(0.0)
                return DoubleArray(n) { i -> ways.indices.sumOf { shares[it] * ways[it][i] } }
            }
            return DeadReckoning(along(x), along(y)).takeIf { way -> (way.x + way.y).all { it.isFinite() } }
        }

        /** The integral of [rate] over time, by trapezoids; nothing over gaps. */
        private fun summed(series: MeasuredSeries, rate: (Int) -> Double): DoubleArray {
            val out = DoubleArray(series.size)
            for (i in 1 until out.size) {
                val dt = series.times[i] - series.times[i - 1]
                out[i] = out[i - 1] + if (dt <= series.gap) (rate(i) + rate(i - 1)) / 2 * dt else 0.0
            }
            return out
        }
    }
}
