package stillwater.diagnose.response

import stillwater.diagnose.MeasuredSeries
import kotlin.math.ceil
import kotlin.math.sqrt

/** How much [truth], length n, changes within some time, root mean square. */
internal class TruthChanges(private val truth: DoubleArray) {
    private val known = HashMap<Int, Double>()

    /** Over so many [rows], whole or not; of less than one in proportion. Sensor units. */
    @Synchronized
    fun over(rows: Double): Double {
        if (!(rows > 0)) return 0.0
        val whole = ceil(rows).toInt().coerceIn(1, maxOf(truth.size / 2, 1))
        return minOf(rows, 1.0) * known.getOrPut(whole) { change(whole) }
    }

    private fun change(rows: Int): Double {
        var squares = 0.0
        for (i in rows until truth.size) squares += (truth[i] - truth[i - rows]) * (truth[i] - truth[i - rows])
        return sqrt(squares / maxOf(truth.size - rows, 1))
    }

    companion object {
        /** Of the reference of [series]; of nothing where it has none. */
        fun of(series: MeasuredSeries) = TruthChanges(series.reference ?: DoubleArray(0))
    }
}
