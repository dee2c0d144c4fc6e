package stillwater.estimate

import stillwater.sensor.SensorStage
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.hypot
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * A response and how likely it is.
 *
 * @property responses responses about the best one of its kind that together have its mean and spread, equally likely.
 * @property weight probability of the kind, above 0.
 */
public class LikelyResponse(public val responses: List<Response>, public val weight: Double)

/**
 * The water along a track with its 95 % interval at each reading.
 *
 * @property values best value of the field where and when the reading was taken, sensor units, length n.
 * @property lower lower end of the interval, length n. @property upper upper end, length n.
 * @property silent readings at which the sensor was at its rate limit and said one side only, length n.
 * @property outlying readings taken for outliers: their values are foretold from the others, and their intervals reach
 * to the readings themselves, length n.
 * @property clipped readings at an end of the sensor's range: the sensor was there or beyond, length n.
 */
public class CorrectedTrack internal constructor(
    public val values: DoubleArray,
    public val lower: DoubleArray,
    public val upper: DoubleArray,
    public val silent: BooleanArray,
    public val outlying: BooleanArray,
    public val clipped: BooleanArray = BooleanArray(values.size),
) {
    /** Half the intervals' width on average, sensor units, but for [outlying] readings, to which theirs reach. */
    public val meanHalfWidth: Double
        get() {
            val rows = lower.indices.filterNot(outlying::get)
            return rows.sumOf { upper[it] - lower[it] } / (2 * maxOf(1, rows.size))
        }

    /** The same values, with intervals that hold those of [other] as well, which is possible too but less likely. */
    public fun holding(other: CorrectedTrack): CorrectedTrack =
        within({ minOf(lower[it], other.lower[it]) }, { maxOf(upper[it], other.upper[it]) })

    /** The same values, with intervals that reach [factor] times as far either way; above 0. */
    public fun scaledBy(factor: Double): CorrectedTrack =
        within({ values[it] - factor * (values[it] - lower[it]) }, { values[it] + factor * (upper[it] - values[it]) })

    /** The same values, with intervals that reach [margin], sensor units, at least 0, farther either way. */
    public fun widenedBy(margin: Double): CorrectedTrack = within({ lower[it] - margin }, { upper[it] + margin })

    private fun within(low: (Int) -> Double, high: (Int) -> Double) = CorrectedTrack(
        values,
        DoubleArray(values.size, low),
        DoubleArray(values.size, high),
        silent,
        outlying,
        clipped,
    )
}

/**
 * Undoes a sensor's response along a whole track, with an honest interval: what the sensor has smoothed away is not
 * made up, but left open as far as the water is rough, which is learned from the log.
 *
 * Model and derivation: core/docs/TrackCorrection.md, (6) and (7). Linear in the number of readings. Confined to one
 * thread.
 *
 * @param series the readings. Retained.
 * @param resolution step in which readings are rounded, sensor units, at least 0; 0 for none.
 * @param unusable readings that are known to say nothing, or one side only, of what the sensor is at; more wild ones
 *   may be found. @param wander noise of the readings that wanders, sensor units; null where none is known.
 * @param noise standard deviation of the readings' white noise, sensor units, at least 0; 0 where it is not known and
 *   learned from the readings, which in rough water do not tell it from the water.
 */
