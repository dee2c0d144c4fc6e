package stillwater.estimate

import kotlin.math.abs

/**
 * How far the misfit of a [ResponseBankFit] is from a quadratic along its ridge, where it is known least: from five
 * filters, the bank's step apart. Core/docs/SelfCalibratingEstimator.md, section "The surface".
 */
internal class MisfitRidge {
    private val bank = ResponseBank()
    private val left = DoubleArray(2 * REACH + 1)

    /** The estimate's variance over what the bank's quadratic says. */
    var tightness: Double = 1.0
        private set

    /** What the quadratic's lowest place is off by as the misfit's third power has it, in the bank's steps. */
    var offset: Double = 0.0
        private set

    /** As if the misfit were quadratic. */
    fun forget() {
        forgetTightness()
        offset = 0.0
    }

    /** At an end of what a sensor can be, where the estimate's variance is that of the distribution cut there. */
    fun forgetTightness() {
        tightness = 1.0
    }

    /** As [other] found. */
    fun becomeLike(other: MisfitRidge) {
        tightness = other.tightness
        offset = other.offset
    }

    /**
     * Goes through [tape] with a sensor of [kind], noise of variance [noise], at five [pairs] of parameters.
     *
     * @param pairs first and second parameter so many steps from the middle along the ridge.
     * @param cost half the misfit over the noise's variance, with the belief: of a misfit and the first parameter.
     */
    suspend fun measure(
        tape: Recording,
        pairs: (steps: Int) -> Pair<Double, Double>,
        kind: ResponseBankKind,
        noise: Double,
        cost: (misfit: Double, first: Double) -> Double,
    ) {
        for (k in left.indices) {
            val (first, second) = pairs(k - REACH)
            bank.resetMiddle(kind, first, second, noise)
            tape.play(bank)
            left[k] = cost(bank.misfit(0), first)
        }
        val near = left[3] - 2 * left[2] + left[1]
        val far = (left[4] - 2 * left[2] + left[0]) / 4
        val third = (left[4] - 2 * left[3] + 2 * left[1] - left[0]) / 2
        forget()
        if (!(near > 0) || !(far > 0)) return
        val ratio = (near / far).coerceIn(1 / MOST_RATIO, MOST_RATIO)
        tightness = ratio * ratio
        offset = minOf(abs(third) / (6 * far), MOST_OFFSET)
    }

    /** Misfit to [tape] of a sensor of [kind] at a pair of parameters, to be compared with another kind's. */
    suspend fun compare(tape: Recording, kind: ResponseBankKind, first: Double, second: Double, noise: Double): Double {
        bank.comparesKinds = true
        bank.resetMiddle(kind, first, second, noise)
        bank.comparesKinds = false
        tape.play(bank)
        return bank.misfit(0)
    }

    private companion object {
        const val REACH = 2
        const val MOST_RATIO = 2.0
        const val MOST_OFFSET = 0.5
    }
}
