package stillwater.diagnose.response

import stillwater.diagnose.Cause
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.algebra.Spline
import java.util.Locale

/**
 * The truth that a reference is late for by a few rows at most: fast sensors have a lag, too, and clocks differ. To the
 * readings a lag much shorter than a row is a shift, which what a truth held over each step is ahead by, a probe in front,
 * or a part of the sensor that answers at once make as well.
 */
internal object ReferenceLead {
    /**
     * The truth that went on smoothly while a sensor with a lag of [lag] s came to show the reference of [series]; each
     * stretch between steps that [isBroken] by itself.
     */
    fun course(series: MeasuredSeries, lag: Double, isBroken: BooleanArray?): DoubleArray {
        val reference = requireNotNull(series.reference) { "what a reference is late for needs one" }
        val times = series.times
        val curve = Spline(times, isBroken).also { it.fit(reference) }
        val reach = series.period / NEAR
        return DoubleArray(times.size) { i ->
            val before = maxOf(times[i] - reach, times[0])
            val after = minOf(times[i] + reach, times.last())
            val rise = curve.at(minOf(i, times.size - 2), after) - curve.at(maxOf(i - 1, 0), before)
            reference[i] + lag * rise / (after - before)
        }
    }

    /**
     * By how much a reference may be late and be an ordinary one, s: half a row, because a row may be stamped at the
     * beginning of what it is of, in the middle, or at the end, or a small part of the lag that [base] has.
     */
    fun ordinary(base: ModelFit): Double =
        maxOf(STAMPED_ROWS * base.model.series.period, PART_OF_LAG * base.numbers[ResponseModel.TIME_CONSTANT])

    /** The lag in rows for which [explained] is most, and that; null where it is the longest that is tried. */
    fun likeliest(explained: (Double) -> Double): Pair<Double, Double>? {
        val best = LAGS.map { it to explained(it) }.maxBy { it.second }
        return if (best.first == LAGS.last()) null else refined(best, factor = 2.0, worth = { it }, at = explained)
    }

    /** What is to be said of a reference that is late by [late] s. */
    fun words(late: Double): String =
        "the readings are ahead of the reference by %.2g s: its clock is behind, or it has a lag of its own"
            .format(Locale.ROOT, late)

    /** What a reference that is late looks like, or undoes the lead of a truth held over each step, which looks so, too. */
    val ALIKE: Set<Cause> =
        setOf(Cause.DEAD_TIME, Cause.SECOND_ORDER_RESPONSE, Cause.POSITION_OFFSET, Cause.TWO_PATH_RESPONSE)

    /** Of the lag: to so much it is found. */
    const val PRECISION = 0.05
    private const val STAMPED_ROWS = 0.5

    /** Of the sensor's lag: a reference that is late by as much makes the lag shorter by no more. */
    private const val PART_OF_LAG = 0.05

    /** Rows; those that are tried first. */
    private val LAGS = List(9) { (1 shl it) / 32.0 }

    /** Of a row: how near the two places are between which the reference's slope is taken. */
    private const val NEAR = 100
}
