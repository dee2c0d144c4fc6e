package stillwater.estimate

import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.pow
import kotlin.math.sqrt

/**
 * Follows a sensor that moves towards the truth at a fixed rate and stops there, for a known noise.
 *
 * A visit goes one of four ways: up all along, down all along, up and then level, down and then level. Each is a Kalman
 * filter on the sensor's state, its rate and the truth of the cell before, with the likelihood of what it saw; of the moments at
 * which it may have come to rest the likeliest is kept. On leaving, the likeliest way counts. Level beyond doubt means the
 * truth is the state; moving, or level by a chance reading or two, bounds the truth on one side. Scaled values. Section "Slew
 * limit" of core/docs/SelfCalibratingEstimator.md. O(1) a reading, no allocation once the cells' memory has grown.
 */
internal class SlewFilter : ReadingPlayer {
    override val filters: Int get() = WAYS
    private val ways = DoubleArray(WAYS * STRIDE)
    private var memory = DoubleArray(FIRST_SLOTS * SLOT)
    private var noise = 1.0
    private var lastSeconds = Double.NaN
    private var lastElapsed = 0.0

    private val usualInterval = UsualInterval()

    /** Slot of the cell the boat is in; below 0 if it is in none. */
    var here: Int = LagBank.NONE
        private set

    /** Slot of the cell before, if its truth was reached there, or [LagBank.NONE]. */
    var before: Int = LagBank.NONE
        private set

    /** Readings, and agreements between visits, beyond the numbers fitted to them, but for the present visit's. */
    private var freedomBefore = 0.0

    /** See [freedomBefore]; a truth that was reached is a number fitted. */
    val freedom: Double get() = freedomBefore - if (here != LagBank.NONE && best() >= LEVEL) 1 else 0

    /** Sum of squared innovations over their variances, σ² included. */
    val misfit: Double get() = ways[best() * STRIDE + MISFIT]

    /** What of [misfit] is disagreement between visits, and how many agreements that is of. */
    private var pooledMisfit = 0.0
    private var agreements = 0

    /** Variance left within visits, whatever they disagree. */
    val varianceWithin: Double get() = (misfit - pooledMisfit) / (freedom - agreements)

    /** Minus twice the logarithm of the likelihood, but for a constant. */
    val score: Double get() = ways[best() * STRIDE + SCORE]

    /** Sum of products of successive scaled innovations. */
    val succession: Double get() = ways[best() * STRIDE + SUCCESSION]

    /** The most likely rate, 1/s. */
    val rate: Double get() = ways[best() * STRIDE + R]

    /** Its variance. */
    val rateVariance: Double get() = ways[best() * STRIDE + RR]

    /** Forgets all and starts from this [rate], 1/s, known within [relative] of it, and [noise], the variance of the readings. */
    fun reset(rate: Double, relative: Double, noise: Double) {
        this.noise = noise
        ways.fill(0.0)
        for (way in 0 until WAYS) {
            ways[way * STRIDE + R] = rate
            ways[way * STRIDE + RR] = relative * relative * rate * rate
        }
        memory.fill(0.0)
        here = LagBank.NONE
        before = LagBank.NONE
        freedomBefore = 0.0
        pooledMisfit = 0.0
        agreements = 0
        usualInterval.reset()
    }

    override fun leave() {
        if (here == LagBank.NONE) return
        settle()
        if (before != LagBank.NONE) pool(before)
        before = LagBank.NONE
        here = LagBank.NONE
    }

    override fun enter(slot: Int, from: Double, until: Double) {
        val elapsed = (from + until) / 2 - lastSeconds
        move(UP * STRIDE, elapsed)
        move(DOWN * STRIDE, -elapsed)
        // Up to the crossing it may have gone the other way.
        for (at in 0 until WAYS * STRIDE step STRIDE) ways[at + SS] += (ways[at + R] * (until - from)).pow(2) / 3
        lastSeconds += elapsed
        lastElapsed += elapsed
        usualInterval.wait(elapsed)
        settle()
        begin(slot)
    }

