package stillwater.estimate

import stillwater.sensor.SensorStage
import kotlin.math.abs
import kotlin.math.ceil
import kotlin.math.exp
import kotlin.math.expm1
import kotlin.math.pow

/**
 * How the water changes along a track, and how well it is read.
 *
 * @property deviation standard deviation of the field about its level, sensor units.
 * @property rate one over the time over which the field stays alike, 1/s.
 * @property noise standard deviation of a reading's noise, sensor units. @property smoothness Matérn's ν.
 */
internal data class AlongTrack(
    val deviation: Double,
    val rate: Double,
    val noise: Double,
    val smoothness: Smoothness = Smoothness.USUAL,
) {
    /** Number of the field's own states: the value and its derivatives. */
    val states: Int get() = smoothness.ordinal + 1

    /** Matérn's λ, 1/s. */
    val decay: Double get() = rate * Math.sqrt(2 * smoothness.nu)
}

/**
 * x ← F x + q, cov q = Q, of the field's states and the lags' over one step of time: row-major `size × size`.
 *
 * @property move F. @property spread Q.
 */
internal class Transition(val move: DoubleArray, val spread: DoubleArray)

/**
 * Transitions of a field with [along] seen through [lags], by length of step. Steps that differ by less than a
 * thousandth of [usual] are taken as one. With a [slowShare] w both lags see the field, and the last state is what is
 * shown of them, (1 − w) s₁ + w s₂. With a [wander] one more state has that noise on top of what is shown.
 */
