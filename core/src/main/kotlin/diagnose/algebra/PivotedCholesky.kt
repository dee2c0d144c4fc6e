package stillwater.diagnose.algebra

import stillwater.diagnose.Loops
import kotlin.math.sqrt

/**
 * The first columns of the pivoted Cholesky factor of a covariance between rows.
 *
 * Source: Harbrecht, Peters and Schneider 2012, On the low-rank approximation by the pivoted Cholesky decomposition,
 * doi:10.1016/j.apnum.2011.10.001.
 *
 * @property columns each along the rows. @property pivots the row that told most when each was added. @property left the
 *   greatest variance of a row that they do not have.
 */
internal class PivotedCholesky private constructor(
    val columns: List<DoubleArray>,
    val pivots: List<Int>,
    val left: Double,
) {
    /** What two rows have in common. */
    fun interface Covariance {
        /** Between rows [a] and [b]. */
        fun of(a: Int, b: Int): Double
    }

    companion object {
        /** Part of a variance that may be left anywhere. */
        const val LEFT = 1e-6

        /** So many rows tell how many columns all of them take. */
        const val THINNED = 1200

        /** Products of a column from which on it is found in parts: some fifty microseconds. */
        private const val LEAST_PART = 250_000

        /**
         * As many columns as leave less than [left] of the [variance] of any of [count] rows; [most] at most. Each is
         * found in parts that [loops] goes through.
         */
        fun of(
            count: Int,
            variance: Double,
            left: Double,
            most: Int,
            loops: Loops = Loops.IN_TURN,
            covariance: Covariance,
        ): PivotedCholesky {
            val columns = ArrayList<DoubleArray>()
            val pivots = ArrayList<Int>()
            val rest = DoubleArray(count) { variance }
            while (columns.size < most) {
                val pivot = greatest(rest)
                if (rest[pivot] < left) break
                val column = between(count, pivot, covariance)
                subtract(columns, pivot, column, loops)
                take(column, 1 / sqrt(rest[pivot]), rest)
                rest[pivot] = 0.0
                columns += column
                pivots += pivot
            }
            return PivotedCholesky(columns, pivots, rest.max())
        }

        // Java compiles a loop within a long method together with all of it, and once more for each such loop.

        private fun greatest(rest: DoubleArray): Int {
            var pivot = 0
            for (i in 1 until rest.size) if (rest[i] > rest[pivot]) pivot = i
            return pivot
        }

        private fun between(count: Int, pivot: Int, covariance: Covariance) =
            DoubleArray(count) { covariance.of(it, pivot) }

        /** Takes what [columns] have of the row [pivot] off [column]. */
        private fun subtract(columns: List<DoubleArray>, pivot: Int, column: DoubleArray, loops: Loops) {
            val count = column.size
            val heights = DoubleArray(columns.size) { -columns[it][pivot] }
            // Few columns are done before another thread has begun.
            val parts = if (columns.size * count > LEAST_PART) 2 else 1
            loops.each(parts) { part ->
                Combination.add(
                    columns,
                    heights,
                    column,
                    columns.size,
                    part * count / parts,
                    (part + 1) * count / parts,
                )
            }
        }

        /** Makes [column], times [scale], one of unit variance, and takes what it has of each row off [rest]. */
        private fun take(column: DoubleArray, scale: Double, rest: DoubleArray) {
            for (i in column.indices) {
                column[i] *= scale
                rest[i] = maxOf(rest[i] - column[i] * column[i], 0.0)
            }
        }
    }
}
