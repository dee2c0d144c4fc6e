package stillwater.estimate

import kotlin.math.exp
import kotlin.math.sqrt

/**
 * The filters of a [ResponseBank]: one lag or two in a row, the truth here and in the cell before, and their covariances.
 *
 * Of a single lag there is no first: what is said of it here is neither kept nor used.
 */
internal class ResponseFilter {
    private val states = DoubleArray(2 * ResponseBank.NODES * STRIDE)
    private val rates = DoubleArray(4 * ResponseBank.NODES)
    private val keeps = DoubleArray(4 * ResponseBank.NODES)
    private val keptFor = DoubleArray(2 * ResponseBank.NODES)
    private var priorVariance = 1.0
    private var isSingle = false

    private fun at(i: Int, branch: Int) = (2 * i + branch) * STRIDE

    /** Time constants of both lags, s; the second is not used where there is one. */
    fun set(i: Int, branch: Int, timeConstant: Double, secondLag: Double) {
        rates[2 * (2 * i + branch)] = 1 / timeConstant
        rates[2 * (2 * i + branch) + 1] = 1 / secondLag
        keptFor[2 * i + branch] = Double.NaN
    }

    fun clear(lags: Int, priorVariance: Double) {
        isSingle = lags == 1
        this.priorVariance = priorVariance
        states.fill(0.0)
    }

    fun misfit(i: Int, branch: Int) = states[at(i, branch) + MISFIT]

    fun succession(branch: Int) = states[at(0, branch) + SUCCESSION]

    fun truth(i: Int, branch: Int) = states[at(i, branch) + P]

    fun variance(i: Int, branch: Int) = states[at(i, branch) + PP]

    fun truthBefore(i: Int, branch: Int) = states[at(i, branch) + Q]

    fun varianceBefore(i: Int, branch: Int) = states[at(i, branch) + QQ]

    fun state(i: Int, branch: Int) = states[at(i, branch) + S]

    fun addMisfit(i: Int, misfit: Double) {
        states[at(i, 0) + MISFIT] += misfit
        states[at(i, 1) + MISFIT] += misfit
    }

    /** Both branches go on from [branch]. */
    fun choose(i: Int, branch: Int) {
        states.copyInto(states, at(i, 1 - branch), at(i, branch), at(i, branch) + STRIDE)
    }

    /** Sensor and water unknown. */
    fun begin(i: Int) {
        for (branch in 0..1) {
            val at = at(i, branch)
            states.fill(0.0, at, at + MISFIT)
            states[at + AA] = priorVariance
            states[at + SS] = priorVariance
            states[at + PP] = priorVariance
            states[at + QQ] = priorVariance
            states[at + INNOVATION] = 0.0
        }
    }

    fun enter(i: Int) {
        for (branch in 0..1) {
            val at = at(i, branch)
            states[at + Q] = states[at + P]
            states[at + QQ] = states[at + PP]
            states[at + AQ] = states[at + AP]
            states[at + SQ] = states[at + SP]
            states[at + PQ] = 0.0
            states[at + P] = 0.0
            states[at + AP] = 0.0
            states[at + SP] = 0.0
            states[at + PP] = priorVariance
        }
    }

    fun predict(i: Int, branch: Int, elapsed: Double) {
        val number = 2 * i + branch
        if (elapsed != keptFor[number]) {
            keeps[2 * number] = exp(-elapsed * rates[2 * number])
            if (!isSingle) keeps[2 * number + 1] = exp(-elapsed * rates[2 * number + 1])
            keptFor[number] = elapsed
        }
        val at = at(i, branch)
        if (isSingle) predictSingle(at, keeps[2 * number]) else predict(at, keeps[2 * number], keeps[2 * number + 1])
    }

    /** As much of a reading as it takes to find out what the last [blur] of the first filter left open. */
    var blurred = 0.0
        private set