internal class FieldMotion(
    private val along: AlongTrack,
    private val lags: List<ResponseLag>,
    private val usual: Double,
    private val slowShare: Double = 0.0,
    private val wander: SensorStage.Wander? = null,
) {
    private val quiet = along.states + lags.size

    /** Number of states: the field's, one a lag, and that with the noise. */
    val size: Int = quiet + if (wander == null) 0 else 1

    /** What is shown without the noise that wanders. */
    private val followed = if (lags.isEmpty()) 0 else quiet - 1

    /** The state that the readings show. */
    val shown: Int = if (wander == null) followed else quiet
    private val known = HashMap<Long, Transition>()
    private val shortest = minOf(1 / along.decay, lags.minOfOrNull { minOf(it.rising, it.falling) } ?: Double.MAX_VALUE)

    /** Covariance of the states where nothing is known but that the sensor has about settled, row-major. */
    fun start(): DoubleArray {
        val p = DoubleArray(size * size)
        val field = stationary()
        val n = along.states
        for (i in 0 until n) for (j in 0 until n) p[i * size + j] = field[i * n + j]
        for (i in along.states until quiet) {
            for (j in 0 until along.states) {
                p[i * size + j] = p[j]
                p[j * size + i] = p[j]
            }
            for (j in along.states until quiet) p[i * size + j] = p[0]
            p[i * size + i] = p[0] * (1 + UNSETTLED)
        }
        if (wander != null) {
            for (j in 0 until quiet) {
                p[shown * size + j] = p[followed * size + j]
                p[j * size + shown] = p[followed * size + j]
            }
            p[shown * size + shown] = p[followed * size + followed] + wander.standardDeviation.pow(2)
        }
        return p
    }

    /**
     * The transition over [dt] s while the lags rise with the probability [rising], 0..1, to the nearest of [LEVELS]
     * steps: their rates 1/τ are at the mean.
     */
    fun over(dt: Double, rising: Double): Transition {
        val level = Math.round(rising * LEVELS)
        val key = (LEVELS + 1) * Math.round(dt / usual * FINENESS) + level
        return known.getOrPut(key) {
            made(Math.round(dt / usual * FINENESS) / FINENESS * usual, level / LEVELS.toDouble())
        }
    }

    private fun made(dt: Double, rising: Double): Transition {
        val pieces = ceil(dt / shortest * PIECES).toInt().coerceIn(1, MOST_PIECES)
        val piece = short(dt / pieces, rising)
        var whole = piece
        repeat(pieces - 1) { whole = then(whole, piece) }
        return whole
    }

    private fun then(first: Transition, second: Transition): Transition {
        val move = product(second.move, first.move, false)
        val spread = product(product(second.move, first.spread, false), second.move, true)
        for (i in spread.indices) spread[i] += second.spread[i]
        return Transition(move, spread)
    }

    private fun product(a: DoubleArray, b: DoubleArray, transposed: Boolean) = DoubleArray(size * size) { at ->
        val i = at / size
        val j = at % size
        var sum = 0.0
        for (k in 0 until size) sum += a[i * size + k] * if (transposed) b[j * size + k] else b[k * size + j]
        sum
    }

    /** One step over which the field runs about straight: its own states exactly, the lags by [LagWeights]. */
    private fun short(dt: Double, rising: Double): Transition {
        val n = along.states
        val field = fieldMove(dt)
        val move = DoubleArray(size * size)
        val noise = Array(size) { DoubleArray(n) }
        for (i in 0 until n) {
            for (j in 0 until n) move[i * size + j] = field[i * n + j]
            noise[i][i] = 1.0
        }
        val weights = LagWeights()
        for (k in lags.indices) {
            weights.set(lags[k].between(rising), dt)
            val row = n + k
            val input = if (k == 0) 0 else row - 1
            // s ← keep s + before u + now u′, with u′ the input's own next value.
            for (j in 0 until size) move[row * size + j] = weights.now * move[input * size + j]
            move[row * size + input] += weights.before
            move[row * size + row] += weights.keep
            for (j in 0 until n) noise[row][j] = weights.now * noise[input][j]
            if (k == 1 && slowShare > 0) beside(weights, move, noise)
        }
        wander?.let { follow(exp(-dt / it.correlationTime), move, noise) }
        val own = fieldSpread(field)
        val spread = DoubleArray(size * size) { at ->
            var sum = 0.0
            for (a in 0 until n) for (b in 0 until n) sum += noise[at / size][a] * own[a * n + b] * noise[at % size][b]
            sum
        }
        wander?.let {
            spread[size * size - 1] -= it.standardDeviation.pow(2) * expm1(-2 * dt / it.correlationTime)
        }
        return Transition(move, spread)
    }

    /** The last state as q = s + c, with s what is shown without noise: q ← s′ + [fade] (q − s). */
    private fun follow(fade: Double, move: DoubleArray, noise: Array<DoubleArray>) {
        for (j in 0 until size) move[shown * size + j] = move[followed * size + j]
        move[shown * size + shown] += fade
        move[shown * size + followed] -= fade
        noise[followed].copyInto(noise[shown])
    }

    /**
     * The last state as q = (1 − w) s₁ + w s₂ in place of a second lag in a row:
     * q ← (1 − w) s₁′ + keep (q − (1 − w) s₁) + w (before u + now u′), with s₁′ the first lag's own next value.
     */
    private fun beside(weights: LagWeights, move: DoubleArray, noise: Array<DoubleArray>) {
        val shown = quiet - 1
        val fast = quiet - 2
        val rest = 1 - slowShare
        for (j in 0 until size) {
            move[shown * size + j] = rest * move[fast * size + j] + slowShare * weights.now * move[j]
        }
        move[shown * size + shown] += weights.keep
        move[shown * size + fast] -= weights.keep * rest
        move[shown * size] += slowShare * weights.before
        for (j in noise[shown].indices) noise[shown][j] = rest * noise[fast][j] + slowShare * weights.now * noise[0][j]
    }

    /** exp(A Δ) of Matérn's process (Hartikainen and Särkkä 2010, doi:10.1109/MLSP.2010.5589113). */
    private fun fieldMove(dt: Double): DoubleArray {
        val l = along.decay
        val x = l * dt
        val e = exp(-x)
        return when (along.smoothness) {
            Smoothness.ROUGH -> doubleArrayOf(e)
            Smoothness.USUAL -> doubleArrayOf(e * (1 + x), e * dt, -e * l * x, e * (1 - x))
            Smoothness.SMOOTH -> doubleArrayOf(
                e * (x * x / 2 + x + 1), e * dt * (x + 1), e * dt * dt / 2,
                -e * l * x * x / 2, -e * (x * x - x - 1), -e * dt * (x - 2) / 2,
                e * l * l * x * (x - 2) / 2, e * l * x * (x - 3), e * (x * x - 4 * x + 2) / 2,
            )
        }
    }

    /** P∞ − F P∞ Fᵀ, with what rounding leaves below zero on its diagonal cut. */
    private fun fieldSpread(move: DoubleArray): DoubleArray {
        val n = along.states
        val p = stationary()
        val spread = DoubleArray(n * n) { at ->
            var sum = p[at]
            for (a in 0 until n) for (b in 0 until n) sum -= move[at / n * n + a] * p[a * n + b] * move[at % n * n + b]
            sum
        }
        for (i in 0 until n) spread[i * n + i] = abs(spread[i * n + i])
        return spread
    }

    private fun stationary(): DoubleArray {
        val v = along.deviation * along.deviation
        val l = along.decay * along.decay
        return when (along.smoothness) {
            Smoothness.ROUGH -> doubleArrayOf(v)
            Smoothness.USUAL -> doubleArrayOf(v, 0.0, 0.0, v * l)
            Smoothness.SMOOTH -> doubleArrayOf(v, 0.0, -v * l / 3, 0.0, v * l / 3, 0.0, -v * l / 3, 0.0, v * l * l)
        }
    }

    private companion object {
        const val FINENESS = 1000.0

        /** Finer steps of a probability change no rate by more than a 32nd of what rising and falling differ by. */
        const val LEVELS = 16L
        const val PIECES = 2.0
        const val MOST_PIECES = 40
        const val UNSETTLED = 0.05
    }
}
