package stillwater.survey

/**
 * Order statistics of a set of numbers.
 *
 * @param numbers finite numbers in any order. Copied.
 */
class Quantiles(numbers: DoubleArray) {
    private val sorted = numbers.copyOf().apply { sort() }

    /** Number of numbers. */
    val count: Int get() = sorted.size

    /** The [share] quantile (0 to 1), linear between neighbours; NaN where there are no numbers. */
    operator fun get(share: Double): Double {
        require(share in 0.0..1.0) { "quantile ($share) must be in 0..1" }
        if (sorted.isEmpty()) return Double.NaN
        val place = share * (sorted.size - 1)
        val below = place.toInt()
        val above = minOf(below + 1, sorted.size - 1)
        return sorted[below] + (sorted[above] - sorted[below]) * (place - below)
    }

    /** How many numbers lie in each bin between neighbouring [edges], ascending; those outside in the outer bins. */
    fun counts(edges: DoubleArray): LongArray {
        val counts = LongArray(edges.size - 1)
        for (number in sorted) {
            val found = edges.binarySearch(number)
            val bin = if (found >= 0) found else -found - 2
            counts[bin.coerceIn(counts.indices)]++
        }
        return counts
    }

    /** The middle. */
    val median: Double get() = get(0.5)
}
