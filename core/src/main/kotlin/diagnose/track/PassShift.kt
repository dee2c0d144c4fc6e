package stillwater.diagnose.track

import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.median
import kotlin.math.floor
import kotlin.math.hypot

/** By how much later the readings of [series] agree best where its track comes back to a place. */
internal class PassShift(private val series: MeasuredSeries) {
    private val n = series.size
    private val reach =
        NEAR * median(DoubleArray(n - 1) { hypot(series.x[it + 1] - series.x[it], series.y[it + 1] - series.y[it]) })

    /** In s, a row and more; null where none agrees much better than readings as they are. */
    fun late(): Double? {
        if (!(reach > 0)) return null
        val longest = minOf(series.duration / PARTS, MOST_ROWS * series.period)
        val shifts = generateSequence(LEAST_ROWS * series.period) { maxOf(it + series.period, it * GROWTH) }
            .takeWhile { it < longest }.toList()
        val asIs = mismatch(0.0)
        val best = shifts.map { it to mismatch(it) }.filter { it.second.isFinite() }.minByOrNull { it.second }
        return best?.takeIf { it.second < BETTER * asIs }?.first
    }

    /** The mean square of how readings differ from the nearest at another time, with the boat's places [delay] s before. */
    private fun mismatch(delay: Double): Double {
        val at = if (delay > 0) series.atPlacesBefore(delay) else series
        val apart = series.duration / PARTS
        val cells = HashMap<Pair<Long, Long>, ArrayList<Int>>()
        fun cell(place: Double) = floor(place / reach).toLong()
        for (i in 0 until n) cells.getOrPut(cell(at.x[i]) to cell(at.y[i])) { ArrayList() } += i
        var sum = 0.0
        var count = 0
        for (i in 0 until n) {
            fun away(k: Int) = hypot(at.x[i] - at.x[k], at.y[i] - at.y[k])
            val columns = cell(at.x[i]) - 1..cell(at.x[i]) + 1
            val rows = cell(at.y[i]) - 1..cell(at.y[i]) + 1
            val other = columns.flatMap { a -> rows.flatMap { b -> cells[a to b].orEmpty() } }
                .filter { series.times[i] - series.times[it] >= apart && away(it) < reach }
                .minByOrNull(::away) ?: continue
            sum += (series.values[i] - series.values[other]).let { it * it }
            count++
        }
        return if (count >= FEWEST) sum / count else Double.NaN
    }

    private companion object {
        /** Steps from row to row within which two passes are at one place. */
        const val NEAR = 1.5

        /** Of the log's duration: as far apart two passes are, and no shift is longer. */
        const val PARTS = 12

        /** Rows of the shifts that are tried, and how much longer each is. */
        const val LEAST_ROWS = 4
        const val MOST_ROWS = 300
        const val GROWTH = 1.08

        /** Of the mean square as measured, below which readings agree better. */
        const val BETTER = 0.6

        /** Places passed twice that are needed. */
        const val FEWEST = 20
    }
}