    /** What the water was during the last [predict] is off the cell's by something unknown, of [variance]. */
    fun blur(i: Int, branch: Int, variance: Double) {
        val number = 2 * i + branch
        val at = at(i, branch)
        val f = states
        val gain = 1 - keeps[2 * number]
        val shown = if (isSingle) gain else gain * (1 - keeps[2 * number + 1])
        if (!isSingle) {
            f[at + AA] += gain * gain * variance
            f[at + AS] += gain * shown * variance
        }
        val more = shown * shown * variance
        f[at + SS] += more
        blurred = more / (f[at + SS] + 1)
    }

    private fun predictSingle(at: Int, keep: Double) {
        val f = states
        val gain = 1 - keep
        // s ← s + g (ψ − s)
        f[at + S] += gain * (f[at + P] - f[at + S])
        f[at + SQ] = keep * f[at + SQ] + gain * f[at + PQ]
        f[at + SS] = keep * keep * f[at + SS] + 2 * keep * gain * f[at + SP] + gain * gain * f[at + PP]
        f[at + SP] = keep * f[at + SP] + gain * f[at + PP]
    }

    private fun predict(at: Int, keep: Double, hold: Double) {
        val f = states
        val gain = 1 - keep
        // a ← a + g (ψ − a)
        f[at + A] += gain * (f[at + P] - f[at + A])
        f[at + AA] = keep * keep * f[at + AA] + 2 * keep * gain * f[at + AP] + gain * gain * f[at + PP]
        val cross = keep * f[at + AS] + gain * f[at + SP]
        f[at + AP] = keep * f[at + AP] + gain * f[at + PP]
        f[at + AQ] = keep * f[at + AQ] + gain * f[at + PQ]
        // s ← s + g′ (a − s)
        val follow = 1 - hold
        f[at + S] += follow * (f[at + A] - f[at + S])
        f[at + SS] = hold * hold * f[at + SS] + 2 * hold * follow * cross + follow * follow * f[at + AA]
        f[at + AS] = hold * cross + follow * f[at + AA]
        f[at + SP] = hold * f[at + SP] + follow * f[at + AP]
        f[at + SQ] = hold * f[at + SQ] + follow * f[at + AQ]
    }

    fun correct(i: Int, branch: Int, value: Double) {
        val f = states
        val at = at(i, branch)
        val innovation = value - f[at + S]
        val variance = f[at + SS] + 1
        val s = f[at + SS]
        val p = f[at + SP]
        val q = f[at + SQ]
        // One division in place of eleven.
        val inverse = 1 / variance
        val share = innovation * inverse
        f[at + MISFIT] += innovation * share
        f[at + S] += s * share
        f[at + P] += p * share
        f[at + Q] += q * share
        if (!isSingle) correctFirst(at, share, inverse)
        val forS = s * inverse
        f[at + SS] -= forS * s
        f[at + SP] -= forS * p
        f[at + SQ] -= forS * q
        val forP = p * inverse
        f[at + PP] -= forP * p
        f[at + PQ] -= forP * q
        f[at + QQ] -= q * inverse * q
        // Asked of the middle filter only.
        if (i != 0) return
        val scaled = innovation / sqrt(variance)
        f[at + SUCCESSION] += scaled * f[at + INNOVATION]
        f[at + INNOVATION] = scaled
    }

    /** The lag that the other one follows, before anything else is corrected but values. */
    private fun correctFirst(at: Int, share: Double, inverse: Double) {
        val f = states
        val a = f[at + AS]
        val forA = a * inverse
        f[at + A] += a * share
        f[at + AA] -= forA * a
        f[at + AS] -= forA * f[at + SS]
        f[at + AP] -= forA * f[at + SP]
        f[at + AQ] -= forA * f[at + SQ]
    }

    private companion object {
        const val STRIDE = 17
        const val A = 0
        const val S = 1
        const val P = 2
        const val Q = 3
        const val AA = 4
        const val AS = 5
        const val AP = 6
        const val AQ = 7
        const val SS = 8
        const val SP = 9
        const val SQ = 10
        const val PP = 11
        const val PQ = 12
        const val QQ = 13
        const val MISFIT = 14
        const val SUCCESSION = 15
        const val INNOVATION = 16
    }
}
