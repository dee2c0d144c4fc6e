package stillwater.diagnose.evidence

import kotlin.math.sqrt

/** What makes [column] of mean 0 and spread 1. */
internal class Standard(column: DoubleArray) {
    private val mean = column.average()

    /** Standard deviation of the column, its unit. */
    val spread: Double = sqrt(column.sumOf { (it - mean) * (it - mean) } / column.size)

    /** Another column by the same mean and spread; 0 where that does not change. */
    fun of(other: DoubleArray): DoubleArray =
        DoubleArray(other.size) { if (spread > 0) (other[it] - mean) / spread else 0.0 }
}
