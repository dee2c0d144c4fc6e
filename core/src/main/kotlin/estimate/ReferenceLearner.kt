package stillwater.estimate

import stillwater.sensor.SensorStage
import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * Learns a sensor's response from a reference along the same track: a fast sensor, or the known truth.
 *
 * z = gain · response(reference) + offset + e, with e correlated from reading to reading (first order, its correlation
 * learned with the rest); gain and offset are in every model, because without them anything else looks significant.
 * Where the log begins, and after gaps, the sensor may be anywhere, and comes from there as it responds: a probe that is
 * moved between samples while nothing is written shows its lag only so. See core/docs/TrackCorrection.md, (8). Confined
 * to one thread.
 *
 * A reading is the sensor's state at its time, and the reference runs straight from row to row. In a log made by
 * stepping a sensor once a row it is held over each step instead, which is half a step sooner: [isHeld] finds that, and
 * then [held] is the way to learn with.
 *
 * @param held whether the reference is held at each row's value over the step before it.
 * @param series the readings. Retained. @param reference the truth at each reading, sensor units of its own, length n.
 *   Retained, not modified.
 * @param unusable readings that say nothing of the sensor's state, which goes on through them as the reference has it.
 */
public class ReferenceLearner(
    private val series: TrackSeries,
    private val reference: DoubleArray,
    private val held: Boolean = false,
    private val unusable: UnusableReadings = UnusableReadings.none(series.size),
) : ResponseLearner {
    init {
        require(unusable.wild.size == series.size) {
            "unusable (${unusable.wild.size}) must be as long as series (${series.size})"
        }
        require(reference.size == series.size) {
            "reference (${reference.size}) must be as long as series (${series.size})"
        }
        require(reference.all { it.isFinite() }) { "reference must be finite" }
    }

    override val groups: Int = (series.size / GROUP).coerceIn(minOf(MOST_GROUPS / 2, series.size / ROWS), MOST_GROUPS)
    private val groupOf = IntArray(series.size) { (it.toLong() * groups / series.size).toInt() }
    private val usable = BooleanArray(series.size) { unusable.isUsable(it) }
    private val starts = StretchStarts(series, usable)

    /** Readings that count. */
    internal val count: Int = starts.counts.count { it }
    private val shown = DoubleArray(series.size)
    private val rest = Array(3) { DoubleArray(series.size) }
    private val level = mean(series.values)
    private val residuals = DoubleArray(series.size)
    private val lag = LagWeights()
    private val duration = series.times.last() - series.times.first()

    /** Gain of what was scored last. */
    private var scoredGain = 1.0

    /** Whether readings rise with the reference for certain: a first-order lag has them do so, and leaves less than half of them. */
    private val isRising: Boolean by lazy {
        val (gain, offset) = calibration(ResponseKind.FIRST_ORDER.response(likeliestLag()))
        leave(gain, offset)
        val all = series.values.indices.filter { starts.counts[it] }
        gain > 0 && all.sumOf { residuals[it] * residuals[it] } <
            all.sumOf { (series.values[it] - level) * (series.values[it] - level) } / 2
    }

    /** Gain and offset that go with [response]: z ≈ gain · response(reference) + offset. */
    public fun calibration(response: Response): Pair<Double, Double> {
        respond(response)
        return fitted(response)
    }

    /** What [response] leaves of the readings, sensor units, length n; 0 of those that do not count. */
    internal fun residuals(response: Response): DoubleArray {
        val (gain, offset) = calibration(response)
        leave(gain, offset)
        return residuals.copyOf()
    }

    /** Noise of the readings that wanders, sensor units, where the sensor is [response]; null where none shows. */
    public fun wander(response: Response): SensorStage.Wander? {
        val left = residuals(response)
        val rows = left.indices.filter { starts.counts[it] }
        return WanderingNoise(
            DoubleArray(rows.size) { series.times[rows[it]] },
            DoubleArray(rows.size) { left[rows[it]] },
        ).stage()
    }

    /**
     * Time constants of a first-order lag that the readings do not speak against, s: 0 where no lag is among them, and
     * infinite where none is too long. By six units of twice the log-likelihood, as [isHeld], which for 30 readings is
     * still rarer than one in twenty.
     */
    public fun lagRange(): ClosedFloatingPointRange<Double> {
        val times = lagsTried()
        val none = total(ResponseKind.NONE, doubleArrayOf())
        val each = times.map { total(ResponseKind.FIRST_ORDER, doubleArrayOf(ln(it))) }
        val least = maxOf(none, each.max()) - CLEARLY / 2
        val likely = times.indices.filter { each[it] >= least }
        val longest = likely.lastOrNull()?.let { if (it == times.lastIndex) Double.POSITIVE_INFINITY else times[it] }
        return (if (none >= least) 0.0 else times[likely.first()])..(longest ?: 0.0)
    }

    /**
     * How far the reference bends between its rows, as a share of what the best first-order lag leaves of the readings:
     * a quarter of the root mean square of what a row differs by from the line through the rows beside it.
     * Dimensionless.
     */
    public fun roughness(): Double {
        var bend = 0.0
        var bends = 0
        for (i in 1 until series.size - 1) {
            val span = series.times[i + 1] - series.times[i - 1]
            if (span > 2 * series.gapLimit) continue
            val share = (series.times[i] - series.times[i - 1]) / span
            val line = reference[i - 1] + share * (reference[i + 1] - reference[i - 1])
            bend += (reference[i] - line) * (reference[i] - line)
            bends++
        }
        val (gain, offset) = calibration(ResponseKind.FIRST_ORDER.response(likeliestLag()))
        leave(gain, offset)
        val left = sqrt(residuals.sumOf { it * it } / maxOf(1, count))
        val bent = kotlin.math.abs(gain) * sqrt(bend / maxOf(1, bends)) / FROM_DOUBLE
        return if (left > 0) bent / left else Double.POSITIVE_INFINITY
    }

    /** Time constant of the likeliest first-order lag, s, to half an octave. */
    private fun likeliestLag(): Double = lagsTried().maxBy { total(ResponseKind.FIRST_ORDER, doubleArrayOf(ln(it))) }

    /** Time constants tried, s, half an octave apart. */
    private fun lagsTried() = List(RANGE_TIMES) { series.medianStep * DELAY_FROM * Math.pow(2.0, it / 2.0) }

    override fun candidate(kind: ResponseKind): CandidateResponse? {
        if (count < FEWEST || (kind == ResponseKind.FLOW && !series.hasSpeeds)) return null
        // How the sensor follows a fall does not show in a log that only rises.
        if (kind == ResponseKind.ASYMMETRIC && !goesBothWays()) return null
        val fit = ResponseFit(kind, groupOf, groups, { plausible(kind, it) }, { scores(kind, it) }, isSharp = true)
        if (kind == ResponseKind.SLEW) {
            val slopes = (0 until series.size - 1).filter { usable[it] && usable[it + 1] }.map {
                kotlin.math.abs(series.values[it + 1] - series.values[it]) / (series.times[it + 1] - series.times[it])
            }.sorted()
            if (slopes.isEmpty()) return null
            val top = slopes[(slopes.size * TOP).toInt()]
            if (!(top > 0)) return null
            // The rate is in the reference's units, the slopes in the readings'; spreads say how the two compare.
            val starts = listOf(top, top / scale()).filter { it > 0 && it.isFinite() }
            return upright(fit.near(doubleArrayOf(starts.map { ln(it) }.maxBy { total(kind, doubleArrayOf(it)) })))
        }
        // From each, for the likeliest single lag may be far from a sensor that is another one.
        return upright(fit.best(List(DELAYS) { series.medianStep * DELAY_FROM * Math.pow(2.0, it.toDouble()) }))
    }

    private fun goesBothWays(): Boolean {
        val seen = reference.filterIndexed { i, _ -> usable[i] }.toDoubleArray()
        return seen.isNotEmpty() && Turns.of(seen) > 0
    }

    /** [found] unless its readings fall with the reference where they rise with it, or its two lags have changed places. */
    private fun upright(found: CandidateResponse): CandidateResponse? {
        total(found.kind, DoubleArray(found.parameters.size) { ln(found.parameters[it]) })
        return found.takeUnless { isTurned || it.response.isCrossed }
    }

    /**
     * [total] less what keeps a search off what no sensor is or no log shows: a lag longer than the log, whatever state that
     * began in, two lags that have changed places, readings that are turned.
     */
    private fun plausible(kind: ResponseKind, logs: DoubleArray): Double {
        val sum = total(kind, logs)
        if (sum == Double.NEGATIVE_INFINITY) return sum
        val turned = if (isTurned) TURNED else 0.0
        val response = kind.response(*DoubleArray(logs.size) { exp(logs[it]) })
        val longer = response.lags.sumOf { beyond(maxOf(it.rising, it.falling), duration) }
        val crossed = if (response.isCrossed) beyond(response.lags[0].rising, response.lags[1].rising) else 0.0
        return sum - turned - OFF * (longer + crossed)
    }

    /** Square of the logarithm by which [time] is beyond [most]. */
    private fun beyond(time: Double, most: Double): Double = ln(maxOf(time, most) / most).let { it * it }

    /** Whether of two paths the slow one is the faster, or of two lags the longer one the shorter. */
    private val Response.isCrossed: Boolean get() = lags.size == 2 && lags[1].rising < lags[0].rising

    /**
     * Whether what was scored last has readings fall with the reference although they rise with it: a longer lag that began
     * beyond them all may look like those.
     */
    private val isTurned: Boolean get() = scoredGain < 0 && isRising

    /** Spread of the readings over that of the reference. */
    private fun scale(): Double {
        fun spread(numbers: DoubleArray): Double {
            val seen = numbers.filterIndexed { i, _ -> usable[i] }
            val mean = seen.average()
            return sqrt(seen.sumOf { (it - mean) * (it - mean) })
        }
        return spread(series.values) / spread(reference)
    }

    private fun total(kind: ResponseKind, logs: DoubleArray): Double {
        if (logs.any { kotlin.math.abs(it) > MOST_LOG }) return Double.NEGATIVE_INFINITY
        return scores(kind, logs).sum()
    }

    /** One score a reading: the log density of what it surprises by after the reading before. */
    private fun scores(kind: ResponseKind, logs: DoubleArray): DoubleArray {
        val response = kind.response(*DoubleArray(logs.size) { exp(logs[it]) })
        respond(response)
        val (gain, offset) = fitted(response)
        leave(gain, offset)
        scoredGain = gain
        var own = 0.0
        var next = 0.0
        for (i in residuals.indices) {
            own += residuals[i] * residuals[i]
            if (i > 0) next += residuals[i] * residuals[i - 1]
        }
        val correlation = if (own > 0) (next / own).coerceIn(0.0, MOST_CORRELATION) else 0.0
        var sum = 0.0
        for (i in residuals.indices) if (starts.counts[i]) sum += surprise(i, correlation).let { it * it }
        val variance = maxOf(sum / maxOf(1, count), LEAST)
        return DoubleArray(residuals.size) { i ->
            if (starts.counts[i]) -(ln(variance) + surprise(i, correlation).let { it * it } / variance) / 2 else 0.0
        }
    }

    /** What the response leaves of the readings, into [residuals]: nothing of those that do not count. */
    private fun leave(gain: Double, offset: Double) {
        leaveAll(gain, offset)
        starts.takeOff(residuals)
        for (i in residuals.indices) if (!usable[i]) residuals[i] = 0.0
    }

    /** The same with what is left of where stretches begin. */
    private fun leaveAll(gain: Double, offset: Double) {
        for (i in residuals.indices) residuals[i] = series.values[i] - offset - gain * shown[i]
    }

    /** Of a reading that the one before foretells; after none, and after one that does not count, it is of its own. */
    private fun surprise(i: Int, correlation: Double) = when {
        !usable[i] -> 0.0
        i == 0 || !usable[i - 1] -> residuals[i] * sqrt(1 - correlation * correlation)
        else -> residuals[i] - correlation * residuals[i - 1]
    }

    /** Gain and offset of what [response] shows, with stretches that begin anywhere. */
    private fun fitted(response: Response): Pair<Double, Double> {
        starts.displace()
        chain(response, starts.fading, isHeld = true)
        val fit = fit()
        if (response.lags.all { it.rising == it.falling } || fit.first == 0.0) return fit
        leaveAll(fit.first, fit.second)
        for (i in residuals.indices) residuals[i] /= fit.first
        starts.displace(residuals)
        chain(response, starts.fading, isHeld = true)
        return fit()
    }

    private fun fit(): Pair<Double, Double> {
        val (x, one, z) = rest
        val middle = mean(shown)
        for (i in shown.indices) {
            x[i] = shown[i] - middle
            one[i] = 1.0
            z[i] = series.values[i] - level
        }
        starts.takeOff(*rest)
        // Readings that are all of where stretches begin say nothing of the offset.
        val own = product(one, one)
        val isTold = own > count * NO_OFFSET
        val shareOfX = if (isTold) product(x, one) / own else 0.0
        val shareOfZ = if (isTold) product(z, one) / own else 0.0
        val sxx = product(x, x) - shareOfX * shareOfX * own
        val sxz = product(x, z) - shareOfX * shareOfZ * own
        val gain = if (sxx > 0) sxz / sxx else 1.0
        return gain to level + shareOfZ - gain * (middle + shareOfX)
    }

    private fun mean(column: DoubleArray): Double {
        var sum = 0.0
        var seen = 0
        for (i in column.indices) {
            if (!usable[i]) continue
            sum += column[i]
            seen++
        }
        return sum / maxOf(1, seen)
    }

    private fun product(one: DoubleArray, other: DoubleArray): Double {
        var sum = 0.0
        for (i in one.indices) if (usable[i]) sum += one[i] * other[i]
        return sum
    }

    /** What a sensor with [response] shows of the reference, into [shown]; settled at each gap. */
    private fun respond(response: Response) {
        delay(response.deadTime)
        chain(response, shown, held)
        if (response.slewRate.isInfinite()) return
        for (i in 1 until shown.size) {
            if (series.isAfterGap(i)) continue
            val dt = series.times[i] - series.times[i - 1]
            val most = response.slewRate * dt
            shown[i] = shown[i].coerceIn(shown[i - 1] - most, shown[i - 1] + most)
        }
    }

    /** What the lags of [response] make of [inputs], in their place, modified; held over each step where that [isHeld]. */
    private fun chain(response: Response, inputs: DoubleArray, isHeld: Boolean) {
        if (response.slowShare > 0) {
            val fast = inputs.copyOf().also { follow(response.lags[0], it, isHeld) }
            follow(response.lags[1], inputs, isHeld)
            for (i in inputs.indices) inputs[i] = (1 - response.slowShare) * fast[i] + response.slowShare * inputs[i]
        } else {
            for (stage in response.lags) follow(stage, inputs, isHeld, response.flowExponent)
        }
    }

    /** What a lag of [stage], changed by the speed with [exponent], makes of [inputs], in their place. Modified. */
    private fun follow(stage: ResponseLag, inputs: DoubleArray, isHeld: Boolean, exponent: Double = 0.0) {
        var before = inputs[0]
        for (i in 1 until inputs.size) {
            val dt = series.times[i] - series.times[i - 1]
            val input = inputs[i]
            if (series.isAfterGap(i)) {
                before = input
                continue
            }
            val pace = if (exponent > 0) series.pace(i, exponent) else 1.0
            lag.set(if (input > inputs[i - 1]) stage.rising else stage.falling, dt * pace)
            if (isHeld) before = input
            inputs[i] = lag.keep * inputs[i - 1] + lag.before * before + lag.now * input
            before = input
        }
    }

    private fun delay(deadTime: Double) {
        var left = 0
        for (i in shown.indices) {
            val time = series.times[i] - deadTime
            while (left < i && series.times[left + 1] <= time) left++
            val span = if (left < i) series.times[left + 1] - series.times[left] else 0.0
            val share = if (span > 0) ((time - series.times[left]) / span).coerceIn(0.0, 1.0) else 0.0
            shown[i] = reference[left] + if (share > 0) share * (reference[left + 1] - reference[left]) else 0.0
        }
    }

    /** Twice the log-likelihood by which a first-order lag explains the readings at its best time constant. */
    private fun firstOrder(): Double {
        val delays = List(DELAYS) { ln(series.medianStep * DELAY_FROM * Math.pow(2.0, it.toDouble())) }
        fun likelihood(logs: DoubleArray) = total(ResponseKind.FIRST_ORDER, logs)
        val start = delays.maxBy { likelihood(doubleArrayOf(it)) }
        return 2 *
            likelihood(Search.simplex(doubleArrayOf(start), doubleArrayOf(0.3), EVALUATIONS, CLOSE, ::likelihood))
    }

    public companion object {
        /**
         * Whether readings of an even [series], as of a simulation, show the [reference] held over each step, clearly: by six
         * units of twice the log-likelihood of a first-order lag. A real sensor may look so where its reference is late.
         */
        public fun isHeld(
            series: TrackSeries,
            reference: DoubleArray,
            unusable: UnusableReadings = UnusableReadings.none(series.size),
        ): Boolean = series.isEven && ReferenceLearner(series, reference, held = true, unusable).firstOrder() >
            ReferenceLearner(series, reference, held = false, unusable).firstOrder() + CLEARLY

        /** A lag whose [lagRange] is as wide as such a factor is not known. */
        public const val MOST_FACTOR: Int = 10

        private const val CLEARLY = 6.0
        private const val EVALUATIONS = 60
        private const val CLOSE = 1e-4
        private const val FEWEST = 30
        private const val GROUP = 60
        private const val ROWS = 5
        private const val MOST_GROUPS = 20
        private const val TOP = 0.99
        private const val DELAYS = 14
        private const val DELAY_FROM = 0.125
        private const val RANGE_TIMES = 28

        /** A line through rows twice as far apart misses four times as much. */
        private const val FROM_DOUBLE = 4.0
        private const val MOST_LOG = 25.0

        /** Log-likelihoods that keep a search off readings that fall with the reference, and off numbers beyond their ends. */
        private const val TURNED = 1e6
        private const val OFF = 1000.0

        /** Of one a reading: with less left beside where stretches begin, none is told from the offset. */
        private const val NO_OFFSET = 1e-9
        private const val MOST_CORRELATION = 0.999
        private const val LEAST = 1e-300
    }
}
