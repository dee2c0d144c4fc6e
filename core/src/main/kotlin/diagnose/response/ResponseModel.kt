package stillwater.diagnose.response

import stillwater.diagnose.Cause
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.algebra.Spline
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.sqrt

/**
 * The reading that a sensor with the causes [terms] would give along a log whose truth is the log's reference.
 *
 * The parts act in this order: delay and offset of place, lag (with all that changes its time constant, or with a limit to
 * its rate), second lag or slow path, rate limit, dead band, gain and offset, cross-sensitivity, drift, jumps, ends of the range, rounding. The
 * truth is taken as a cubic spline through the rows, or as held over each step ([steps]); each lag is exact for
 * that, but one with a limit where that begins or ends to act within the step. Where rows are far apart for the water the
 * spline goes through the truth halfway between them as well ([Scales.finer]).
 *
 * @property series the log; its reference must be there. @property terms what acts beside the base. @property steps how
 *   the truth goes on between the rows. @property behind how far behind the fixes the place is that the truth is that
 *   of, m.
 */
internal class ResponseModel(
    val series: MeasuredSeries,
    val terms: List<Term>,
    val steps: Steps,
    val scales: Scales,
    val behind: Double = 0.0,
) {
    private val held = steps.isHeld
    private val n = series.size
    private val truth = requireNotNull(series.reference) { "a response model needs a reference" }
    private val layout = ParameterLayout(series, terms, scales)

    /** The numbers of this model: time constant, gain, offset, first state, then those of each term. */
    val parameters: List<Parameter> get() = layout.parameters

    private val causes = terms.map { it.cause }.toSet()

    /** Rows by which a second lag is ahead that is stepped by what the first one shows at the end of a row. */
    val secondLead: Double get() = if (steps == Steps.HELD && Cause.SECOND_ORDER_RESPONSE in causes) steps.lead else 0.0

    /** The same between the rows as well, and what it shows there; null where the truth is not told there. */
    private val finer =
        scales.finer?.takeIf { !held }?.let { ResponseModel(it.scales.series, terms, steps, it.scales, behind) }
    private val shownFiner by lazy { DoubleArray(checkNotNull(finer).n) }
    private val work = DoubleArray(n)
    private val second = DoubleArray(n)
    private val taus = DoubleArray(n)
    private val limit = terms.firstOrNull { it.cause == Cause.SLEW_LIMIT }

    /** Whether it is the lag's own rate that is limited; two paths have a limit behind them. */
    private val isWithin = limit?.isWithin == true && Cause.TWO_PATH_RESPONSE !in causes
    private val band = terms.firstOrNull { it.cause == Cause.HYSTERESIS }
    private val lags = LagSteps(series, scales.unknown?.isGap, steps)

    /**
     * Whether the first state goes through the response, instead of fading by itself: a probe that comes from far off settles
     * as it responds. Where the water is inferred it fades, because there it counts as one of the water's heights.
     */
    private val isFirstShaped = scales.unknown != null && causes.any { it.isShapingFirst }

    /** Which numbers change what comes before gain and offset. */
    private val isShaping = BooleanArray(parameters.size).also { shaping ->
        shaping[TIME_CONSTANT] = true
        shaping[FIRST] = isFirstShaped
        shaping[GAIN] = isFirstShaped || limit != null || Cause.HYSTERESIS in causes
        for (term in terms) if (term.cause.isTiming) slot(term).let { shaping.fill(true, it, it + width(term)) }
        for (term in terms) if (term.hasOwnStart) shaping[ownStart(term)] = term.cause == Cause.HYSTERESIS
    }

    /** The last two that were asked for, the later first: derivatives by all other numbers share one. */
    private var shape = Shape()
    private var shapeBefore = Shape()
    private var fadesOf = Double.NaN
    private val fades by lazy { DoubleArray(n) }
    private val spline = Spline(series.times, scales.unknown?.isBroken)
    private val truthSpline by lazy { Spline(series.times, scales.unknown?.isBroken) }
    private var isFitted = false
    private var isDelayed = false

    /** Index of the first parameter of [term]. */
    fun slot(term: Term): Int = layout.slots.getValue(term.key)

    /** Index of the first parameter of [term], or null where this model has no such term. */
    fun slotOrNull(term: Term): Int? = layout.slots[term.key]

    /** Number of parameters of [term]. */
    fun width(term: Term): Int = layout.widths.getValue(term.key)

    private fun slot(cause: Cause) = layout.slots.getValue(cause.label)

    /** Index of the first state of [term], which is its last number. */
    private fun ownStart(term: Term) = slot(term) + width(term) - 1

    /** Indices of the numbers that say where the sensor was before the log. */
    val firstStates: List<Int> = listOf(FIRST) + terms.filter { it.hasOwnStart }.map(::ownStart)

    /** Numbers for this model: those that [other] has, with the values [from]; the rest as they do nothing. */
    fun carried(other: ResponseModel, from: DoubleArray): DoubleArray {
        val numbers = DoubleArray(parameters.size) { i -> parameters[i].neutral.takeIf { it.isFinite() } ?: 0.0 }
        for (i in 0 until BASE) numbers[i] = from[i]
        for (term in other.terms) {
            val to = slotOrNull(term) ?: continue
            val start = other.slotOrNull(term) ?: continue
            for (k in 0 until minOf(other.width(term), width(term))) numbers[to + k] = from[start + k]
            // Beyond the slowest path nothing changes with the number, so that no step would lead back.
            if (term.cause == Cause.TWO_PATH_RESPONSE && other.slowRatio(from) < from[start]) {
                numbers[to] = WITHIN * other.slowRatio(from)
            }
        }
        return numbers
    }

    /** The truth between the rows. */
    private fun truthCurve(): Spline {
        if (!isFitted) truthSpline.fitForLags(truth)
        isFitted = true
        return truthSpline
    }

    /**
     * Writes the reading without noise for [p], in the order of [parameters], into [out], length n; before its rounding
     * unless [isRounded].
     */
    @Synchronized
    fun predict(p: DoubleArray, out: DoubleArray, isRounded: Boolean = true) {
        if (finer != null) {
            finer.predict(p, shownFiner, isRounded)
            scales.finer?.rows?.forEachIndexed { i, row -> out[i] = shownFiner[row] }
            return
        }
        if (!shape.isOf(p)) {
            shape = shapeBefore.also { shapeBefore = shape }
            if (!shape.isOf(p)) shape.become(p)
        }
        shape.shown.copyInto(out)
        calibrate(p, out)
        if (Cause.SATURATION in causes) out.clip(p[slot(Cause.SATURATION)], p[slot(Cause.SATURATION) + 1])
        if (isRounded && Cause.QUANTISATION in causes) out.round(scales.resolution, p[slot(Cause.QUANTISATION)])
    }

    /** The reading before gain and offset, for some numbers. */
    private inner class Shape {
        private val numbers = DoubleArray(parameters.size) { Double.NaN }

        /** Length n once it is asked for. */
        var shown = numbers.copyOf(0)
            private set

        fun isOf(p: DoubleArray) = p.indices.all { !isShaping[it] || p[it] == numbers[it] }

        fun become(p: DoubleArray) {
            if (shown.size < n) shown = DoubleArray(n)
            shape(p, shown)
            p.copyInto(numbers)
        }
    }

    private fun shape(p: DoubleArray, out: DoubleArray) {
        delay(p)
        if (band?.isFirst == true) play(band, p, work)
        timeConstants(p)
        val first = if (isFirstShaped && p[GAIN] != 0.0) p[FIRST] / p[GAIN] else 0.0
        val asymmetry = if (Cause.ASYMMETRIC_RESPONSE in causes) p[slot(Cause.ASYMMETRIC_RESPONSE)] else 0.0
        if (Cause.TWO_PATH_RESPONSE in causes) {
            val at = slot(Cause.TWO_PATH_RESPONSE)
            lag(work, second, slowRatio(p), 0.0, first)
            lag(work, out, 1.0, asymmetry, first)
            for (i in 0 until n) out[i] += p[at + 1] * (second[i] - out[i])
        } else {
            val most = if (limit != null && isWithin) p[slot(limit)] / abs(p[GAIN]) else Double.POSITIVE_INFINITY
            lag(work, out, 1.0, asymmetry, first, most)
        }
        if (Cause.SECOND_ORDER_RESPONSE in causes) {
            taus.fill(p[slot(Cause.SECOND_ORDER_RESPONSE)])
            lag(out, second, 1.0, 0.0, 0.0)
            second.copyInto(out)
        }
        if (limit != null && !isWithin) lags.slew(out, p[slot(limit)] / abs(p[GAIN]))
        if (band?.isFirst == false) play(band, p, out)
    }

    private fun play(band: Term, p: DoubleArray, shown: DoubleArray) =
        lags.play(shown, p[slot(band)] / abs(p[GAIN]), if (band.hasOwnStart) p[ownStart(band)] else 0.0)

    /**
     * The parts that are linear in the truth, for [p]: gain, offset, first state and all that is not linear left out.
     */
    @Synchronized
    fun linear(p: DoubleArray): LinearResponse {
        val deadTime = if (Cause.DEAD_TIME in causes) p[slot(Cause.DEAD_TIME)] else 0.0
        val distance = distance(p)
        val isLate = deadTime != 0.0 || distance != 0.0
        val delay = if (isLate) NeighbourSums(series.times, isBent = true) else null
        if (delay != null) late(deadTime, distance) { i, from, time -> delay.read(i, from, time) }
        timeConstants(p)
        val path = lagged(1.0)
        val slow = if (Cause.TWO_PATH_RESPONSE in causes) {
            val at = slot(Cause.TWO_PATH_RESPONSE)
            lagged(slowRatio(p)) to p[at + 1]
        } else {
            null
        }
        var second: NeighbourSums? = null
        if (Cause.SECOND_ORDER_RESPONSE in causes) {
            taus.fill(p[slot(Cause.SECOND_ORDER_RESPONSE)])
            second = lagged(1.0)
        }
        return LinearResponse(spline, delay, path, slow, second)
    }

    /** A lag of [factor] times the time constants. */
    private fun lagged(factor: Double) = NeighbourSums(series.times, isBent = !held).also { sums ->
        for (i in 0 until n) {
            when {
                i == 0 || lags.isGap(i) -> sums.same(i)
                held -> sums.hold(i, taus[i] * factor, lags.earlier[i])
                else -> sums.follow(i, taus[i] * factor)
            }
        }
    }

    /** By how much the slow path's time constant is longer than the first one for [p]: slower than that is a drift. */
    fun slowRatio(p: DoubleArray): Double =
        minOf(p[slot(Cause.TWO_PATH_RESPONSE)], maxOf(2.0, series.duration / SLOWEST / p[TIME_CONSTANT]))

    /** The truth at each row, as late as the model says, into [work]. */
    private fun delay(p: DoubleArray) {
        val deadTime = if (Cause.DEAD_TIME in causes) p[slot(Cause.DEAD_TIME)] else 0.0
        val distance = distance(p)
        isDelayed = deadTime != 0.0 || distance != 0.0
        if (!isDelayed) {
            truth.copyInto(work)
            return
        }
        val curve = truthCurve()
        late(deadTime, distance) { i, from, time -> work[i] = curve.at(from, time) }
    }

    /** How far the sensor is behind the place that the truth is that of, m. */
    private fun distance(p: DoubleArray) =
        (if (Cause.POSITION_OFFSET in causes) p[slot(Cause.POSITION_OFFSET)] else 0.0) - behind

    /** How long before the first row or after the last one the sensor at [p] sees what it has in each row, s; null for never. */
    fun beyond(p: DoubleArray): DoubleArray? {
        val deadTime = if (Cause.DEAD_TIME in causes) p[slot(Cause.DEAD_TIME)] else 0.0
        val distance = distance(p)
        if (deadTime == 0.0 && distance == 0.0) return null
        val times = series.times
        return DoubleArray(n).also { beyond ->
            late(deadTime, distance) { i, _, time -> beyond[i] = maxOf(times[0] - time, time - times[n - 1], 0.0) }
        }
    }

    /** Has [see] told for each row after which row and at what time the sensor has what it shows there. */
    private inline fun late(deadTime: Double, distance: Double, see: (Int, Int, Double) -> Unit) {
        val walk = if (distance != 0.0) scales.way.at(-distance) else null
        var from = 0
        for (i in 0 until n) {
            val time = (walk?.timeAt(i) ?: series.times[i]) - deadTime
            while (from < n - 2 && series.times[from + 1] < time) from++
            while (from > 0 && series.times[from] > time) from--
            see(i, from, time)
        }
    }

    /** The lag before each row with numbers [p], s, as speed and temperature change it; new. */
    fun lags(p: DoubleArray): DoubleArray {
        timeConstants(p)
        return taus.copyOf()
    }

    private fun timeConstants(p: DoubleArray) {
        val exponent = if (Cause.FLOW_DEPENDENT_RESPONSE in causes) p[slot(Cause.FLOW_DEPENDENT_RESPONSE)] else 0.0
        val change = if (Cause.TEMPERATURE_DEPENDENT_RESPONSE in causes) {
            p[slot(Cause.TEMPERATURE_DEPENDENT_RESPONSE)]
        } else {
            0.0
        }
        taus.fill(p[TIME_CONSTANT])
        if (exponent != 0.0) for (i in 0 until n) taus[i] *= exp(-exponent * scales.logSpeed[i])
        if (change != 0.0) for (i in 0 until n) taus[i] *= exp(-change * scales.warmth[i])
        // Water that goes on evenly is passed as fast, and as warm, as halfway between the rows.
        if (!held && (exponent != 0.0 || change != 0.0)) {
            for (i in n - 1 downTo 1) taus[i] = sqrt(taus[i - 1] * taus[i])
        }
    }

    /**
     * A lag of [factor] times the time constants; rising ones are exp([asymmetry]) times the falling ones. It begins [first]
     * above its input and changes by no more than [most], sensor units/s.
     */
    private fun lag(
        input: DoubleArray,
        out: DoubleArray,
        factor: Double,
        asymmetry: Double,
        first: Double,
        most: Double = Double.POSITIVE_INFINITY,
    ) {
        val isTruth = input === work && !isDelayed && band?.isFirst != true
        val curve = if (isTruth && !held) truthCurve() else spline
        if (!held && !isTruth) spline.fitForLags(input)
        if (asymmetry == 0.0 && most == Double.POSITIVE_INFINITY) {
            lags.even(input, curve, taus, factor, first, out)
        } else {
            val sides = LagSteps.Sides(factor * exp(asymmetry / 2), factor * exp(-asymmetry / 2))
            lags.uneven(input, curve, taus, sides, first, most, out)
        }
    }

    private fun calibrate(p: DoubleArray, out: DoubleArray) {
        val gain = p[GAIN]
        val offset = p[OFFSET]
        val first = if (isFirstShaped) 0.0 else p[FIRST]
        if (first == 0.0) {
            for (i in 0 until n) out[i] = offset + gain * out[i]
        } else {
            val fades = fades(p[TIME_CONSTANT])
            for (i in 0 until n) out[i] = offset + gain * out[i] + first * fades[i]
        }
        for (term in terms) {
            val at = layout.slots.getValue(term.key)
            when (term.cause) {
                Cause.CROSS_SENSITIVITY -> {
                    val column = (if (term.isQuiet) scales.quiet else scales.centred).getValue(term.condition.orEmpty())
                    for (i in 0 until n) out[i] += p[at] * column[i]
                }
                Cause.DRIFT -> for (i in 0 until n) out[i] += p[at] * (series.times[i] - series.times[0])
                Cause.OFFSET_STEPS -> term.times.forEachIndexed { k, time ->
                    for (i in 0 until n) if (series.times[i] - series.times[0] > time) out[i] += p[at + k]
                }
                else -> if (term.hasOwnStart && term.cause != Cause.HYSTERESIS) begun(out, term, p)
            }
        }
    }

    /**
     * Adds what the first state of the lag that [term] has beside the first one still shows: how differently the two fade,
     * over the difference of their rates, so that it is as well known where these are nearly alike.
     */
    private fun begun(out: DoubleArray, term: Term, p: DoubleArray) {
        val start = p[ownStart(term)]
        if (start == 0.0) return
        val tau = p[TIME_CONSTANT]
        val other = if (term.cause == Cause.TWO_PATH_RESPONSE) tau * slowRatio(p) else p[slot(term)]
        val apart = 1 / other - 1 / tau
        val fades = fades(tau)
        for (i in 0 until n) {
            val age = series.times[i] - series.times[0]
            val share = if (abs(age * apart) < ALIKE) age * fades[i] else (fades[i] - exp(-age / other)) / apart
            out[i] += start * share / tau
        }
    }

    /** What of the first state is left at each row, with a time constant of [tau] s. */
    private fun fades(tau: Double): DoubleArray {
        if (tau != fadesOf) {
            for (i in 0 until n) {
                val age = series.times[i] - series.times[0]
                fades[i] = if (age < FADED * tau) exp(-age / tau) else 0.0
            }
            fadesOf = tau
        }
        return fades
    }

    companion object {
        const val TIME_CONSTANT = 0
        const val GAIN = 1
        const val OFFSET = 2
        const val FIRST = 3
        const val BASE = 4

        /** An end of the range beyond this is none, sensor units. */
        const val NO_END = 1e9

        /** Where an end of the range is put that is none, sensor units. */
        const val FAR_END = 1e12

        /** Of what two fades differ by, below which the limit of equal ones is as exact. */
        private const val ALIKE = 1e-6

        /** Time constants after which nothing is left of the first state. */
        private const val FADED = 40.0
        private const val SLOWEST = 8

        /** Of the slowest path, where a fit begins that was beyond it. */
        private const val WITHIN = 0.9
    }
}
