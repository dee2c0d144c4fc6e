package stillwater.diagnose.evidence

import stillwater.diagnose.algebra.dots
import stillwater.diagnose.algebra.squares
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ResponseModel
import kotlin.math.abs

/**
 * Where jumps would explain most of what a [fit] leaves, s after the first row.
 *
 * A jump is a column of 0 and then 1; whitened, and made orthogonal to all that was fitted, its square share of the
 * residuals is what it would gain. Looked at are [count] even places twice over, and the rows that surprise most: under
 * noise that wanders a jump shows at its own row alone. While the sensor settles after a gap there are none: what is left
 * then may be of what it saw in the gap.
 *
 * @param whitened residuals to explain, those of [fit] unless others are simulated.
 */
internal class JumpPlaces(
    private val fit: ModelFit,
    private val count: Int,
    private val whitened: DoubleArray = fit.whitened,
) {
    private val series = fit.model.series
    private val n = series.size
    private val basis = Evidence.orthonormal(fit.jacobian.toList())
    private val edge = edge(n)
    private val stride = maxOf(n / (2 * count), 1)
    private val taken = fit.model.terms.flatMap { it.times }
    private val isSettling = settling()
    private val rows: List<Int> = run {
        val inner = (edge until n - edge).filterNot { isSettling[it] }
        val striking = inner.sortedByDescending { abs(whitened[it]) }.take(STRIKING)
        (inner.filter { (it - edge) % stride == 0 } + striking).distinct().sorted().filter { row ->
            taken.all { abs(it - (series.times[row] - series.times[0])) > series.duration / count }
        }
    }

    /** Which rows are less than some time constants after a gap, but for the first behind it. */
    private fun settling(): BooleanArray {
        val isGap = fit.model.scales.unknown?.isGap ?: return BooleanArray(n)
        val long = SETTLED * fit.numbers[ResponseModel.TIME_CONSTANT]
        var begun = Double.NEGATIVE_INFINITY
        return BooleanArray(n) { i ->
            if (isGap[i]) begun = series.times[i]
            !isGap[i] && series.times[i] - begun < long
        }
    }

    /** The best place for one jump, or null where there is no room. */
    fun single(): Double? = best(rows)?.let { timeBefore(refined(it)) }

    /** What the best place for one jump gains. */
    fun most(): Double = gains(rows).maxOrNull() ?: 0.0

    /** The best places for two jumps, or null where there is no room. */
    fun pair(): List<Double>? {
        val columns = columns(fit, rows, basis)
        val shares = dots(whitened, columns)
        val lengths = DoubleArray(rows.size) { squares(columns[it]) }
        val products = columns.indices.map { dots(columns[it], columns.subList(it, columns.size)) }
        val best = JumpPairs.best(rows, edge, shares, lengths) { i, j -> products[i][j - i] }
        return best?.let { (first, second) -> refined(first, second) }
    }

    /** [first] and [second] moved in turn to where they serve best, no farther than to the next places looked at. */
    private fun refined(first: Int, second: Int): List<Double> {
        val early = refined(first, beside = column(second), to = second - edge)
        val late = refined(second, beside = column(early), from = early + edge)
        return listOf(timeBefore(early), timeBefore(late))
    }

    private fun refined(row: Int, beside: DoubleArray, from: Int = edge, to: Int = n - edge - 1): Int {
        val other = Evidence.orthonormal(listOf(beside))
        return best(near(row, from, to), other) ?: row
    }

    private fun column(row: Int) = column(fit, row, basis)

    /** What a jump at each of [rows] gains beside [others], an orthonormal set. */
    private fun gains(rows: List<Int>, others: List<DoubleArray> = emptyList()): List<Double> {
        val columns = columns(fit, rows, basis).let { if (others.isEmpty()) it else Evidence.without(it, others) }
        val shares = dots(whitened, columns)
        return columns.mapIndexed { i, rest ->
            val length = squares(rest)
            if (length > LEAST) shares[i] * shares[i] / length else 0.0
        }
    }

    /** The first of [rows] at which a jump gains most beside [others]; null of none. */
    private fun best(rows: List<Int>, others: List<DoubleArray> = emptyList()): Int? {
        val gains = gains(rows, others)
        return rows.indices.maxByOrNull { gains[it] }?.let { rows[it] }
    }

    private fun refined(row: Int) = best(near(row, edge, n - edge - 1)) ?: row

    private fun near(row: Int, from: Int, to: Int) =
        (maxOf(row - stride, from)..minOf(row + stride, to)).filterNot { isSettling[it] }

    private fun timeBefore(row: Int) = (series.times[row] + series.times[row - 1]) / 2 - series.times[0]

    companion object {
        private const val STRIKING = 40
        private const val LEAST = 1e-9

        /** Time constants after which nothing is left of what a sensor has seen: a hundredth is. */
        private const val SETTLED = 5.0

        /** Rows at either end of a log of [size] that have no jump before them. */
        fun edge(size: Int): Int = maxOf(size / 50, 3)

        /** A jump at [row], whitened as in [fit], less what of it is in [basis]. */
        fun column(fit: ModelFit, row: Int, basis: List<DoubleArray>): DoubleArray =
            columns(fit, listOf(row), basis).single()

        /** The same of each of [rows]. */
        fun columns(fit: ModelFit, rows: List<Int>, basis: List<DoubleArray>): List<DoubleArray> {
            val columns = rows.map { row -> DoubleArray(fit.model.series.size) { if (it >= row) 1.0 else 0.0 } }
            fit.noise.whitenAll(columns)
            return Evidence.without(columns, basis)
        }
    }
}