    /** Equal slots in a row are one visit. */
    override fun take(slot: Int, seconds: Double, value: Double) {
        var elapsed = 0.0
        if (here == LagBank.NONE) {
            for (at in 0 until WAYS * STRIDE step STRIDE) {
                for (k in UNKNOWN) ways[at + k] = 0.0
                ways[at + SS] = 1.0
                ways[at + QQ] = 1.0
            }
            freedomBefore--
            begin(slot)
        } else {
            if (slot != here) {
                settle()
                begin(slot)
            }
            elapsed = seconds - lastSeconds
        }
        lastSeconds = seconds
        lastElapsed = elapsed
        usualInterval.take(elapsed)
        // Level ways first: they start where the moving ones were.
        for (way in 0..1) rest(LEVEL + way, way, elapsed, value)
        for (way in 0..1) {
            move(way * STRIDE, if (way == UP) elapsed else -elapsed)
            correct(way * STRIDE, value)
        }
        freedomBefore++
    }

    private fun begin(slot: Int) {
        here = slot
        // Level only once it has come to rest.
        ways[LEVEL * STRIDE + SCORE] = Double.POSITIVE_INFINITY
        ways[(LEVEL + 1) * STRIDE + SCORE] = Double.POSITIVE_INFINITY
    }

    /** The level [way] goes on, or starts anew from the [moving] one, whichever is likelier. */
    private fun rest(way: Int, moving: Int, elapsed: Double, value: Double) {
        val at = way * STRIDE
        correct(at, value)
        val from = moving * STRIDE
        // It comes to rest in this step with the odds of the step to the range of the field; anywhere in the step.
        val step = ways[from + R] * elapsed
        val shift = if (moving == UP) step / 2 else -step / 2
        val variance = ways[from + SS] + step * step / 12 + noise
        val innovation = value - ways[from + S] - shift
        val cost = -2 * ln(maxOf(step, LEAST_STEP))
        val started = ways[from + SCORE] + cost + innovation * innovation / variance + ln(variance / noise)
        if (!(started < ways[at + SCORE])) return
        ways.copyInto(ways, at, from, from + STRIDE)
        ways[at + S] += shift
        ways[at + SS] += step * step
        ways[at + SCORE] += cost
        correct(at, value)
    }

    /** s ← s ± r Δ. */
    private fun move(at: Int, elapsed: Double) {
        val f = ways
        f[at + S] += elapsed * f[at + R]
        f[at + SS] += elapsed * (2 * f[at + SR] + elapsed * f[at + RR])
        f[at + SR] += elapsed * f[at + RR]
        f[at + SQ] += elapsed * f[at + RQ]
    }

    private fun correct(at: Int, value: Double) {
        val f = ways
        val innovation = value - f[at + S]
        val variance = f[at + SS] + noise
        val share = innovation / variance
        f[at + MISFIT] += innovation * share * noise
        f[at + SCORE] += innovation * share + ln(variance / noise)
        val scaled = innovation * sqrt(noise / variance)
        f[at + SUCCESSION] += scaled * f[at + INNOVATION]
        f[at + INNOVATION] = scaled
        val s = f[at + SS]
        val r = f[at + SR]
        val q = f[at + SQ]
        f[at + S] += s * share
        f[at + R] += r * share
        f[at + Q] += q * share
        f[at + SS] -= s * s / variance
        f[at + SR] -= s * r / variance
        f[at + SQ] -= s * q / variance
        f[at + RR] -= r * r / variance
        f[at + RQ] -= r * q / variance
        f[at + QQ] -= q * q / variance
    }

    private fun best(): Int {
        var best = 0
        for (way in 1 until WAYS) if (ways[way * STRIDE + SCORE] < ways[best * STRIDE + SCORE]) best = way
        return best
    }

    /**
     * Whether the sensor has come to rest beyond doubt: a cell never reached is gone through many times, and a single wild
     * last reading among those would make it known for ever.
     */
    private fun isAtRest() = movingOn() < BEYOND_DOUBT

    /** Probability that the sensor has not come to rest in the present visit. */
    private fun movingOn(): Double {
        val level = minOf(ways[LEVEL * STRIDE + SCORE], ways[(LEVEL + 1) * STRIDE + SCORE])
        val moving = minOf(ways[UP * STRIDE + SCORE], ways[DOWN * STRIDE + SCORE])
        return 1 / (1 + exp((moving - level) / 2))
    }

