package stillwater.estimate

import kotlin.math.abs
import kotlin.math.pow

/**
 * What one sensor said along a track, whole, for estimators that look back as well as ahead.
 *
 * @property times s, strictly growing, length n. Retained, not modified.
 * @property xs metres east, length n; or the only coordinate of a transect, in any unit. Retained, not modified.
 * @property ys metres north, length n. Retained, not modified.
 * @property values readings, sensor units, length n. Retained, not modified.
 * @property speeds the boat's speed at each reading over [referenceSpeed], dimensionless, NaN where unknown, length n;
 * null where it is not known at all. Retained, not modified.
 * @property referenceSpeed m/s, above 0; NaN without [speeds].
 * @throws IllegalArgumentException if the lengths differ, a number is not finite, or times do not grow.
 */
public class TrackSeries private constructor(
    public val times: DoubleArray,
    public val xs: DoubleArray,
    public val ys: DoubleArray,
    public val values: DoubleArray,
    public val speeds: DoubleArray?,
    public val referenceSpeed: Double,
    private val gaps: BooleanArray?,
) {
    /** Readings of a boat of which no speed is known. */
    public constructor(times: DoubleArray, xs: DoubleArray, ys: DoubleArray, values: DoubleArray) :
        this(times, xs, ys, values, null, Double.NaN, null)

    init {
        val lengths = listOf(times.size, xs.size, ys.size, values.size)
        require(lengths.distinct().size == 1) { "times, xs, ys and values ($lengths) must be of one length" }
        for (i in times.indices) {
            require(times[i].isFinite() && xs[i].isFinite() && ys[i].isFinite() && values[i].isFinite()) {
                "row $i (${times[i]} s, ${xs[i]}, ${ys[i]}, ${values[i]}) must be finite"
            }
            require(i == 0 || times[i] > times[i - 1]) {
                "times must grow, but row $i (${times[i]} s) follows ${times[i - 1]} s"
            }
        }
    }

    /** Number of readings. */
    public val size: Int get() = times.size

    /** Median time between readings, s; NaN for fewer than two. */
    public val medianStep: Double by lazy {
        val steps = DoubleArray(maxOf(0, size - 1)) { times[it + 1] - times[it] }.apply { sort() }
        if (steps.isEmpty()) Double.NaN else steps[steps.size / 2]
    }

    /** Whether nine in ten readings come whole median steps after the one before, to a twentieth of one. */
    internal val isEven: Boolean by lazy {
        val off = (1 until size).count { i ->
            val steps = (times[i] - times[i - 1]) / medianStep
            abs(steps - Math.rint(steps)) > OFF_STEP
        }
        off * UNEVEN < size
    }

    /** Silences longer than this end a stretch, s: five median steps. */
    public val gapLimit: Double get() = GAP_STEPS * medianStep

    /** Whether a silence lies between reading [i] and the one before, so that they are in two stretches; of the first not. */
    public fun isAfterGap(i: Int): Boolean = i > 0 && (gaps?.get(i) ?: (times[i] - times[i - 1] > gapLimit))

    /** The same with the boat's speed, m/s, NaN where unknown, one a reading, about [reference], m/s, above 0. */
    public fun withSpeeds(metresPerSecond: DoubleArray, reference: Double): TrackSeries {
        require(metresPerSecond.size == size) { "speeds (${metresPerSecond.size}) must be as many as readings ($size)" }
        require(reference > 0 && reference.isFinite()) { "reference ($reference m/s) must be above 0 and finite" }
        val speeds = DoubleArray(size) { metresPerSecond[it] / reference }
        return TrackSeries(times, xs, ys, values, speeds, reference, gaps)
    }

    /** Whether speeds are known, and differ by enough that a lag that follows them would be seen. */
    internal val hasSpeeds: Boolean by lazy {
        val known = speeds?.filter { it.isFinite() }?.sorted().orEmpty()
        fun quantile(share: Double) = known[(share * (known.size - 1)).toInt()]
        known.isNotEmpty() && quantile(1 - TAIL) > LEAST_RANGE * maxOf(quantile(TAIL), SLOWEST)
    }

    /** Those of [rows], in growing order. */
    public fun at(rows: List<Int>): TrackSeries {
        fun of(values: DoubleArray) = DoubleArray(rows.size) { values[rows[it]] }
        return TrackSeries(of(times), of(xs), of(ys), of(values), speeds?.let(::of), referenceSpeed, null)
    }

    /** The same track with other readings, [values]. */
    public fun withValues(values: DoubleArray): TrackSeries =
        TrackSeries(times, xs, ys, values, speeds, referenceSpeed, gaps)

    /** The same readings by another clock, [times]; the gaps stay where they are. */
    public fun retimed(times: DoubleArray): TrackSeries =
        TrackSeries(times, xs, ys, values, speeds, referenceSpeed, BooleanArray(size, ::isAfterGap))

    /** The same readings where stretches end before the rows that [isGap] alone, length n. Not modified. */
    internal fun withGaps(isGap: BooleanArray): TrackSeries =
        TrackSeries(times, xs, ys, values, speeds, referenceSpeed, isGap.copyOf())

    /**
     * How much faster than at the reference speed a lag goes on that follows the flow: (v / v₀)^p at reading [i], with
     * p the [exponent]. As in [stillwater.sensor.TimeConstant.ofFlow], speeds are taken within v₀ / 100 to 100 v₀, an
     * unknown one as v₀.
     */
    internal fun pace(i: Int, exponent: Double): Double {
        val ratio = speeds?.get(i) ?: 1.0
        return if (ratio.isNaN()) 1.0 else ratio.coerceIn(SLOWEST, FASTEST).pow(exponent)
    }

    /** These readings in the time in which the lag of [response] is constant. */
    internal fun inTimeOf(response: Response): TrackSeries {
        if (response.flowExponent == 0.0) return this
        val paced = times.copyOf()
        for (i in 1 until size) paced[i] = paced[i - 1] + (times[i] - times[i - 1]) * pace(i, response.flowExponent)
        return retimed(paced)
    }

    /**
     * The same readings where the boat was when they were taken, if its receiver repeats a fix until it has a new one:
     * positions that repeat the one before are put on the straight way between the first rows of successive fixes. Left
     * as they are, they would be late and hide part of a sensor's delay.
     */
    public fun withFreshPositions(): TrackSeries {
        val freshXs = xs.copyOf()
        val freshYs = ys.copyOf()
        var fix = 0
        for (i in 1 until size) {
            if (xs[i] == xs[fix] && ys[i] == ys[fix]) continue
            // Over a gap the boat may have stood; how long nobody knows.
            val isNear = !isAfterGap(i)
            for (row in fix + 1 until i) {
                if (!isNear) break
                val share = (times[row] - times[fix]) / (times[i] - times[fix])
                freshXs[row] = xs[fix] + share * (xs[i] - xs[fix])
                freshYs[row] = ys[fix] + share * (ys[i] - ys[fix])
            }
            fix = i
        }
        return TrackSeries(times, freshXs, freshYs, values, speeds, referenceSpeed, gaps)
    }

    private companion object {
        /** Of a median step: a reading that comes so far off a whole number of them is not even; one in so many may be. */
        const val OFF_STEP = 0.05
        const val UNEVEN = 10
        const val GAP_STEPS = 5.0
        const val TAIL = 0.1
        const val LEAST_RANGE = 1.2
        const val SLOWEST = 0.01
        const val FASTEST = 100.0
    }
}
