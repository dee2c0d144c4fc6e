package stillwater.diagnose.evidence

import org.hipparchus.special.Erf
import stillwater.diagnose.Cause
import stillwater.diagnose.response.ModelFit
import stillwater.sensor.SensorStage
import kotlin.math.abs
import kotlin.math.pow
import kotlin.math.sqrt

/**
 * Stretches in which the readings stand still to the last digit: a sensor or a logger that hung, or gave one number in
 * the place of a reading, or a sensor at an end of its range.
 *
 * Noise of standard deviation s, rounded to steps of q, stays on the same step with a probability of erf(q / (√8 s)) a
 * row at most, where the water does not change at all. Not where the sensor is in a dead band, nor where a reading is
 * written many times throughout.
 */
internal class StillReadings(private val fit: ModelFit) {
    private val values = fit.model.series.shown(fit.model.series.values)
    private val residuals = fit.model.series.shown(fit.residuals)
    private val near = NEAR * sqrt(fit.variance)
    private val lowest = values.min()
    private val highest = values.max()

    private class Stretch(val value: Double, val rows: Int, val isAtEnd: Boolean)

    /** For how many rows each reading stands still. */
    private val runs: List<Int> = buildList {
        var from = 0
        for (i in 1..values.size) {
            if (i < values.size && values[i] == values[from]) continue
            add(i - from)
            from = i
        }
    }

    /**
     * The step of rounding as far as it tells of readings that repeat: the least from row to row, where there is any. A converter's
     * levels need not be as far apart as each other, nor as the last digit is.
     */
    private val step: Double = maxOf(
        fit.model.scales.resolution,
        (1 until values.size).map { abs(values[it] - values[it - 1]) }.filter { it > 0 }.minOrNull() ?: 0.0,
    )

    /** The stretches in the order of the log. */
    private val all: List<Stretch> = if (fit.model.terms.any { it.cause == Cause.HYSTERESIS }) emptyList() else found()

    /**
     * The probability that one row more shows the same: what noise makes of it at most, or as often as readings that did so
     * for two to four rows go on in this log. Its noise need not be normal: an instrument's own filter has it stand still.
     */
    private val staying: Double by lazy {
        val spread = Spikes.spread(fit.model.series.shown(fit.whitened))
        val short = runs.filter { it >= 2 }
        val before = (2 until FEWEST).sumOf { rows -> short.count { it >= rows } }
        val after = (2 until FEWEST).sumOf { rows -> short.count { it > rows } }
        val usual = if (short.size >= MANY) after.toDouble() / before else 0.0
        maxOf(Erf.erf(step / (sqrt(8.0) * spread)), usual)
    }

    /** By chance, that a stretch as long is somewhere in the log. */
    private fun pValue(stretch: Stretch) = minOf(values.size * staying.pow(stretch.rows - 1), 1.0)

    /** Stretches of the sensor or the logger that are no chance at [level]; none where most rows are in some. */
    private fun hung(level: Double): List<Stretch> {
        val sure = all.filter { !it.isAtEnd && pValue(it) < level }
        return sure.takeIf { sure.sumOf { it.rows } <= MOST * values.size }.orEmpty()
    }

    /** What is to be said; null where no stretch is more than chance at [level]. */
    fun words(level: Double): String? {
        val sure = hung(level).map { it.rows }
        if (sure.isEmpty()) return null
        val rows = if (sure.min() == sure.max()) "${sure.min()}" else "${sure.min()} to ${sure.max()}"
        val often = if (sure.size == 1) "once" else "${sure.size} times"
        return "the readings stand still to the last digit for $rows rows, $often: the sensor or the logger hung"
    }

    /**
     * That single readings repeat the one before to the last digit, more often than their noise does; null where they do not, or
     * where most do. Noise whose steps from row to row have the deviation s is within a step of rounding, q, with a
     * probability of erf(q / (√2 s)).
     */
    fun repeats(): String? {
        if (fit.model.terms.any { it.cause == Cause.HYSTERESIS }) return null
        var from = 0
        val count = runs.sumOf { rows ->
            val isInside = values[from] > lowest && values[from] < highest
            from += rows
            if (rows < FEWEST && isInside) rows - 1 else 0
        }
        if (count < FEWEST || count > MOST * values.size) return null
        val steps = Spikes.spread(DoubleArray(residuals.size - 1) { residuals[it + 1] - residuals[it] })
        val expected = values.size * Erf.erf(step / (sqrt(2.0) * steps))
        if (Evidence.poissonTail(count, expected) > CERTAIN) return null
        return "$count readings repeat the one before to the last digit, which noise does not: the logger may have " +
            "had no new one."
    }

    /**
     * By chance, that the readings stand as still as they do at the highest or the lowest of them, and nowhere else: a
     * sensor that hangs, or sticks, does so anywhere.
     */
    val atEnd: Double by lazy {
        val elsewhere = all.filter { !it.isAtEnd }.minOfOrNull(::pValue) ?: 1.0
        val there = all.filter { it.isAtEnd }.minOfOrNull(::pValue) ?: 1.0
        if (elsewhere < sqrt(sqrt(there)).coerceIn(CERTAIN, ELSEWHERE)) 1.0 else there
    }

    /** The range that the readings have where they stand still at an end of it, at [level]; null where they do not. */
    fun range(level: Double): SensorStage.Range? {
        if (atEnd >= level) return null
        val ends = all.filter { it.isAtEnd && pValue(it) < level }.map { it.value }
        val middle = (lowest + highest) / 2
        return SensorStage.Range(ends.filter { it < middle }.minOrNull(), ends.filter { it >= middle }.maxOrNull())
    }

    private fun found(): List<Stretch> {
        val stretches = ArrayList<Stretch>()
        var from = 0
        for (rows in runs) {
            // What a delayed sensor shows first has not changed yet.
            if (from > 0 && rows >= FEWEST) stretches += Stretch(values[from], rows, isAtEnd(from, from + rows))
            from += rows
        }
        // What a model without an end foretells may be too low beside a longer stretch at the same end, or two others.
        val ends = stretches.filter { it.isAtEnd }.groupBy { it.value }
        return stretches.map { one ->
            val like = ends[one.value].orEmpty()
            val isLike = like.size >= OTHERS || like.any { it.rows >= one.rows }
            if (isLike) Stretch(one.value, one.rows, true) else one
        }
    }

    /**
     * Whether rows [from] to before [to] show the highest or the lowest reading, but for noise on few of those beside, and
     * about what is foretold.
     */
    private fun isAtEnd(from: Int, to: Int): Boolean {
        val here = values[from]
        val off = (from until to).sumOf { residuals[it] } / (to - from)
        val same = values.count { it == here }
        val isHighest = here >= highest - near && values.count { it > here } < same
        val isLowest = here <= lowest + near && values.count { it < here } < same
        return (isHighest && off < near) || (isLowest && off > -near)
    }

    private companion object {
        /** Rows; fewer are no stretch. */
        const val FEWEST = 5

        /** Stretches at an end by which a longer one on the same reading is there, too: what hangs does so anywhere. */
        const val OTHERS = 2

        /** Readings that stand still for two rows or more by which it is told how often they go on. */
        const val MANY = 30

        /** Of all rows. */
        const val MOST = 0.3

        /** Standard deviations. */
        const val NEAR = 3.0

        /** The same where they do so at an end for far more certain: its logarithm is four times that. */
        const val CERTAIN = 1e-6

        /** The chance of readings that stand still elsewhere, below which an end of the range is not why they do. */
        const val ELSEWHERE = 0.01
    }
}
