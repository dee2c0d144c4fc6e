package stillwater.estimate

import kotlin.math.ln

/**
 * A [series] resampled to even steps, each stretch without gaps by itself: points stand where readings are.
 *
 * Short gaps are bridged by a straight line in the readings that are transformed, [stretches], though no point stands
 * there: what a sensor showed before a gap goes on after it, and an end of a stretch is where a transform knows least.
 * A gap is bridged if it is at most [SHORT] of the longer of the two stretches that it lies between. Confined to its constructor.
 *
 * @param series the readings. Not retained. @param step time between points, s.
 */
internal class EvenPoints(private val series: TrackSeries, private val step: Double) {
    /** Time of each point, s. */
    val times = ArrayList<Double>()

    /** Its place, m. */
    val xs = ArrayList<Double>()
    val ys = ArrayList<Double>()

    /** Logarithm of the boat's speed there over the reference speed; 0 where unknown. */
    val logSpeeds = ArrayList<Double>()

    /** First point of the stretch without gaps that it is in. */
    val first = ArrayList<Int>()

    /** Readings at even steps, sensor units, bridges included, and the point that each is of, -1 in a bridge. */
    val stretches: List<Pair<DoubleArray, IntArray>>

    init {
        val starts = (0 until series.size).filter { it == 0 || series.isAfterGap(it) }
        val ends = starts.drop(1).map { it - 1 } + (series.size - 1)
        fun length(k: Int) = series.times[ends[k]] - series.times[starts[k]]
        val joined = ArrayList<IntRange>()
        for (k in starts.indices) {
            val isBridged = k > 0 &&
                series.times[starts[k]] - series.times[ends[k - 1]] <= SHORT * maxOf(length(k - 1), length(k))
            if (isBridged) joined += joined.removeLast().first..ends[k] else joined += starts[k]..ends[k]
        }
        stretches = joined.map(::resampled)
    }

    private fun resampled(rows: IntRange): Pair<DoubleArray, IntArray> {
        val count = ((series.times[rows.last] - series.times[rows.first]) / step).toInt() + 1
        val readings = DoubleArray(count)
        val at = IntArray(count)
        var row = rows.first
        var own = rows.first
        var begin = times.size
        for (i in 0 until count) {
            val time = series.times[rows.first] + i * step
            while (row < rows.last - 1 && series.times[row + 1] < time) row++
            val next = minOf(row + 1, rows.last)
            val span = series.times[next] - series.times[row]
            val share = if (span > 0) ((time - series.times[row]) / span).coerceIn(0.0, 1.0) else 0.0
            fun between(of: DoubleArray) = of[row] + share * (of[next] - of[row])
            readings[i] = between(series.values)
            at[i] = if (next > row && series.isAfterGap(next) && share > 0 && share < 1) -1 else times.size
            if (at[i] < 0) continue
            val before = own
            own = if (share < 1) row else next
            if ((before + 1..own).any(series::isAfterGap)) begin = times.size
            times += time
            xs += between(series.xs)
            ys += between(series.ys)
            logSpeeds += ln(series.pace(if (share < HALF) row else next, 1.0))
            first += begin
        }
        return readings to at
    }

    private companion object {
        /**
         * Part of the longer stretch beside it up to which a gap is bridged: rows that are missing within a leg, not what lies between
         * two casts of a float, a tenth of a cast and more, where the water is not as it is on a line.
         */
        const val SHORT = 0.05
        const val HALF = 0.5
    }
}
