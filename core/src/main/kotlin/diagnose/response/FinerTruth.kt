package stillwater.diagnose.response

import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.algebra.SymmetricSystem
import stillwater.model.Conditions
import kotlin.math.exp

/**
 * A log with the truth halfway between its rows as well. Where rows are few to a wave a spline through them is wrong by more
 * than the noise of a good sensor, and always in the same way: as if the response had another shape.
 *
 * Halfway is what the rows beside it foretell of a Gaussian process with the covariance exp(−Δt²/2ℓ²), for waves of more than
 * two rows nearly all that can be told; see core/docs/Diagnosis.md, (1). There is no row between where the step is a gap or
 * the truth moves within it.
 *
 * Source: Rasmussen and Williams 2006, Gaussian Processes for Machine Learning, (2.23).
 *
 * @param log its reference must be there. @param unknown what that leaves open; null for nothing.
 * @param lengthScale ℓ in usual steps, above 0.
 */
internal class FinerTruth(private val log: MeasuredSeries, unknown: UnknownTruth?, lengthScale: Double) {
    private val n = log.size
    private val truth = requireNotNull(log.reference) { "a finer truth needs a reference" }
    private val length = lengthScale * log.period
    private val isApart =
        BooleanArray(n) { it == 0 || unknown?.isGap?.get(it) == true || unknown?.isBroken?.get(it) == true }

    /** Where each row of the log is among those of [series], length n. */
    val rows: IntArray = IntArray(n).also { for (i in 1 until n) it[i] = it[i - 1] + if (isApart[i]) 1 else 2 }

    /** The log with rows between; its readings there are none. */
    val series: MeasuredSeries

    /** What its reference leaves open; null for nothing. */
    val unknown: UnknownTruth?

    init {
        val times = of(log.times)
        this.unknown = unknown?.among(rows, times)
        val course = of(truth)
        for (i in 1 until n) if (!isApart[i]) course[rows[i] - 1] = foretold(i, times[rows[i] - 1])
        // Headings go round, and no response asks for them.
        val conditions = log.conditions.keys.filter { it != Conditions.HEADING }
            .associateWith { of(checkNotNull(log.filled(it))) } + (Conditions.SPEED to of(log.speed))
        series = MeasuredSeries(times, of(log.x), of(log.y), of(log.values), course, conditions)
    }

    /** [column] of the log with the middle of both neighbours in each row between. */
    fun of(column: DoubleArray): DoubleArray {
        val out = DoubleArray(rows[n - 1] + 1)
        for (i in 0 until n) {
            out[rows[i]] = column[i]
            if (i > 0 && !isApart[i]) out[rows[i] - 1] = (column[i - 1] + column[i]) / 2
        }
        return out
    }

    /** [columns] so, by their names. */
    fun of(columns: Map<String, DoubleArray>): Map<String, DoubleArray> =
        columns.mapValues { (_, column) -> of(column) }

    /** The truth at [time], before row [i], as the rows on either side foretell it. */
    private fun foretold(i: Int, time: Double): Double {
        var from = i - 1
        while (i - from < SIDE && !isApart[from]) from--
        var last = i
        while (last < n - 1 && last - i < SIDE - 1 && !isApart[last + 1]) last++
        val count = last - from + 1
        val kernel = Array(count) { k ->
            DoubleArray(count) { j -> covariance(log.times[from + k] - log.times[from + j]) }.also { it[k] += NUGGET }
        }
        val weights = SymmetricSystem(kernel, DoubleArray(count) { covariance(log.times[from + it] - time) }).solve(0.0)
        var sum = 0.0
        for (k in 0 until count) sum += weights[k] * truth[from + k]
        // The level is not known.
        return sum / weights.sum()
    }

    private fun covariance(apart: Double) = exp(-apart * apart / (2 * length * length))

    companion object {
        /** Length scales that are tried, in usual steps: from waves of two rows on to smooth water. */
        val LENGTHS: List<Double> = listOf(0.7, 1.0, 1.4, 2.0)

        /** Rows on either side. */
        private const val SIDE = 10

        /** Of the process's variance, what is added to each row's so that rows near each other do not count for more than they tell. */
        private const val NUGGET = 1e-6
    }
}
