package stillwater.estimate

import kotlin.math.exp
import kotlin.math.sqrt

/**
 * Three Kalman filters that differ in nothing but the sensor's time constant: at θ − h, θ and θ + h with θ = ln τ.
 *
 * Each tracks the sensor's state and the truth of the cell the boat is in and of the one before, for a visit alone;
 * when a visit is two cells back its result is pooled with those of the cell's other visits. The sums of squared,
 * scaled innovations of the three make a parabola in θ: its minimum is the time constant that fits best, its curvature
 * how sure that is. A cell's truth at that time constant is interpolated likewise.
 *
 * Everything is in scaled values: readings minus the prior's midpoint, over its width; variances are over the noise's.
 * Derivation: core/docs/SelfCalibratingEstimator.md, whose equations are cited. O(1) a reading; no call allocates once
 * the cells' memory has grown.
 */
internal class LagBank : ReadingPlayer {
    override val filters: Int get() = NODES
    private val states = DoubleArray(NODES * STRIDE)
    private val remapped = DoubleArray(NODES)

    /** The nodes in units of themselves, as [nodeOf] has them, rounding included: of cells last written at them. */
    private val ownPlaces = DoubleArray(NODES)
    private val keeps = DoubleArray(NODES)
    private var keepsFor = Double.NaN
    private var memory = DoubleArray(FIRST_SLOTS * SLOT)
    private var lastSeconds = Double.NaN

    /** Variance of the prior of a cell's truth, over the noise's. */
    private var priorVariance = 1.0
    private var priorInformation = 1.0

    /** θ of the middle filter, ln s. */
    var node: Double = 0.0
        private set

    /** h, distance of the outer filters from the middle one, ln s. */
    var step: Double = 0.0
        private set

    /** The slot of the cell the boat is in; below 0 if it is in none. */
    var current: Int = NONE
        private set

    /** The slot of the cell it was in before; below 0 if it was in none. */
    var previous: Int = NONE
        private set

    /** Readings, and agreements between visits, beyond the numbers fitted to them. */
    var freedom: Double = 0.0
        private set

    /** Sum of the products of successive scaled innovations at the middle node: near 0 where the model holds. */
    var succession: Double = 0.0
        private set
    private var lastInnovation = 0.0

    /** Forgets all and starts at [node] and [step]; [noise] is the variance of the readings' noise, scaled. */
    fun reset(node: Double, step: Double, noise: Double) {
        this.step = step
        moveTo(node)
        priorVariance = 1 / maxOf(noise, LEAST_RATIO)
        priorInformation = 1 / priorVariance
        states.fill(0.0)
        memory.fill(0.0)
        keepsFor = Double.NaN
        current = NONE
        previous = NONE
        freedom = 0.0
        succession = 0.0
        lastInnovation = 0.0
    }

    override fun leave() {
        pool(previous, Q, QQ)
        pool(current, P, PP)
        previous = NONE
        current = NONE
    }

    override fun enter(slot: Int, from: Double, until: Double) {
        val elapsed = until - lastSeconds
        keepFor(elapsed)
        for (i in 0 until NODES) predict(i * STRIDE, keeps[i])
        lastSeconds = until
        if (until > from) {
            keepFor(until - from)
            for (i in 0 until NODES) blur(i * STRIDE, 1 - keeps[i])
        }
        goTo(slot)
    }

    /** Equal slots in a row are one visit. */
    override fun take(slot: Int, seconds: Double, value: Double) {
        if (current == NONE) {
            begin()
            lastSeconds = seconds
            current = slot
        } else if (slot != current) {
            goTo(slot)
        }
        keepFor(seconds - lastSeconds)
        lastSeconds = seconds
        for (i in 0 until NODES) predictAndCorrect(i * STRIDE, keeps[i], value)
        freedom++
    }

    private fun goTo(slot: Int) {
        pool(previous, Q, QQ)
        enter()
        previous = current
        current = slot
    }

    /** What is left after [elapsed] s at each node. */
    private fun keepFor(elapsed: Double) {
        if (elapsed == keepsFor) return
        for (i in 0 until NODES) keeps[i] = exp(-elapsed * exp(-(node + (i - 1) * step)))
        keepsFor = elapsed
    }

    /** Sum of squared innovations over their variances at node [i] of 0, 1, 2. */
    fun misfit(i: Int): Double = states[i * STRIDE + MISFIT]

    /** Half the parabola's downward slope at the middle, per unit of θ, eq. (9). */
    fun slope(): Double = -(misfit(2) - misfit(0)) / (4 * step)

