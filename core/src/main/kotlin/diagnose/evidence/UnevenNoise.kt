package stillwater.diagnose.evidence

import stillwater.diagnose.algebra.dot
import stillwater.diagnose.algebra.squares
import stillwater.diagnose.median
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.RangeEnd
import java.util.Locale
import kotlin.math.abs
import kotlin.math.sqrt

/**
 * Noise that is larger at some values, or grows as time goes on, in what a model leaves of a log with a reference.
 *
 * Asked by the rank correlation (Spearman's) of how far whitened residuals are off 0 with the value and with the time:
 * single wild readings and heavy tails weigh no more than others. Where the truth moves fast, what is not known of it
 * between the rows makes residuals larger: the fastest rows do not count, and of all others what goes with how fast it
 * moves is taken off both.
 */
internal class UnevenNoise(private val fit: ModelFit) {
    private val series = fit.model.series
    private val rates = listOf(checkNotNull(series.reference), fit.predicted).map { column ->
        DoubleArray(column.size) { abs(series.rise(column, it, it)) }
    }
    private val rows = calmRows()
    private val sizes = DoubleArray(rows.size) { abs(fit.whitened[rows[it]]) }

    /** A constant, and what goes with how fast the truth moves and with how fast what is shown of it does, straight or curved. */
    private val moving by lazy {
        val ranks = rates.map { rate -> Ranks.of(DoubleArray(rows.size) { rate[rows[it]] }) }
        val curved = ranks.map { rank -> DoubleArray(rank.size) { rank[it] * rank[it] } }
        Evidence.orthonormal(listOf(DoubleArray(rows.size) { 1.0 }) + ranks + curved)
    }

    /**
     * In words, what the noise goes with for certain at this [level], of both quantities together; null where it is as large
     * everywhere or not much larger anywhere, and of readings in steps as large as their noise.
     */
    fun words(level: Double): String? {
        val isCoarse = fit.model.scales.resolution > sqrt(fit.variance)
        if (rows.size < FEWEST || isCoarse) return null
        val high = Quantity("value", fit.predicted, "where it is high", "where it is low")
        val late = Quantity("time", series.times, "late in the log", "early")
        val told = listOf(high, late).filter { it.chance * QUANTITIES < level && it.isMuch }
        val most = told.maxByOrNull { it.ratio } ?: return null
        val times = "%.1f".format(Locale.ROOT, most.times)
        return "the noise goes with the ${most.name}: readings scatter $times times as much ${most.where}"
    }

    /** What the noise may go with, and how much. */
    private inner class Quantity(val name: String, column: DoubleArray, high: String, low: String) {
        private val own = DoubleArray(rows.size) { column[rows[it]] }
        private val order = own.indices.sortedBy { own[it] }
        private val larger = scatter(order.takeLast(rows.size / 3)) / scatter(order.take(rows.size / 3))

        /** How many times as large the noise is in the third of the rows with the highest values as in the lowest, or the other way. */
        val times = maxOf(larger, 1 / larger)
        val isMuch = times >= CLEARLY && times.isFinite()
        val where = if (larger > 1) "$high as $low" else "$low as $high"

        /** The rows times the square of the rank correlation: χ² of one degree of freedom if there is none. */
        val ratio: Double = Evidence.without(listOf(Ranks.of(own), Ranks.of(sizes)), moving).let { (own, sizes) ->
            dot(own, sizes).let { it * it } / (squares(own) * squares(sizes)) * (rows.size - moving.size)
        }

        /** How likely so much of it is if there is none. */
        val chance: Double get() = Evidence.pValue(ratio, 1)

        private fun scatter(some: List<Int>) = median(DoubleArray(some.size) { sizes[some[it]] })
    }

    /** Rows in use but for the quarters in which the truth, and what the sensor shows of it, move fastest. */
    private fun calmRows(): List<Int> {
        val most = rates.map { it.sortedArray()[it.size * 3 / 4] }
        // At an end of the range readings are as even as that is.
        val isAtEnd = RangeEnd.beyond(fit.model, fit.numbers)
        val used = fit.noise.used
        return used.indices.filter {
            val isCalm = rates.indices.all { k -> rates[k][it] <= most[k] }
            used[it] && isCalm && isAtEnd?.get(it) != true && !fit.model.scales.isInDoubt(it)
        }
    }

    private companion object {
        const val FEWEST = 60

        /** Value and time. */
        const val QUANTITIES = 2

        /** Times as much, from which it is told. */
        const val CLEARLY = 1.5
    }
}
