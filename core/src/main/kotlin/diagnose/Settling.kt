package stillwater.diagnose

import java.util.Locale
import kotlin.math.exp
import kotlin.math.ln

/**
 * An offset that settles, as of a probe that warms up, in the place of a drift or of jumps of the model [last]: those of
 * [chosen] alone are looked at.
 */
internal class Settling(private val last: ModelFit, private val chosen: List<Trial>) {
    private val series = last.model.series

    /** What is to be said; null where nothing is in its place or the log is not clearly likelier with it. */
    fun words(): String? {
        val slow = chosen.filter { it.term.cause in LIKE }
        if (slow.isEmpty()) return null
        val columns = last.free.indices.filter { last.free[it] }.zip(last.jacobian.toList())
        val own = slow.flatMap { trial ->
            last.model.slotOrNull(trial.term)?.let { it until it + width(trial) }
                ?: IntRange.EMPTY
        }
        val basis = Evidence.orthonormal(columns.filter { (i, _) -> i !in own }.map { it.second })
        // Both act on the readings as they are, so that what they add is their column times their number.
        val before = last.whitened.copyOf()
        for ((i, column) in columns) {
            if (i in own) for (row in before.indices) before[row] += last.numbers[i] * column[row]
        }
        val all = Evidence.without(before, basis)
        val rows = last.noise.rows
        val theirs = Evidence.ratio(squares(all), squares(last.whitened), rows) - slow.sumOf { it.cost }
        val (time, size, gain) = TIMES.map { share -> settled(share * series.duration, all, basis) }.maxBy { it.third }
        if (Evidence.ratio(squares(all), squares(all) - gain, rows) - COST <= maxOf(theirs, 0.0) + CLEARLY) return null
        return words(size, time)
    }

    private fun width(trial: Trial) = last.model.width(trial.term)

    /** What an offset that settles with [time], s, is of [all], its size, and the squares it takes off. */
    private fun settled(time: Double, all: DoubleArray, basis: List<DoubleArray>): Triple<Double, Double, Double> {
        val shown = column(series, time).also { last.noise.whiten(it, it) }
        val free = Evidence.without(shown, basis)
        val share = squares(free)
        if (!(share > LEAST * squares(shown))) return Triple(time, 0.0, 0.0)
        val size = dot(free, all) / share
        return Triple(time, size, size * size * share)
    }

    companion object {
        /** Over the log's duration, within which it is to settle. */
        val TIMES = listOf(0.02, 0.03, 0.05, 0.08, 0.12, 0.18, 0.25, 0.33)

        /** Twice a log-likelihood: of a number, and of the choice among [TIMES]. */
        val COST = 2 + 2 * ln(TIMES.size.toDouble())
        private val LIKE = setOf(Cause.DRIFT, Cause.OFFSET_STEPS)

        /** Twice the logarithm of odds of 10:1. */
        private const val CLEARLY = 4.6
        private const val LEAST = 1e-9

        /** Time constants after which 95 % is done. */
        private const val SETTLED = 3.0

        /** An offset of [series] that moves from 0 to 1 and has settled after some [time], s. */
        fun column(series: MeasuredSeries, time: Double): DoubleArray =
            DoubleArray(series.size) { 1 - exp(-(series.times[it] - series.times[0]) / time) }

        /** An offset that moves by [size] with [time], s, for the reader. */
        fun words(size: Double, time: Double): String =
            "an offset that moves by %.2g and settles within some %.2g s".format(Locale.ROOT, size, SETTLED * time) +
                ", as of a probe that warms up or is overgrown"
    }
}
