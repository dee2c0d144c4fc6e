package stillwater.diagnose

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
    fun single(): Double? = rows.maxByOrNull(::gain)?.let { timeBefore(refined(it)) }

    /** What the best place for one jump gains. */
    fun most(): Double = rows.maxOfOrNull(::gain) ?: 0.0

    /** The best places for two jumps, or null where there is no room. */
    fun pair(): List<Double>? {
        val columns = rows.map(::column)
        val shares = DoubleArray(rows.size) { dot(columns[it], whitened) }
        val lengths = DoubleArray(rows.size) { squares(columns[it]) }
        val best = JumpPairs.best(rows, edge, shares, lengths) { i, j -> dot(columns[i], columns[j]) }
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
        return near(row, from, to).maxByOrNull { gain(it, other) } ?: row
    }

    private fun column(row: Int) = column(fit, row, basis)

    private fun gain(row: Int) = gain(row, emptyList())

    /** What a jump at [row] gains beside [others], an orthonormal set. */
    private fun gain(row: Int, others: List<DoubleArray>): Double {
        val rest = if (others.isEmpty()) column(row) else Evidence.without(column(row), others)
        val length = squares(rest)
        val share = dot(rest, whitened)
        return if (length > LEAST) share * share / length else 0.0
    }

    private fun refined(row: Int) = near(row, edge, n - edge - 1).maxByOrNull(::gain) ?: row

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
        fun column(fit: ModelFit, row: Int, basis: List<DoubleArray>): DoubleArray {
            val z = DoubleArray(fit.model.series.size) { if (it >= row) 1.0 else 0.0 }
            fit.noise.whiten(z, z)
            return Evidence.without(z, basis)
        }
    }
}
