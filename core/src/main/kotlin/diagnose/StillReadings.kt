package stillwater.diagnose

import org.hipparchus.special.Erf
import kotlin.math.pow
import kotlin.math.sqrt

/**
 * Stretches in which the readings stand still to the last digit: a sensor or a logger that hung, or gave one number in
 * the place of a reading.
 *
 * Noise of standard deviation s, rounded to steps of q, stays on the same step with a probability of erf(q / (√8 s)) a
 * row at most, where the water does not change at all. Not where the sensor is at an end of its range or in a dead band,
 * nor where a reading is written many times throughout.
 */
internal class StillReadings(private val fit: ModelFit) {
    private val values = fit.model.series.shown(fit.model.series.values)
    private val residuals = fit.model.series.shown(fit.residuals)

    /** Numbers of rows of the stretches, in the order of the log. */
    private val lengths: List<Int> = if (fit.model.terms.any { it.cause == Cause.HYSTERESIS }) emptyList() else found()

    /** What is to be said; null where no stretch is more than chance at [level]. */
    fun words(level: Double): String? {
        val spread = Spikes.spread(fit.model.series.shown(fit.whitened))
        val staying = Erf.erf(fit.model.scales.resolution / (sqrt(8.0) * spread))
        val sure = lengths.filter { values.size * staying.pow(it - 1) < level }
        if (sure.isEmpty() || sure.sum() > MOST * values.size) return null
        val rows = if (sure.min() == sure.max()) "${sure.min()}" else "${sure.min()} to ${sure.max()}"
        val often = if (sure.size == 1) "once" else "${sure.size} times"
        return "the readings stand still to the last digit for $rows rows, $often: the sensor or the logger hung"
    }

    private fun found(): List<Int> = buildList {
        var from = 0
        for (i in 1..values.size) {
            if (i < values.size && values[i] == values[from]) continue
            // What a delayed sensor shows first has not changed yet.
            if (from > 0 && i - from >= FEWEST && !isAtEnd(from, i)) add(i - from)
            from = i
        }
    }

    /** Whether rows [from] to before [to] show the highest or the lowest reading where that is about what is foretold. */
    private fun isAtEnd(from: Int, to: Int): Boolean {
        val off = (from until to).sumOf { residuals[it] } / (to - from)
        val isHighest = values.all { it <= values[from] }
        val isLowest = values.all { it >= values[from] }
        val near = NEAR * sqrt(fit.variance)
        return (isHighest && off < near) || (isLowest && off > -near)
    }

    private companion object {
        /** Rows; fewer are no stretch. */
        const val FEWEST = 5

        /** Of all rows. */
        const val MOST = 0.3

        /** Standard deviations. */
        const val NEAR = 3.0
    }
}
