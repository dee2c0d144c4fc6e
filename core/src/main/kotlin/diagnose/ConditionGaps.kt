package stillwater.diagnose

import kotlin.math.IEEErem
import kotlin.math.PI

/**
 * A condition whose numbers are missing in some rows of a log, and what stands in for them: between two numbers what lies
 * straight between them in time, before the first and after the last that one.
 *
 * Only short gaps can be bridged so. A row farther from the nearest number than [reach] is as far from it as the middle
 * of a gap in the log itself over which the diagnosis takes nothing to be known of the sensor ([MeasuredSeries.gap], 20
 * usual steps or a minute, whichever is longer): what the condition was there is a guess as well ([isFar]). And where
 * more than half of the rows have none, most of what a cause would be weighed by is not measured.
 *
 * @param times when each row was taken, s, strictly ascending. Not modified.
 * @param column the condition in each of them, NaN where it is missing. Not modified.
 * @param isCircular whether it is an angle, rad, between two of which the shorter way round is gone.
 */
public class ConditionGaps(
    private val times: DoubleArray,
    private val column: DoubleArray,
    private val isCircular: Boolean = false,
) {
    private val rows = column.size

    /** Row of the last number up to each row, -1 where there is none. */
    private val before = IntArray(rows)

    /** Row of the next number from each row on, [rows] where there is none. */
    private val after = IntArray(rows)

    init {
        require(times.size == rows) { "times (${times.size}) must be as many as numbers ($rows)" }
        var last = -1
        for (i in 0 until rows) {
            if (column[i].isFinite()) last = i
            before[i] = last
        }
        var next = rows
        for (i in rows - 1 downTo 0) {
            if (column[i].isFinite()) next = i
            after[i] = next
        }
    }

    /** Number of rows without a number. */
    public val missing: Int = column.count { !it.isFinite() }

    /** Whether at least half of the rows have a number. */
    public val isMostlyKnown: Boolean get() = 2 * missing <= rows

    /** How far a row may be from the nearest number for it to be bridged, s. */
    public val reach: Double = MeasuredSeries.gap(MeasuredSeries.period(times)) / 2

    /** Whether each row is farther than [reach] from the nearest number, in time. */
    public val isFar: BooleanArray = BooleanArray(rows) { i ->
        val back = if (before[i] < 0) Double.POSITIVE_INFINITY else times[i] - times[before[i]]
        val ahead = if (after[i] == rows) Double.POSITIVE_INFINITY else times[after[i]] - times[i]
        minOf(back, ahead) > reach
    }

    /** The condition with its gaps bridged, however long they are; 0 where there is no number at all. */
    public val bridged: DoubleArray
        get() = if (missing == 0) column else DoubleArray(rows, ::bridge)

    private fun bridge(i: Int): Double {
        val from = before[i]
        val to = after[i]
        return when {
            column[i].isFinite() -> column[i]
            from >= 0 && to < rows -> {
                val step = column[to] - column[from]
                val way = if (isCircular) step.IEEErem(2 * PI) else step
                column[from] + way * ((times[i] - times[from]) / (times[to] - times[from]))
            }
            from >= 0 -> column[from]
            to < rows -> column[to]
            else -> 0.0
        }
    }
}