    /** Whether [way] began upwards, level or not. */
    private fun isUpwards(way: Int) = way == UP || way == LEVEL

    /** Whether up and down are as likely, as with the first reading of all: it bounds nothing. */
    private fun isOpen() = ways[UP * STRIDE + SCORE] == ways[DOWN * STRIDE + SCORE]

    /** Ends the visit: all ways go on from the likeliest, whose truth is the one before from now on. */
    private fun settle() {
        val best = best()
        val isOpen = isOpen()
        val movingOn = movingOn()
        for (way in 0 until WAYS) if (way != best) ways.copyInto(ways, way * STRIDE, best * STRIDE, (best + 1) * STRIDE)
        if (before != LagBank.NONE) pool(before)
        val slot = here
        before = LagBank.NONE
        remember(slot)
        if (best >= LEVEL) freedomBefore--
        if (movingOn < BEYOND_DOUBT) {
            before = maxOf(slot, LagBank.NONE)
            for (way in 0 until WAYS) {
                val at = way * STRIDE
                ways[at + Q] = ways[at + S]
                ways[at + QQ] = ways[at + SS]
                ways[at + SQ] = ways[at + SS]
                ways[at + RQ] = ways[at + SR]
            }
        } else {
            // It may have come to rest in the last step after all: a bound is what was reached before.
            val step = ways[R] * lastElapsed
            val bound = CERTAIN * sqrt(ways[SS]) + if (best < LEVEL) step else 0.0
            for (way in 0 until WAYS) {
                ways[way * STRIDE + SQ] = 0.0
                ways[way * STRIDE + RQ] = 0.0
                ways[way * STRIDE + SS] += step * step / 12
            }
            val at = slot * SLOT
            if (isOpen || slot < 0) return
            memory[at + RESTING] = 1 - movingOn
            if (memory[at + INFORMATION] == 0.0) memory[at + MEAN] = ways[S]
            if (isUpwards(best)) {
                memory[at + LOWER] = maxOf(memory[at + LOWER], ways[S] - bound + HALF)
            } else {
                memory[at + UPPER] = maxOf(memory[at + UPPER], HALF - ways[S] - bound)
            }
        }
    }

    private fun remember(slot: Int) {
        while (memory.size < (slot + 1) * SLOT) memory = memory.copyOf(2 * memory.size)
    }

    private fun pool(slot: Int) {
        remember(slot)
        val at = slot * SLOT
        val information = 1 / maxOf(ways[QQ], noise * LEAST_SHARE)
        val known = memory[at + INFORMATION]
        if (known > 0) {
            val gap = ways[Q] - memory[at + MEAN]
            val misfit = gap * gap / (1 / information + 1 / known)
            for (way in 0 until WAYS) {
                ways[way * STRIDE + MISFIT] += misfit * noise
                ways[way * STRIDE + SCORE] += misfit
            }
            freedomBefore++
            pooledMisfit += misfit * noise
            agreements++
        }
        memory[at + MEAN] += information / (known + information) * (ways[Q] - memory[at + MEAN])
        memory[at + INFORMATION] = known + information
        memory[at + VISITS]++
    }

    /**
     * Variance, in the truth of the cell with [slot], of what is the same in each visit and no number of them makes smaller:
     * the moment of coming to rest, and what rounding to steps of [resolution] hides. Eq. (17a).
     */
    fun common(slot: Int, resolution: Double): Double {
        val deviation = sqrt(noise)
        var visits = if (isKnown(slot)) memory[slot * SLOT + VISITS] else 0.0
        if (slot == here && isAtRest()) visits++
        if (slot == before) visits++
        val share = maxOf(1.0, visits) / information(slot) / noise
        val step = maxOf(rate * usualInterval.seconds, LEAST_STEP)
        val early = maxOf(1.0, deviation / step) * noise * deviation / step / 12 * share * share
        return early + hiddenByRounding(noise, resolution)
    }

