package stillwater.diagnose.evidence

import stillwater.diagnose.median
import stillwater.diagnose.response.ModelFit
import kotlin.math.abs
import kotlin.math.sqrt

/** Where residuals scatter more than elsewhere. */
internal object LocalSpread {
    private const val PARTS = 24
    private const val FEWEST = 40
    private const val FEWEST_USED = 10

    /** Rows, and standard errors of their mean rank, from which they are gathered. */
    private const val FEWEST_GATHERED = 4
    private const val GATHERED = 3.3

    /** Relative. */
    private const val ROUNDING = 1e-9

    /** Three standard errors of a median of absolute normal residuals, in itself, times the root of their number. */
    private const val CLEAR = 3.5

    /**
     * For each row by how much [z], residuals of [fit], scatter more than overall at such times, values, rates or
     * conditions. Rows in which they are 0 are not in use.
     */
    fun of(fit: ModelFit, z: DoubleArray): DoubleArray = of(z, columns(fit))

    /**
     * Whether [rows] are gathered at some times, values, rates or conditions: then it is the noise that is larger
     * there. By the mean of their ranks, and by how far these are from the middle.
     */
    fun isConcentrated(fit: ModelFit, rows: List<Int>): Boolean {
        if (rows.size < FEWEST_GATHERED) return false
        // Correlated noise makes two of a single wild reading.
        val alone = rows.filterNot { it - 1 in rows && it - 2 !in rows && it + 1 !in rows }
        return columns(fit).filter(::isVaried).any { column ->
            val all = Ranks.of(column)
            val away = DoubleArray(column.size) { 2 * abs(all[it] - 0.5) }
            isOff(alone, all) || isOff(alone, away)
        }
    }

    /** Whether the mean of [ranks] in [rows] is off that of all, of which many may be equal. */
    private fun isOff(rows: List<Int>, ranks: DoubleArray): Boolean {
        val mean = ranks.average()
        val spread = sqrt(ranks.sumOf { (it - mean) * (it - mean) } / ranks.size)
        return abs(rows.map { ranks[it] }.average() - mean) * sqrt(rows.size.toDouble()) > GATHERED * spread
    }

    /** Whether [column] has different values by more than the rounding of what was reckoned, as a speed from fixes is. */
    private fun isVaried(column: DoubleArray): Boolean {
        val lowest = column.min()
        val highest = column.max()
        return highest - lowest > ROUNDING * maxOf(abs(lowest), abs(highest))
    }

    private fun columns(fit: ModelFit): List<DoubleArray> {
        val series = fit.model.series
        val shown = fit.predicted
        val rates = DoubleArray(series.size) { abs(shown[it] - shown[maxOf(it - 1, 0)]) }
        // A lag shows a front late and flat: noise that is larger in the front itself goes with the truth's own rate.
        val truth = series.reference?.let { u ->
            DoubleArray(u.size) { abs(u[minOf(it + 1, u.size - 1)] - u[maxOf(it - 1, 0)]) }
        }
        return listOf(series.times, shown, rates, series.speed) + listOfNotNull(truth) +
            fit.model.scales.centred.values
    }

    /**
     * For each row by how much [z] scatter more than overall among rows alike in one of [columns], at least 1; of the
     * columns the one that says most. Spreads are robust: single wild rows do not count.
     */
    private fun of(z: DoubleArray, columns: List<DoubleArray>): DoubleArray {
        val factors = DoubleArray(z.size) { 1.0 }
        val size = maxOf(z.size / PARTS, FEWEST)
        val overall = scatter(z, z.indices.toList())
        if (z.size < 2 * size || !(overall > 0)) return factors
        for (column in columns) {
            val order = column.indices.sortedBy { column[it] }
            for (part in order.chunked(size)) {
                // The last rows are too few by themselves.
                val rows = if (part.size < size) order.takeLast(size) else part
                val used = rows.count { z[it] != 0.0 }
                if (used < FEWEST_USED) continue
                val factor = scatter(z, rows) / overall
                val least = 1 + CLEAR / sqrt(used.toDouble())
                if (factor > least) for (i in part) factors[i] = maxOf(factors[i], factor)
            }
        }
        return factors
    }

    /** The median of how far [z] are off 0 in those of [rows] that are in use; NaN of none. */
    private fun scatter(z: DoubleArray, rows: Collection<Int>): Double {
        val sizes = DoubleArray(rows.size)
        var count = 0
        for (row in rows) if (z[row] != 0.0) sizes[count++] = abs(z[row])
        return median(sizes.copyOf(count))
    }
}
