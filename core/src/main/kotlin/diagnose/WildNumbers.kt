package stillwater.diagnose

import kotlin.math.abs

/**
 * Single numbers of a column that are far beyond all others: a telegram that was garbled, an error's code. They are found
 * before anything is fitted, which they would spoil.
 */
internal object WildNumbers {
    /** How far off such a number is, in all that the others reach over. */
    private const val BEYOND = 10.0

    /** Of all rows, and rows that are always allowed. */
    private const val MOST = 0.01
    private const val ALWAYS = 3

    /**
     * The rows of [column], in order, that hold one; none unless each stands between two others that are as all the rest.
     */
    fun of(column: DoubleArray): List<Int> {
        val n = column.size
        val most = minOf(maxOf((MOST * n).toInt(), ALWAYS), n - 2)
        if (most < 1) return emptyList()
        val middle = median(column)
        val farthest = column.indices.sortedByDescending { abs(column[it] - middle) }
        for (count in 1..most) {
            // What is as far off as the next may belong to it.
            val wild = farthest.take(count)
            val next = abs(column[farthest[count]] - middle)
            if (abs(column[wild.last()] - middle) <= BEYOND * next) continue
            val rows = wild.sorted()
            val rest = farthest.drop(count)
            val range = rest.maxOf { column[it] } - rest.minOf { column[it] }
            val isFar = rows.all { abs(column[it] - middle) > BEYOND * range }
            val areSingle = rows.zipWithNext().all { (before, after) -> after > before + 1 }
            if (isFar && areSingle && range > 0) return rows
        }
        return emptyList()
    }

    /** That [count] numbers of the reference are wild, for the reader. */
    fun words(count: Int): String = if (count == 1) {
        "1 number of the reference is far beyond all others: the mean of those beside it was taken in its place."
    } else {
        "$count single numbers of the reference are far beyond all others: the means of those beside them were " +
            "taken in their place."
    }

    /** [column] with the mean of those beside it in each of [rows], none of which is next to another. */
    fun bridged(column: DoubleArray, rows: List<Int>): DoubleArray {
        val bridged = column.copyOf()
        for (row in rows) {
            val before = column[if (row > 0) row - 1 else row + 1]
            val after = column[if (row < column.size - 1) row + 1 else row - 1]
            bridged[row] = (before + after) / 2
        }
        return bridged
    }
}