public class TrackCorrector(
    private val series: TrackSeries,
    private val resolution: Double = 0.0,
    private val unusable: UnusableReadings = UnusableReadings.none(series.size),
    private val wander: SensorStage.Wander? = null,
    private val noise: Double = 0.0,
) {
    init {
        require(noise >= 0 && noise.isFinite()) { "noise ($noise) must be at least 0 and finite" }
        require(unusable.wild.size == series.size) {
            "unusable (${unusable.wild.size}) must be as long as series (${series.size})"
        }
        require(resolution >= 0 && resolution.isFinite()) { "resolution ($resolution) must be at least 0 and finite" }
    }

    /** One response with all that goes with it. */
    private inner class Part(val response: Response, val along: AlongTrack, val weight: Double) {
        val timed = series.inTimeOf(response)
        val sides = SensorSides(timed, response, resolution)
    }

    /** The field if [candidates] are the responses that the log leaves open. */
    public fun correct(candidates: List<LikelyResponse>): CorrectedTrack {
        require(candidates.isNotEmpty()) { "candidates must not be empty" }
        val total = candidates.sumOf { it.weight }
        val parts = candidates.flatMap { candidate ->
            val along = fitted(candidate.responses.first())
            candidate.responses.map { Part(it, along, candidate.weight / total / candidate.responses.size) }
        }
        val track = CorrectedTrack(
            DoubleArray(series.size),
            DoubleArray(series.size),
            DoubleArray(series.size),
            BooleanArray(series.size) { row -> parts.any { it.sides.silent[row] } },
            BooleanArray(series.size),
            BooleanArray(series.size) { unusable.ends[it].toInt() != 0 },
        )
        pieces(PIECE) { rows, from, to ->
            val mixture = NormalMixture(to - from)
            for (part in parts) run(part, rows, from, to, mixture, track.outlying)
            mixture.write(track, from)
            if (isConstant) for (row in from until to) widen(track, row)
            for (row in from until to) {
                if (!track.outlying[row]) continue
                track.lower[row] = minOf(track.lower[row], series.values[row])
                track.upper[row] = maxOf(track.upper[row], series.values[row])
            }
        }
        return track
    }

    private fun smoother(
        stretch: Stretch,
        response: Response,
        along: AlongTrack,
        agitation: DoubleArray,
        step: Double,
    ) = TrackSmoother(stretch, response, along, agitation, step, wander)

    private val isConstant = series.values.all { it == series.values[0] }

    /**
     * Readings that differ in nothing do not get better by being many: the water is anywhere within the step to which
     * they are rounded.
     */
    private fun widen(track: CorrectedTrack, row: Int) {
        track.lower[row] = minOf(track.lower[row], series.values[row] - resolution / 2)
        track.upper[row] = maxOf(track.upper[row], series.values[row] + resolution / 2)
    }

    private fun stretch(rows: IntRange, timed: TrackSeries, sides: SensorSides): Stretch {
        val stretch = Stretch(
            timed.times.copyOfRange(rows.first, rows.last + 1),
            DoubleArray(rows.last - rows.first + 1) { series.values[rows.first + it] - level },
            sides.silent.copyOfRange(rows.first, rows.last + 1),
            sides.rising.copyOfRange(rows.first, rows.last + 1),
            sides.looseness.copyOfRange(rows.first, rows.last + 1),
            sides.ahead.copyOfRange(rows.first, rows.last + 1),
        )
        for (row in rows) {
            val i = row - rows.first
            stretch.outlying[i] = unusable.wild[row]
            val end = unusable.ends[row].toInt()
            if (end == 0) continue
            // At an end of its range the sensor is there or beyond.
            stretch.silent[i] = true
            stretch.rising[i] = end > 0
            stretch.looseness[i] = 0.0
            stretch.ahead[i] = Double.NaN
        }
        return stretch
    }

    private fun run(
        part: Part,
        rows: IntRange,
        from: Int,
        to: Int,
        mixture: NormalMixture,
        outlying: BooleanArray,
    ) {
        val stretch = stretch(rows, part.timed, part.sides)
        val mean = DoubleArray(stretch.size)
        val variance = DoubleArray(stretch.size)
        tellSides(stretch, part.response, part.along, part.timed.medianStep)
        val agitation = agitation(stretch, part.response, part.along, part.timed.medianStep)
        smoother(stretch, part.response, part.along, agitation, part.timed.medianStep).smooth(mean, variance)
        for (row in from until to) {
            val i = row - rows.first
            val side = if (!part.sides.silent[row]) {
                0
            } else if (stretch.rising[i]) {
                1
            } else {
                -1
            }
            if (stretch.outlying[i]) outlying[row] = true
            val ahead = stretch.ahead[i].takeUnless { it.isNaN() } ?: 0.0
            val limit = series.values[row] + side * (ahead - BEYOND * hypot(part.along.noise, stretch.looseness[i]))
            mixture.add(row - from, part.weight, mean[i] + level, variance[i], side, limit)
        }
    }

    /** Of readings, and not of what is none: 65535 in three rows of 500 moves the mean by 400. */
    private val level: Double = run {
        val tame = series.values.filterIndexed { i, _ -> !unusable.wild[i] }
        if (tame.isEmpty()) 0.0 else tame.average()
    }

    /** How much livelier than usual the water is at each reading, from the readings' own surprises. */
    private fun agitation(stretch: Stretch, response: Response, along: AlongTrack, step: Double): DoubleArray {
        val factor = DoubleArray(stretch.size) { 1.0 }
        val smoother = smoother(stretch, response, along, factor, step)
        repeat(ADAPTATIONS) {
            smoother.logLikelihood()
            if (it == ADAPTATIONS - 1) OutlierSearch(stretch, smoother::logLikelihood).mark(smoother.surprises.copyOf())
            // A single wild reading is not lively water.
            val surprise = DoubleArray(stretch.size) { minOf(smoother.surprises[it], LARGEST_SURPRISE) }
            val sums = DoubleArray(stretch.size + 1)
            for (i in surprise.indices) sums[i + 1] = sums[i] + surprise[i]
            for (i in factor.indices) {
                val from = maxOf(0, i - WINDOW)
                val to = minOf(stretch.size, i + WINDOW + 1)
                val ratio = (PRIOR + sums[to] - sums[from]) / (PRIOR + to - from)
                // Water that outran the sensor is not calmer than usual, however calm the readings about it are.
                val least = if (stretch.silent[i]) 1.0 else CALMEST
                factor[i] = (factor[i] * ratio * ratio).coerceIn(least, LIVELIEST)
            }
        }
        return factor
    }

    /**
     * Whether a lag with two time constants rises, from water and lag as smoothed with what was thought of it before:
     * readings that are near to each other tell it only where they have hardly any noise.
     */
    private fun tellSides(stretch: Stretch, response: Response, along: AlongTrack, step: Double) {
        if (!LagLead.isAskedOf(response)) return
        val calm = DoubleArray(stretch.size) { 1.0 }
        val mean = DoubleArray(stretch.size)
        val variance = DoubleArray(stretch.size)
        repeat(MOST_ROUNDS) {
            val before = stretch.rises.copyOf()
            smoother(stretch, response, along, calm, step).smooth(mean, variance)
            if (stretch.rises.indices.all { abs(stretch.rises[it] - before[it]) < SAME_SIDES }) return
        }
    }

    /** The water's liveliness under [response], by the density of the readings in the longest piece. */
    private fun fitted(response: Response): AlongTrack {
        var sample = 0..0
        pieces(SAMPLE) { rows, _, _ -> if (rows.last - rows.first > sample.last - sample.first) sample = rows }
        val timed = series.inTimeOf(response)
        val step = timed.medianStep
        val stretch = stretch(sample, timed, SensorSides(timed, response, resolution))
        val calm = DoubleArray(stretch.size) { 1.0 }
        val tame = stretch.values.filterIndexed { i, _ -> !stretch.outlying[i] }
        val spread = sqrt(tame.sumOf { it * it } / maxOf(1, tame.size)).coerceAtLeast(LEAST + resolution)
        val rounding = resolution / sqrt(12.0)
        val known = if (noise > 0) hypot(noise, rounding) else null
        val least = ln(maxOf(rounding, spread * SMALLEST_NOISE))
        fun at(logs: DoubleArray, smoothness: Smoothness) =
            AlongTrack(exp(logs[0]), exp(logs[1]), known ?: exp(maxOf(logs[2], least)), smoothness)

        fun total(logs: DoubleArray, smoothness: Smoothness): Double {
            // A weak belief keeps what the readings leave open within the log's own scales.
            val belief = (logs[0] - ln(spread)).let { it * it / 8 } +
                (logs[1] + ln(RATE_STEPS * step)).let { it * it / 32 }
            return smoother(stretch, response, at(logs, smoothness), calm, step).logLikelihood() - belief
        }
        val start =
            doubleArrayOf(ln(spread), -ln(RATE_STEPS * step), maxOf(least, ln(spread * FIRST_NOISE)))

        fun likeliest() = Smoothness.entries.map { smoothness ->
            val best = Search.simplex(start, doubleArrayOf(0.7, 1.0, 1.0), EVALUATIONS, CLOSE) { total(it, smoothness) }
            at(best, smoothness) to total(best, smoothness)
        }.maxBy { it.second }.first
        val first = likeliest()
        val before = stretch.rises.copyOf()
        tellSides(stretch, response, first, step)
        // Sides that are wrong look like noise, or like lively water.
        return if (stretch.rises.contentEquals(before)) first else likeliest()
    }

    /**
     * Hands the track on in stretches without gaps, long ones in pieces that overlap: all rows, and those that count.
     */
    private fun pieces(most: Int, each: (rows: IntRange, from: Int, to: Int) -> Unit) {
        var begin = 0
        while (begin < series.size) {
            var end = begin + 1
            while (end < series.size && !series.isAfterGap(end)) end++
            var from = begin
            while (from < end) {
                val to = minOf(end, from + most)
                each(maxOf(begin, from - OVERLAP) until minOf(end, to + OVERLAP), from, to)
                from = to
            }
            begin = end
        }
    }

    private companion object {
        const val PIECE = 20_000
        const val OVERLAP = 500
        const val SAMPLE = 2000
        const val EVALUATIONS = 60
        const val CLOSE = 0.05
        const val RATE_STEPS = 30.0
        const val FIRST_NOISE = 0.02
        const val SMALLEST_NOISE = 1e-5
        const val LEAST = 1e-12
        const val ADAPTATIONS = 2

        /** Sides settle in three to five rounds; the noisier the readings, the later. */
        const val MOST_ROUNDS = 8

        /** A probability that changes by less changes no interval that is written. */
        const val SAME_SIDES = 0.05
        const val WINDOW = 30
        const val PRIOR = 60.0

        /** The field is not farther beyond a reading at the sensor's limit than so many deviations of its noise. */
        const val BEYOND = 2.0
        const val LARGEST_SURPRISE = 25.0
        const val CALMEST = 0.02
        const val LIVELIEST = 50.0
    }
}
