package stillwater.hidden

import stillwater.field.Field
import stillwater.model.BoatTime
import java.nio.file.Files
import java.nio.file.Path
import java.util.Locale
import kotlin.math.ceil
import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.log10
import kotlin.math.pow
import kotlin.math.sqrt
import kotlin.random.Random

/** What a case hides, for the scorer alone. */
internal data class HiddenTruth(
    val track: TrackKind,
    val effects: Map<HiddenEffect, Double>,
    val multiples: Map<HiddenEffect, Double>,
    val timeConstant: Double,
    val noise: Double,
    val numbers: Map<HiddenEffect, Double>,
) {
    /** Whether it is one effect of the list at the detectable size or above. */
    val isStrong: Boolean
        get() = effects.size == 1 && effects.keys.single().listed && multiples.values.single() >= 1
}

/**
 * A log with or without hidden effects, drawn from a seed. The finder sees the file that [write] makes and nothing
 * else.
 *
 * Two cases in five or more have no effect; of the others most have one, some two, some one that is not in the list of
 * causes. Strengths are 0.25 to 4 times the [DetectableSize].
 *
 * @param isDelay whether the sensor has a dead time, [delay], in place of the lag, and no effect.
 * @param isTwin whether what is hidden is left out of the readings that [write] writes, all else the same.
 * @param inField whether the log has what [HiddenConditions] draws besides.
 */
