package stillwater.diagnose.evidence

import org.hipparchus.special.Beta
import org.hipparchus.special.Gamma
import stillwater.diagnose.algebra.dots
import stillwater.diagnose.algebra.squares
import kotlin.math.ln
import kotlin.math.sqrt

/** How strongly residuals speak, without the assumption that the noise model is right. */
internal object Evidence {
    /** Blocks over which scores are summed to see whether they are as independent as the noise model says. */
    private const val BLOCKS = 40

    /** A block that has more than the rest of this of a column says nothing by itself. */
    private const val SMALLEST_REST = 0.05

    /** Probability of a likelihood ratio (twice the difference of logarithms) of at least [ratio] by chance. */
    fun pValue(ratio: Double, degrees: Int): Double =
        if (!(ratio > 0)) 1.0 else Gamma.regularizedGammaQ(degrees / 2.0, ratio / 2)

    /** Probability of at least [count] events where [expected] are, Poisson. */
    fun poissonTail(count: Int, expected: Double): Double =
        if (count <= 0) 1.0 else Gamma.regularizedGammaP(count.toDouble(), expected)

    /** The probability that of [all] that go either way as often at most [count] go one way. */
    fun evenTail(count: Int, all: Int): Double = Beta.regularizedBeta(0.5, (all - count).toDouble(), count + 1.0)

    /** Holm's adjusted p-values of [pValues], in the same order, for [tried] tests in all. */
    fun holm(pValues: List<Double>, tried: Int = pValues.size): List<Double> {
        val order = pValues.indices.sortedBy { pValues[it] }
        val adjusted = DoubleArray(pValues.size)
        var highest = 0.0
        order.forEachIndexed { rank, i ->
            highest = maxOf(highest, minOf(1.0, pValues[i] * maxOf(tried - rank, 1)))
            adjusted[i] = highest
        }
        return adjusted.toList()
    }

    /**
     * How many times larger the variance of the score along [columns] is than the noise model says, at least 1.
     *
     * Columns are whitened, and orthogonal to what else was fitted. The variance is that of sums over blocks of rows:
     * what the whitening has missed of the residuals' correlation shows there, and so does noise that is larger where a
     * column is (White 1980, doi:10.2307/1912934). [z] are the whitened residuals; where [columns], of length 1 each,
     * were taken off them and [isGivenBack], each block's score is what it would be had it had no part in that
     * (MacKinnon and White 1985, doi:10.1016/0304-4076(85)90158-7).
     */
    fun inflation(columns: List<DoubleArray>, z: DoubleArray, isGivenBack: Boolean = false): Double {
        if (columns.isEmpty()) return 1.0
        val length = maxOf(z.size / BLOCKS, 1)
        val variance = squares(z) / maxOf(z.size, 1)
        var total = 0.0
        for (column in columns) {
            var blocks = 0.0
            var rows = 0.0
            var sum = 0.0
            var part = 0.0
            for (i in z.indices) {
                val score = column[i] * z[i]
                sum += score
                rows += score * score
                if (isGivenBack) part += column[i] * column[i]
                if ((i + 1) % length == 0 || i == z.size - 1) {
                    val own = sum / maxOf(1 - part, SMALLEST_REST)
                    blocks += own * own
                    sum = 0.0
                    part = 0.0
                }
            }
            val expected = minOf(rows, variance * squares(column))
            total += if (expected > 0) blocks / expected else 1.0
        }
        return maxOf(1.0, total / columns.size)
    }

    /** Probability of a Student's t of at least ±[t] with [degrees] of freedom. */
    fun student(t: Double, degrees: Int): Double =
        if (!t.isFinite()) 1.0 else Beta.regularizedBeta(degrees / (degrees + t * t), degrees / 2.0, 0.5)

    /** Mean of [differences] over its standard error. */
    fun t(differences: DoubleArray): Double {
        val mean = differences.average()
        val spread = sqrt(differences.sumOf { (it - mean) * (it - mean) } / (differences.size - 1))
        return mean / maxOf(spread / sqrt(differences.size.toDouble()), 1e-300)
    }

    /** [column] less its projection on [basis], an orthonormal set; as new array. */
    fun without(column: DoubleArray, basis: List<DoubleArray>): DoubleArray = without(listOf(column), basis).single()

    /** The same of each of [columns]. */
    fun without(columns: List<DoubleArray>, basis: List<DoubleArray>): List<DoubleArray> {
        val rests = columns.map { it.copyOf() }
        repeat(2) {
            for (direction in basis) {
                val shares = dots(direction, rests)
                rests.forEachIndexed { k, rest ->
                    val share = shares[k]
                    for (i in rest.indices) rest[i] -= share * direction[i]
                }
            }
        }
        return rests
    }

    /** An orthonormal set that spans [columns] beyond [basis]; directions of no weight are left out. */
    fun orthonormal(columns: List<DoubleArray>, basis: List<DoubleArray> = emptyList()): List<DoubleArray> {
        val found = ArrayList<DoubleArray>()
        for (column in columns) {
            val before = sqrt(squares(column))
            val rest = without(column, basis + found)
            val length = sqrt(squares(rest))
            if (length > 1e-7 * before && length > 0) found += DoubleArray(rest.size) { rest[it] / length }
        }
        return found
    }

    /** Twice the gain in log-likelihood when the square sum falls from [before] to [after] over [rows] rows. */
    fun ratio(before: Double, after: Double, rows: Int): Double =
        if (after <= 0 || before <= after) 0.0 else rows * ln(before / after)
}
