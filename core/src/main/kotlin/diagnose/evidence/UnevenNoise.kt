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
 * Noise that is larger at some values, grows as time goes on, or is much larger for a while, in what a model leaves of a log.
 *
 * Asked by the rank correlation (Spearman's) of how far whitened residuals are off 0 with the value and with the time, and
 * by their mean ranks in stretches of the log (Kruskal and Wallis's): single wild readings and heavy tails weigh no more
 * than others. Where the truth moves fast, what is not known of it between the rows makes residuals larger: the fastest
 * rows do not count, and of all others what goes with how fast it moves is taken off both.
 *
 * @param isInferred whether the truth is a water that was inferred: what its waves lack is larger in some places. The same
 * must then show in how far readings are off a parabola through those beside them, which no water makes.
 */
internal class UnevenNoise(private val fit: ModelFit, private val isInferred: Boolean = false) {
    private val series = fit.model.series
    private val rates = listOf(checkNotNull(series.reference), fit.predicted).map { column ->
        DoubleArray(column.size) { abs(series.rise(column, it, it)) }
    }
    private val rows = calmRows()
    private val sizes = listOfNotNull(
        DoubleArray(rows.size) { abs(fit.whitened[rows[it]]) },
        if (isInferred) DoubleArray(rows.size) { abs(Neighbours.off(series.values, rows[it])) } else null,
    )

    /** A constant, and what goes with how fast the truth moves and with how fast what is shown of it does, straight or curved. */
    private val moving by lazy {
        val ranks = rates.map { rate -> Ranks.of(DoubleArray(rows.size) { rate[rows[it]] }) }
        val curved = ranks.map { rank -> DoubleArray(rank.size) { rank[it] * rank[it] } }
        Evidence.orthonormal(listOf(DoubleArray(rows.size) { 1.0 }) + ranks + curved)
    }

    /** Ranks of [sizes], without what goes with how fast the truth moves. */
    private val ranks by lazy { Evidence.without(sizes.map(Ranks::of), moving) }

    /**
     * In words, what the noise goes with for certain at this [level], of all that is asked together; null where it is as large
     * everywhere or not much larger anywhere, and of readings in steps as large as their noise.
     */
    fun words(level: Double): String? {
        val isCoarse = fit.model.scales.resolution > sqrt(fit.variance)
        if (rows.size < FEWEST || isCoarse) return null
        val high = Quantity("value", fit.predicted, "where it is high", "where it is low")
        val late = Quantity("time", series.times, "late in the log", "early")
        val told = listOf(high, late).filter { it.chance * ASKED < level && it.isMuch }
        val most = told.maxByOrNull { it.ratio }
        if (most != null) {
            val times = "%.1f".format(Locale.ROOT, most.times)
            return "the noise goes with the ${most.name}: readings scatter $times times as much ${most.where}"
        }
        return Stretch().takeIf { it.chance * ASKED < level && it.times >= MUCH }?.words()
    }

    private fun scatter(sizes: DoubleArray, some: List<Int>) = median(DoubleArray(some.size) { sizes[some[it]] })

    /** What the noise may go with, and how much. */
    private inner class Quantity(val name: String, column: DoubleArray, high: String, low: String) {
        private val own = DoubleArray(rows.size) { column[rows[it]] }
        private val order = own.indices.sortedBy { own[it] }
        private val highest = order.takeLast(rows.size / 3)
        private val lowest = order.take(rows.size / 3)
        private val larger = sizes.map { scatter(it, highest) / scatter(it, lowest) }
        private val isLarger = larger[0] > 1

        /** How many times as large the noise is in the third of the rows with the highest values as in the lowest, or the other way. */
        val times = larger.minOf { if (isLarger) it else 1 / it }
        val isMuch = times >= CLEARLY && times.isFinite()
        val where = if (isLarger) "$high as $low" else "$low as $high"

        /** The rows times the square of the rank correlation: χ² of one degree of freedom if there is none. */
        val ratio: Double = Evidence.without(Ranks.of(own), moving).let { own ->
            ranks.minOf { sizes ->
                dot(own, sizes).let { it * it } / (squares(own) * squares(sizes)) * (rows.size - moving.size)
            }
        }

        /** How likely so much of it is if there is none. */
        val chance: Double get() = Evidence.pValue(ratio, 1)
    }

    /** The stretch of the log in which the noise is largest over what it is elsewhere. */
    private inner class Stretch {
        private val size = maxOf(rows.size / STRETCHES, FEWEST_IN_STRETCH)
        private val count = rows.size / size

        /** Where each begins. */
        private val starts = IntArray(count + 1) { it * rows.size / count }

        /** χ² of one degree of freedom less than there are stretches if the noise is even. */
        val ratio: Double = ranks.minOf { rank ->
            (0 until count).sumOf { part ->
                val sum = (starts[part] until starts[part + 1]).sumOf { rank[it] }
                sum * sum / (starts[part + 1] - starts[part])
            } / (squares(rank) / (rows.size - moving.size))
        }

        /** How likely so much of it is if the noise is even. */
        val chance: Double get() = Evidence.pValue(ratio, count - 1)

        private val factors = (0 until count).map { part ->
            val own = (starts[part] until starts[part + 1]).toList()
            sizes.minOf { scatter(it, own) / scatter(it, it.indices.toList()) }
        }

        /** How many times as much readings scatter there as in all of the log. */
        val times = factors.max()

        fun words(): String {
            val part = factors.indexOf(times)
            val from = series.times[rows[starts[part]]]
            val to = series.times[rows[starts[part + 1] - 1]]
            return "the noise comes and goes: readings scatter %.1f times as much from %.0f to %.0f s as usual"
                .format(Locale.ROOT, times, from, to)
        }
    }

    /** Rows in use but for the quarters in which the truth, and what the sensor shows of it, move fastest. */
    private fun calmRows(): List<Int> {
        val most = rates.map { it.sortedArray()[it.size * 3 / 4] }
        // At an end of the range readings are as even as that is.
        val isAtEnd = RangeEnd.beyond(fit.model, fit.numbers)
        val used = fit.noise.used
        val inside = if (isInferred) Neighbours.REACH until used.size - Neighbours.REACH else used.indices
        return inside.filter {
            val isCalm = rates.indices.all { k -> rates[k][it] <= most[k] }
            used[it] && isCalm && isAtEnd?.get(it) != true && !fit.model.scales.isInDoubt(it)
        }
    }

    private companion object {
        const val FEWEST = 60

        /** Value, time and stretches. */
        const val ASKED = 3

        /** Times as much, from which it is told; and of a stretch, which is the one of many that is most. */
        const val CLEARLY = 1.5
        const val MUCH = 2.0
        const val STRETCHES = 24
        const val FEWEST_IN_STRETCH = 20
    }
}