internal class HiddenCase(
    seed: Long,
    private val withReference: Boolean,
    private val isDelay: Boolean = false,
    private val isTwin: Boolean = false,
    inField: Boolean = false,
) {
    private val random = Random(seed * 7919 + if (withReference) 1 else 2)
    private val kind = kinds().let { it[random.nextInt(it.size)] }
    private val period = listOf(0.5, 1.0, 1.0, 2.0)[random.nextInt(4)]
    private val rows = 900 + random.nextInt(600)

    /** What the field does to the log; null in a log without gaps and the like. */
    val conditions = if (inField) HiddenConditions(seed, rows, period) else null

    /** By dice of its own: what else a seed draws does not go by it. */
    private val isAhead = Random(seed * 7919 + SIDE).nextBoolean()
    private val timeConstant = period * exp(ln(3.0) + random.nextDouble() * ln(5.0))

    /** The dead time in place of the lag, s: short enough beside the waves that a lag is like it at first. */
    val delay = timeConstant / 3

    /** The lag that a sensor with [delay] has besides, s: a step of the generator's own. */
    val step get() = period / per

    private val speed = 0.6 + 0.8 * random.nextDouble()
    private val per = 20

    // The shortest wave, half of it at the highest speed, still has some eight rows.
    private val length by lazy {
        maxOf(speed * timeConstant * (3 + 5 * random.nextDouble()), 24 * speed * period)
    }
    private val world = world()
    private val gain = 0.85 + 0.3 * random.nextDouble()
    private val offset = world.amplitude * (random.nextDouble() - 0.5)
    private val stepShares = List(1 + random.nextInt(2)) { 0.15 + 0.35 * (it + random.nextDouble()) }
    private val noise = HiddenNoise(
        spread = world.amplitude * 0.004 * exp(random.nextDouble() * ln(5.0)),
        share = if (random.nextBoolean()) 0.0 else 0.3 + 0.6 * random.nextDouble(),
        time = period * exp(ln(2.0) + random.nextDouble() * ln(6.0)),
        period = period,
    )
    private val jitter = if (random.nextBoolean()) 0.0 else 0.2 + 0.5 * random.nextDouble()

    /** Whether the finder is given a sensor as it is believed to be; a wrong number in it is an effect by itself. */
    private val isGiven = withReference && random.nextDouble() < GIVEN_SHARE
    private val drawn = draw()

    /** What is hidden; the scorer's alone. */
    val truth =
        HiddenTruth(
            kind,
            drawn.mapValues { it.value.first },
            drawn.mapValues { it.value.second },
            timeConstant,
            noise.spread,
            drawn.mapValues { it.value.first }.let { effects -> effects.mapValues { sensor(effects).number(it.key) } },
        )

    private fun kinds() = if (withReference) {
        TrackKind.entries
    } else {
        listOf(TrackKind.SURVEY, TrackKind.SURVEY, TrackKind.RANDOM_WALK)
    }

    private fun world(): HiddenWorld {
        val size = rows * per + 1
        val track = HiddenTrack.draw(kind, random, size, step, speed)
        val length = length
        val field: Field =
            if (kind == TrackKind.BENCH) {
                BenchField(random, size * step, 6 * period, 6 * timeConstant)
            } else {
                WaveField(random, length)
            }
        val warm = WaveField(random, 3 * length)
        val salt = WaveField(random, 2 * length)

        // On the bench temperature and salinity wander with time instead of place.
        fun along(other: Field, i: Int) =
            if (kind == TrackKind.BENCH) {
                other.truth(speed * i * step, 0.0, BoatTime(0.0))
            } else {
                other.truth(track.x[i], track.y[i], BoatTime(0.0))
            }
        return HiddenWorld(
            track,
            field,
            amplitude = 10.0.pow(random.nextInt(3)),
            level = 10.0 * random.nextDouble(),
            temperature = DoubleArray(size) { HiddenSensor.ORDINARY_TEMPERATURE + 4 * along(warm, it) },
            salinity = DoubleArray(size) { along(salt, it) },
            per = per,
        )
    }

    /** What is detectable is asked of one that begins in the first water: how it settles otherwise has a number of its own. */
    private fun sensor(
        effects: Map<HiddenEffect, Double>,
        tau: Double = timeConstant,
        start: Double = 0.0,
    ): HiddenSensor {
        val own = if (isDelay) mapOf(HiddenEffect.DEAD_TIME to delay) else effects
        return HiddenSensor(world, if (isDelay) step else tau, gain, offset, own, stepShares, isAhead, start)
    }

    private fun draw(): Map<HiddenEffect, Pair<Double, Double>> {
        if (isDelay) return emptyMap()
        val dice = random.nextDouble()
        val listed = HiddenEffect.entries.filter { it.listed && fits(it) }
        val strange = HiddenEffect.entries.filter { !it.listed && fits(it) }
        val wanted = when {
            dice < 0.42 -> return emptyMap()
            // A wrong number of a given sensor is as likely as all else together.
            dice < 0.76 && isGiven && random.nextBoolean() ->
                listOf(if (random.nextBoolean()) HiddenEffect.TIME_CONSTANT else HiddenEffect.GAIN_OFFSET)
            dice < 0.76 -> listOf(listed[random.nextInt(listed.size)])
            dice < 0.88 -> listed.shuffled(random).take(2)
            else -> listOf(strange[random.nextInt(strange.size)])
        }
        val multiple = exp(ln(0.25) + random.nextDouble() * ln(16.0))
        val size = DetectableSize(
            noise,
            { sensor(it).readings() },
            { sensor(emptyMap(), it).readings() },
            timeConstant,
            isGiven,
            offset,
            SHIFTS.associateWith { step } + (HiddenEffect.POSITION to speed * step),
            if (withReference) null else { flat -> UnseenWater(world, noise, timeConstant, length, jitter, flat) },
        )
        val found = wanted.associateWith { effect ->
            if (effect != HiddenEffect.TIME_VARYING || !withReference) return@associateWith size.of(effect, multiple)
            // The reference shows the change itself: only coming back to a place does.
            val detectable = HiddenRevisits(world, jitter, REFERENCE_NOISE * noise.spread).detectable()
            (multiple * detectable).takeIf { it <= MOST }
        }
        // What no strength makes detectable on this track is not asked for.
        return if (found.values.any {
                it == null
            }
        ) {
            emptyMap()
        } else {
            found.mapValues { checkNotNull(it.value) to multiple }
        }
    }

    private fun fits(effect: HiddenEffect): Boolean = when (effect) {
        HiddenEffect.TIME_CONSTANT, HiddenEffect.GAIN_OFFSET -> isGiven
        HiddenEffect.TIME_VARYING -> kind == TrackKind.SURVEY || kind == TrackKind.RANDOM_WALK
        HiddenEffect.POSITION, HiddenEffect.HEADING -> kind != TrackKind.BENCH && kind != TrackKind.TOW
        HiddenEffect.FLOW -> kind != TrackKind.BENCH
        else -> true
    }

    /**
     * Root mean square of what a model with the true numbers leaves of the readings that [write] wrote, sensor units;
     * NaN before, and where no model of the reading predicts the effect (outliers, water that changes).
     */
    var leftByTruth = Double.NaN
        private set

    /** Writes the log into [file]. */
    fun write(file: Path) {
        val effects = if (isTwin) emptyMap() else truth.effects
        val clean = sensor(effects, start = conditions?.start ?: 0.0).readings()
        val values = noise.added(clean, random) { random.normal() * (conditions?.tail() ?: 1.0) }
        val outlying = effects[HiddenEffect.OUTLIERS]
        if (outlying != null) {
            for (i in values.indices) {
                val share = 2 * random.nextDouble() - 1
                if (random.nextDouble() < HiddenNoise.OUTLIER_SHARE) values[i] += outlying * noise.spread * share
            }
        }
        val fine = 10.0.pow(ceil(log10(noise.spread / 30)))
        val quantum = effects[HiddenEffect.QUANTISATION]?.let { it * noise.spread } ?: fine
        leftByTruth = left(clean, values, quantum, outlying != null)
        val header = "time_s,x_m,y_m,value,speed_mps,temperature_c,salinity,heading_rad" +
            if (withReference) ",reference" else ""
        val trend = effects[HiddenEffect.TIME_VARYING] ?: 0.0
        val lines = ArrayList<String>()
        lines += header
        val wander = List(2) { conditions?.wander() ?: DoubleArray(rows) }
        var fix = Double.NaN to Double.NaN
        for (row in 0 until rows) {
            val i = (row + 1) * per
            val x = world.track.x[i] + jitter * random.normal() + wander[0][row]
            val y = world.track.y[i] + jitter * random.normal() + wander[1][row]
            if (conditions?.isFixed(row) != false) fix = x to y
            val numbers = listOf(
                (row + 1) * period,
                fix.first,
                fix.second,
                quantum * Math.rint(values[row] / quantum),
                world.track.speed[i],
                world.temperature[i] + 0.01 * random.normal(),
                world.salinity[i] + 0.003 * random.normal(),
                world.track.heading[i],
            )
            val known = if (withReference) {
                listOf(
                    world.truth(i, trend = trend) + REFERENCE_NOISE * noise.spread * random.normal(),
                )
            } else {
                emptyList()
            }
            if (conditions?.isWritten(row) == false) continue
            lines += (numbers + known).joinToString(",") { "%.9g".format(Locale.ROOT, it) }
        }
        Files.write(file, lines)
    }

    /** Writes the sensor as it is believed to be into [file], where the case gives one; returns whether it does. */
    fun writeSensor(file: Path): Boolean {
        if (!isGiven) return false
        val tau = timeConstant * exp(truth.effects[HiddenEffect.TIME_CONSTANT] ?: 0.0)
        val believed = gain * (1 + (truth.effects[HiddenEffect.GAIN_OFFSET] ?: 0.0))
        val lag = """{"type": "first-order-lag", "time_constant_s": $tau}"""
        val calibration = """{"type": "gain-offset", "gain": $believed, "offset": $offset}"""
        Files.writeString(file, """{"name": "believed", "stages": [$lag, $calibration]}""")
        return true
    }

    private companion object {
        const val GIVEN_SHARE = 0.15

        /** Effects whose strength is a shift, s. */
        val SHIFTS = listOf(HiddenEffect.DEAD_TIME, HiddenEffect.SECOND_ORDER)

        /** The dice for which side a probe is on. */
        const val SIDE = 3
        const val REFERENCE_NOISE = 0.1

        /** Stronger changes of the water than this, in its own spread, are not hidden. */
        const val MOST = 3.0
    }

    private fun left(clean: DoubleArray, values: DoubleArray, quantum: Double, hasOutliers: Boolean): Double {
        if (hasOutliers || (withReference && HiddenEffect.TIME_VARYING in truth.effects)) return Double.NaN
        val expected = DetectableSize.rounded(clean, noise.spread, quantum)
        val squares = values.indices.sumOf { i -> (quantum * Math.rint(values[i] / quantum) - expected[i]).pow(2) }
        return sqrt(squares / values.size)
    }
}

/** Noise of [spread], of which [share] (of the variance) is correlated over [time] s; rows are [period] s apart. */
internal class HiddenNoise(val spread: Double, val share: Double, val time: Double, private val period: Double) {
    /** [clean] with noise, whose uncorrelated part is what [white] draws, of unit spread. */
    fun added(clean: DoubleArray, random: Random, white: () -> Double): DoubleArray {
        val wander = Wander(random, period, time)
        return DoubleArray(clean.size) { i ->
            clean[i] + spread * (sqrt(share) * wander.next() + sqrt(1 - share) * white())
        }
    }

    /** [column] as innovations over their standard deviation: the best linear prediction from the past taken off. */
    fun innovations(column: DoubleArray): DoubleArray {
        val keep = exp(-period / time)
        var mean = 0.0
        var variance = share
        return DoubleArray(column.size) { i ->
            val total = variance + (1 - share) + 1e-12
            val surprise = column[i] - mean
            val k = variance / total
            mean = keep * (mean + k * surprise)
            variance = keep * keep * variance * (1 - k) + share * (1 - keep * keep)
            surprise / sqrt(total) / spread
        }
    }

    companion object {
        const val OUTLIER_SHARE = 0.01
    }
}