    /** Half the parabola's second derivative, eq. (9): the information on θ over the noise's variance. */
    fun curvature(): Double = (misfit(2) - 2 * misfit(1) + misfit(0)) / (2 * step * step)

    /** The scaled truth of the cell with [slot] at node [i]; eq. (8). */
    fun truth(slot: Int, i: Int): Double {
        val at = slot * SLOT
        var sum = 0.0
        var information = 0.0
        if (visitsPooled(slot)) {
            val place = nodeOf(at, i)
            information = recall(at + INFORMATION, place)
            sum = information * recall(at + MEAN, place)
        }
        if (slot == current) {
            sum += states[i * STRIDE + P] / states[i * STRIDE + PP]
            information += 1 / states[i * STRIDE + PP] - priorInformation
        }
        if (slot == previous) {
            sum += states[i * STRIDE + Q] / states[i * STRIDE + QQ]
            information += 1 / states[i * STRIDE + QQ] - priorInformation
        }
        return sum / (information + priorInformation)
    }

    /** The information on the truth of the cell with [slot] at node [i], over the noise's variance; eq. (8). */
    fun information(slot: Int, i: Int): Double {
        var information = if (visitsPooled(slot)) pooledInformation(slot, i) else 0.0
        if (slot == current) information += 1 / states[i * STRIDE + PP] - priorInformation
        if (slot == previous) information += 1 / states[i * STRIDE + QQ] - priorInformation
        return information + priorInformation
    }

    /** Moves all three nodes by [change] of θ, at most h either way; eq. (10). */
    fun move(change: Double) {
        for (k in 0 until STRIDE) {
            for (i in 0 until NODES) remapped[i] = interpolate(states, k, STRIDE, change / step + i - 1)
            for (i in 0 until NODES) states[i * STRIDE + k] = remapped[i]
        }
        moveTo(node + change)
        keepsFor = Double.NaN
    }

    private fun moveTo(node: Double) {
        this.node = node
        for (i in 0 until NODES) ownPlaces[i] = placeOf(i, node, step)
    }

    private fun visitsPooled(slot: Int) = slot * SLOT < memory.size && memory[slot * SLOT + INFORMATION + 1] > 0

    private fun pooledInformation(slot: Int, i: Int): Double {
        val at = slot * SLOT
        return recall(at + INFORMATION, nodeOf(at, i))
    }

    /** Node [i] in units of the nodes at which the slot at [at] was last written. */
    private fun nodeOf(at: Int, i: Int): Double {
        val from = memory[at + NODE]
        val unit = memory[at + STEP]
        return if (from == node && unit == step) ownPlaces[i] else placeOf(i, from, unit)
    }

    private fun placeOf(i: Int, from: Double, unit: Double) = (node + (i - 1) * step - from) / unit

    private fun recall(at: Int, place: Double) = interpolate(memory, at, 1, place)

    private fun begin() {
        for (i in 0 until NODES) {
            val at = i * STRIDE
            states.fill(0.0, at, at + MISFIT)
            states[at + SS] = priorVariance
            states[at + PP] = priorVariance
            states[at + QQ] = priorVariance
        }
        // Two numbers to fit: the sensor's state and the cell's truth.
        freedom -= 2
        lastInnovation = 0.0
    }

    private fun enter() {
        for (i in 0 until NODES) {
            val at = i * STRIDE
            states[at + Q] = states[at + P]
            states[at + QQ] = states[at + PP]
            states[at + SQ] = states[at + SP]
            states[at + PQ] = 0.0
            states[at + P] = 0.0
            states[at + SP] = 0.0
            states[at + PP] = priorVariance
        }
        freedom--
    }

    /** Water of the prior's variance, unknown, has brought the sensor on by [gain] at the node whose state starts at [at]. */
    private fun blur(at: Int, gain: Double) {
        val more = gain * gain * priorVariance
        states[at + SS] += more
        // As much of a reading as it takes to find out.
        if (at == STRIDE) freedom -= more / (states[at + SS] + 1)
    }

    /** Eqs. (3) to (5) at one node, whose state starts at [at] and of which [keep] is left after the elapsed time. */
    private fun predictAndCorrect(at: Int, keep: Double, value: Double) {
        predict(at, keep)
        correct(at, value)
    }

    private fun predict(at: Int, keep: Double) {
        val f = states
        val gain = 1 - keep
        // s ← s + g (ψ − s)
        f[at + S] += gain * (f[at + P] - f[at + S])
        f[at + SQ] = keep * f[at + SQ] + gain * f[at + PQ]
        f[at + SS] = keep * keep * f[at + SS] + 2 * gain * keep * f[at + SP] + gain * gain * f[at + PP]
        f[at + SP] = keep * f[at + SP] + gain * f[at + PP]
    }

