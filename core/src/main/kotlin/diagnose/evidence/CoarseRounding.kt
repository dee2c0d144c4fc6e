package stillwater.diagnose.evidence

import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.three

/**
 * How much of what readings scatter from row to row is their rounding.
 *
 * Rounding to steps of q adds a variance of q²/12 where the noise before it, or the water, moves readings by more than
 * a step, and holds them still where nothing does. The scatter is that of each reading about a parabola through the
 * rows beside it: neither water that nobody knows nor fixes that jitter are in it, and what else is makes the share
 * smaller.
 *
 * @param used rows that are looked at. @property step of rounding, sensor units; 0 where there is none.
 */
internal class CoarseRounding(series: MeasuredSeries, used: BooleanArray, val step: Double) {
    /** Rounding's variance over that of the scatter, dimensionless; infinite where readings stand still. */
    val share: Double

    init {
        val values = series.values
        val rows = (Neighbours.REACH until values.size - Neighbours.REACH).filter { i ->
            (i - Neighbours.REACH..i + Neighbours.REACH).all { used[it] }
        }
        val scatter = rows.sumOf { i -> Neighbours.off(values, i).let { it * it } } /
            (maxOf(rows.size, 1) * Neighbours.errorVariance)
        share = when {
            step <= 0 || rows.isEmpty() -> 0.0
            scatter > 0 -> step * step / 12 / scatter
            else -> Double.POSITIVE_INFINITY
        }
    }

    /**
     * Whether rounding shapes residuals of standard deviation [spread], sensor units: it makes more of the scatter than
     * all else together, and is no small part of what slower errors add to that.
     */
    fun isCoarse(spread: Double): Boolean = share > HALF && step * step / 12 > LEAST * spread * spread

    /** What is to be said of it where it is coarse. */
    fun words() =
        "Rounding to steps of ${three(step)} is most of what the readings scatter from row to row."

    private companion object {
        const val HALF = 0.5
        const val LEAST = 0.1
    }
}