    /** Information on the truth of the cell with [slot], 0 if it was never reached. */
    fun information(slot: Int): Double {
        var information = if (isKnown(slot)) memory[slot * SLOT + INFORMATION] else 0.0
        val at = best() * STRIDE
        if (slot == here && isAtRest()) information += 1 / ways[at + SS]
        if (slot == before) information += 1 / ways[at + QQ]
        return information
    }

    /** Probability that the truth of the cell with [slot], never reached beyond doubt, was not reached in the last visit. */
    fun movingOn(slot: Int): Double = when {
        slot == here && !isOpen() -> movingOn()
        isKnown(slot) -> 1 - memory[slot * SLOT + RESTING]
        else -> 1.0
    }

    /**
     * The truth of the cell with [slot]: if it was never reached beyond doubt, where the sensor has come to rest if that is
     * likelier than not, or else the middle of its bounds.
     */
    fun truth(slot: Int): Double {
        val information = information(slot)
        if (information == 0.0) {
            val lower = lower(slot)
            val upper = upper(slot)
            if (movingOn(slot) > HALF || lower >= upper) return (lower + upper) / 2
            val last = if (slot == here && !isOpen()) ways[best() * STRIDE + S] else memory[slot * SLOT + MEAN]
            return last.coerceIn(lower, upper)
        }
        var sum = if (isKnown(slot)) memory[slot * SLOT + MEAN] * memory[slot * SLOT + INFORMATION] else 0.0
        val at = best() * STRIDE
        if (slot == here && isAtRest()) sum += ways[at + S] / ways[at + SS]
        if (slot == before) sum += ways[at + Q] / ways[at + QQ]
        return sum / information
    }

    /** Lower bound of a truth never reached. */
    fun lower(slot: Int): Double {
        val way = best()
        val known = if (isKnown(slot)) memory[slot * SLOT + LOWER] - HALF else -HALF
        if (slot != here || !isUpwards(way) || isOpen()) return known
        return maxOf(known, ways[way * STRIDE + S] - CERTAIN * sqrt(ways[way * STRIDE + SS]))
    }

    /** Upper bound of a truth never reached. */
    fun upper(slot: Int): Double {
        val way = best()
        val known = if (isKnown(slot)) HALF - memory[slot * SLOT + UPPER] else HALF
        if (slot != here || isUpwards(way) || isOpen()) return known
        return minOf(known, ways[way * STRIDE + S] + CERTAIN * sqrt(ways[way * STRIDE + SS]))
    }

    private fun isKnown(slot: Int) = (slot + 1) * SLOT <= memory.size

    companion object {
        /** Lower end of the prior; its upper end is as far above 0. */
        const val LEAST = -0.5

        private const val WAYS = 4
        private const val UP = 0
        private const val DOWN = 1
        private const val LEVEL = 2

        private const val STRIDE = 13
        private const val S = 0
        private const val R = 1
        private const val Q = 2
        private const val SS = 3
        private const val SR = 4
        private const val SQ = 5
        private const val RR = 6
        private const val RQ = 7
        private const val QQ = 8
        private const val MISFIT = 9
        private const val SCORE = 10
        private const val SUCCESSION = 11
        private const val INNOVATION = 12
        private val UNKNOWN = intArrayOf(S, Q, SR, SQ, RQ)

        /**
         * Of a cell: truth, information, how far its bounds are from the prior's ends, the probability of having come to rest in
         * the last visit, where that was not beyond doubt, and the visits that its truth is of.
         */
        private const val SLOT = 6
        private const val MEAN = 0
        private const val INFORMATION = 1
        private const val LOWER = 2
        private const val UPPER = 3
        private const val RESTING = 4
        private const val VISITS = 5
        private const val FIRST_SLOTS = 128

        /** Half the width of the prior. */
        private const val HALF = -LEAST

        /** A bound lies so many standard deviations beyond the state that sets it. */
        private const val CERTAIN = 2.0

        /** Largest probability of moving on with which a truth counts as reached: odds of e⁵, as [SensorChoice] asks of models. */
        private const val BEYOND_DOUBT = 0.0067
        private const val LEAST_STEP = 1e-9
        private const val LEAST_SHARE = 1e-6
    }
}
