package stillwater.diagnose.algebra

import stillwater.diagnose.Loops

/**
 * Sums of many columns, four at a time and in stretches that stay in the processor's cache, so that the sum is not
 * read and written again for each.
 */
internal object Combination {
    private const val STRETCH = 512
    private const val FEW = 128

    /** Parts of the work that may be done at the same time. */
    private const val HALVES = 2

    /** The sum of [columns], each [rows] long, times the first of [heights], in halves that [loops] goes through. */
    fun of(columns: List<DoubleArray>, heights: DoubleArray, rows: Int, loops: Loops): DoubleArray {
        val out = DoubleArray(rows)
        loops.each(HALVES) { half ->
            add(columns, heights, out, columns.size, half * rows / HALVES, (half + 1) * rows / HALVES)
        }
        return out
    }

    /** The sum of [columns], each [rows] long, times each of [heights], in halves that [loops] goes through. */
    fun of(columns: List<DoubleArray>, heights: Array<DoubleArray>, rows: Int, loops: Loops): Array<DoubleArray> {
        val out = Array(heights.size) { DoubleArray(rows) }
        loops.each(HALVES) { half ->
            val end = (half + 1) * rows / HALVES
            // So many rows of all columns stay in the processor's cache.
            for (from in half * rows / HALVES until end step FEW) {
                for (k in heights.indices) {
                    add(columns, heights[k], out[k], columns.size, from, minOf(from + FEW, end))
                }
            }
        }
        return out
    }

    /** Adds the first [count] of [columns], times [heights], to the rows [from] until [to] of [out]. */
    fun add(
        columns: List<DoubleArray>,
        heights: DoubleArray,
        out: DoubleArray,
        count: Int = columns.size,
        from: Int = 0,
        to: Int = out.size,
    ) {
        var first = from
        while (first < to) {
            val last = minOf(first + STRETCH, to)
            for (k in 0 until count step 4) {
                if (k + 3 < count) {
                    val four = FourColumns(columns[k], columns[k + 1], columns[k + 2], columns[k + 3])
                    four.add(out, first, last, heights[k], heights[k + 1], heights[k + 2], heights[k + 3])
                } else {
                    for (j in k until count) one(out, first, last, heights[j], columns[j])
                }
            }
            first = last
        }
    }

    private fun one(out: DoubleArray, from: Int, to: Int, height: Double, column: DoubleArray) {
        for (i in from until to) out[i] += height * column[i]
    }
}
