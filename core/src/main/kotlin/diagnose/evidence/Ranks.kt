package stillwater.diagnose.evidence

/** Ranks of numbers as shares of all of them. */
internal object Ranks {
    /** For each of [column] the share that is below it, of equal ones half; within 0..1. */
    fun of(column: DoubleArray): DoubleArray {
        val sorted = column.sortedArray()
        return DoubleArray(column.size) { rank(sorted, column[it]) }
    }

    /** The share of [sorted] below [value], of equal ones half. */
    private fun rank(sorted: DoubleArray, value: Double): Double {
        fun below(limit: (Double) -> Boolean): Int {
            var low = 0
            var high = sorted.size
            while (low < high) {
                val middle = (low + high) / 2
                if (limit(sorted[middle])) low = middle + 1 else high = middle
            }
            return low
        }
        return (below { it < value } + below { it <= value }) / 2.0 / sorted.size
    }
}