    private fun correct(at: Int, value: Double) {
        val f = states
        val innovation = value - f[at + S]
        // S = P_ss + 1, K = P_·s / S; one division instead of four.
        val variance = f[at + SS] + 1
        val inverse = 1 / variance
        val forState = f[at + SS] * inverse
        val forTruth = f[at + SP] * inverse
        val forPrevious = f[at + SQ] * inverse
        f[at + MISFIT] += innovation * innovation * inverse
        f[at + S] += forState * innovation
        f[at + P] += forTruth * innovation
        f[at + Q] += forPrevious * innovation
        f[at + PP] -= forTruth * f[at + SP]
        f[at + PQ] -= forTruth * f[at + SQ]
        f[at + QQ] -= forPrevious * f[at + SQ]
        f[at + SP] -= forTruth * f[at + SS]
        f[at + SQ] -= forPrevious * f[at + SS]
        f[at + SS] -= forState * f[at + SS]
        // Asked of the middle filter only.
        if (at != STRIDE) return
        val scaled = innovation / sqrt(variance)
        succession += scaled * lastInnovation
        lastInnovation = scaled
    }

    /** Pools a visit, whose truth and variance are at [mean] and [variance] in the state, with the slot's others, if any. */
    private fun pool(slot: Int, mean: Int, variance: Int) {
        if (slot < 0) return
        while (memory.size < (slot + 1) * SLOT) memory = memory.copyOf(2 * memory.size)
        val at = slot * SLOT
        val isRevisit = visitsPooled(slot)
        if (isRevisit) rewrite(at)
        for (i in 0 until NODES) {
            val spread = states[i * STRIDE + variance]
            // What the visit itself says, the prior taken out: eq. (6).
            val information = maxOf(1 / spread - 1 / priorVariance, LEAST_INFORMATION)
            val truth = states[i * STRIDE + mean] / spread / information
            val before = memory[at + INFORMATION + i]
            if (isRevisit) {
                // Two visits that disagree speak against the time constant, eq. (7).
                val gap = truth - memory[at + MEAN + i]
                states[i * STRIDE + MISFIT] += gap * gap / (1 / information + 1 / before)
            }
            val after = before + information
            memory[at + MEAN + i] += information / after * (truth - memory[at + MEAN + i])
            memory[at + INFORMATION + i] = after
        }
        if (isRevisit) freedom++
        memory[at + NODE] = node
        memory[at + STEP] = step
    }

    /** Rewrites the slot at [at] for the present nodes. */
    private fun rewrite(at: Int) {
        if (memory[at + NODE] == node && memory[at + STEP] == step) return
        rewrite(at, MEAN)
        rewrite(at, INFORMATION)
    }

    private fun rewrite(at: Int, start: Int) {
        for (i in 0 until NODES) remapped[i] = recall(at + start, nodeOf(at, i))
        for (i in 0 until NODES) memory[at + start + i] = remapped[i]
    }

    companion object {
        /** No slot. */
        const val NONE = -1

        /** Smallest variance of the noise over the prior's that the numbers' precision allows. */
        const val LEAST_RATIO = 1e-10

        private const val NODES = 3

        /** Fields of a filter's state: sensor, truth here, truth in the cell before, their covariances, the misfit. */
        private const val STRIDE = 10
        private const val S = 0
        private const val P = 1
        private const val Q = 2
        private const val SS = 3
        private const val SP = 4
        private const val PP = 5
        private const val SQ = 6
        private const val PQ = 7
        private const val QQ = 8
        private const val MISFIT = 9

        /** Fields of a cell's memory: truth and information at the three nodes, and where these were. */
        private const val SLOT = 8
        private const val MEAN = 0
        private const val INFORMATION = 3
        private const val NODE = 6
        private const val STEP = 7
        private const val FIRST_SLOTS = 128
        private const val LEAST_INFORMATION = 1e-9

        /** The quadratic through three numbers, [stride] apart from [at] on, at [place] of nodes −1, 0, 1. */
        private fun interpolate(numbers: DoubleArray, at: Int, stride: Int, place: Double): Double {
            val low = numbers[at]
            val middle = numbers[at + stride]
            val high = numbers[at + 2 * stride]
            return middle + place * ((high - low) / 2 + place * ((high + low) / 2 - middle))
        }

        /** As [interpolate], for a caller's three numbers. */
        fun interpolate(low: Double, middle: Double, high: Double, place: Double): Double =
            middle + place * ((high - low) / 2 + place * ((high + low) / 2 - middle))
    }
}
