package stillwater.diagnose.track

import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.median

/** Fixes that a log repeats, row by row, until the receiver has a new one. */
internal object RepeatedFixes {
    /** So many times as long as others a fix is repeated by a boat that rests. */
    private const val RESTING = 3

    /** For each row of [series] whether its fix is one of its own, or the boat rests at it. */
    fun known(series: MeasuredSeries): BooleanArray {
        // The rows since a fix came, and for each fix how many rows have it.
        val since = IntArray(series.size)
        val lengths = ArrayList<Double>()
        for (i in since.indices) {
            val isRepeated = i > 0 && series.x[i] == series.x[i - 1] && series.y[i] == series.y[i - 1]
            since[i] = if (isRepeated) since[i - 1] + 1 else 0
            if (isRepeated) lengths[lengths.size - 1]++ else lengths += 1.0
        }
        val usual = median(lengths.toDoubleArray())
        return BooleanArray(since.size) { since[it] == 0 || since[it] >= RESTING * usual }
    }
}
