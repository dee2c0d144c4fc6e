package stillwater.estimate

import kotlin.math.abs
import kotlin.math.ceil
import kotlin.math.exp
import kotlin.math.floor
import kotlin.math.sqrt

/** The first-order lag as a [SensorFit]: its parameter is θ = ln τ. */
internal class LagFit(belief: SelfCalibratingSettings) : SensorFit(belief) {
    private val bank = LagBank()
    private val mean = belief.mean
    private val priorInformation = 1 / (belief.spread * belief.spread)
    private var follows = false

    /** θ̂ − θ of the bank's middle. */
    private var offset = 0.0

    /** Inverse variance of θ̂. */
    private var information = priorInformation

    // The cell whose truth was last asked for, and its truths at the three nodes.
    private var asked = LagBank.NONE
    private var low = 0.0
    private var middle = 0.0
    private var high = 0.0

    // The search: the least cost so far, whose it is, and whether the play under way can no longer come below it.
    private var least = 0.0
    private var leastIndex = 0
    private val isBeaten = { cost(0) > least && cost(1) > least && cost(2) > least }

    init {
        bank.reset(mean, WIDEST_STEP, noiseVariance)
    }

    /** The most likely time constant τ, s. */
    val timeConstant: Double get() = upToDate().let { exp(bank.node + offset) }

    /** Standard deviation of ln τ. */
    val relativeUncertainty: Double get() = upToDate().let { 1 / sqrt(information) }

    override val here: Int get() = maxOf(bank.current, LagBank.NONE)
    override val before: Int get() = maxOf(bank.previous, LagBank.NONE)

    /** From now on there is no tape to start over from: the nodes follow the time constant. */
    fun follow() {
        follows = true
    }

    /** As [other] is, but for what it knows of the cells. */
    fun becomeLike(other: LagFit) {
        bank.reset(other.bank.node, other.bank.step, other.noiseVariance)
        offset = other.offset
        information = other.information
        judgeAs(other)
    }

    override fun enter(slot: Int, from: Double, until: Double) {
        moveNodes(slot)
        bank.enter(slot, from, until)
    }

    override fun add(slot: Int, seconds: Double, value: Double) {
        moveNodes(slot)
        bank.take(slot, seconds, value)
    }

    /** The nodes follow the time constant, on entering the cell with [slot]. */
    private fun moveNodes(slot: Int) {
        val moves = follows && slot != bank.current && abs(offset) > bank.step / 2
        if (moves) bank.move(offset.coerceIn(-bank.step, bank.step))
    }

    override fun end() = bank.leave()

    /** Starts over with the time constant that explains the tape best: a coarse search, then Newton's steps. */
    override suspend fun calibrate(tape: Recording) {
        var best = search(tape)
        var step = WIDEST_STEP
        repeat(MOST_ROUNDS) {
            play(tape, best, step)
            learn()
            val wanted = (2 * relativeUncertainty).coerceIn(NARROWEST_STEP, WIDEST_STEP)
            val change = offset.coerceIn(-step, step)
            if (abs(change) <= 0.1 * relativeUncertainty && step <= 2 * wanted) return
            best += change
            step = abs(change).coerceIn(wanted, WIDEST_STEP)
        }
        play(tape, best, step)
        learn()
    }

    /**
     * θ of the least cost over a coarse grid, of equal ones the lowest. What is nearest to the last time constant comes
     * first: the misfit only grows on the way, so that most of the others can be left early. It changes nothing else.
     */
    suspend fun search(tape: Recording): Double {
        var best = bank.node
        val reach = ceil(SEARCHED * belief.spread / (3 * WIDEST_STEP)).toInt()
        // What is no number becomes 0.
        val nearest = floor((best - mean) / (3 * WIDEST_STEP) + HALF).toInt().coerceIn(-reach, reach)
        least = Double.POSITIVE_INFINITY
        leastIndex = Int.MIN_VALUE
        for (turn in -reach - 1..reach) {
            val k = if (turn < -reach) nearest else turn
            if (k == nearest && turn >= -reach) continue
            play(tape, mean + 3 * k * WIDEST_STEP, WIDEST_STEP, isBeaten)
            for (i in 0..2) {
                val cost = cost(i)
                val index = 3 * k + i
                if (cost < least || (cost == least && index < leastIndex)) {
                    least = cost
                    leastIndex = index
                    best = node(i)
                }
            }
        }
        return best
    }

    private fun node(i: Int) = bank.node + (i - 1) * bank.step

    private fun cost(i: Int): Double {
        val off = node(i) - mean
        return bank.misfit(i) / noiseVariance + off * off * priorInformation
    }

    private suspend fun play(tape: Recording, node: Double, step: Double, isBeaten: () -> Boolean = Recording.NEVER) {
        bank.reset(node, step, noiseVariance)
        tape.play(bank, isBeaten)
    }

    /** Reads time constant and noise off the bank's parabola, eqs. (9) to (11). */
    override fun readOff() {
        val curvature = maxOf(0.0, bank.curvature())
        val slope = bank.slope() / settledNoise + (mean - bank.node) * priorInformation
        information = curvature / settledNoise + priorInformation
        offset = (slope / information).coerceIn(-FARTHEST_OFFSET * bank.step, FARTHEST_OFFSET * bank.step)
        val place = offset / bank.step
        val left = LagBank.interpolate(bank.misfit(0), bank.misfit(1), bank.misfit(2), place)
        judge(left, bank.freedom, bank.succession)
    }

    override fun truth(slot: Int): Double {
        upToDate()
        asked = slot
        low = bank.truth(slot, 0)
        middle = bank.truth(slot, 1)
        high = bank.truth(slot, 2)
        return LagBank.interpolate(low, middle, high, offset / bank.step)
    }

    /** Eq. (12). */
    override fun variance(): Double {
        val bend = high - 2 * middle + low
        val byTheta = ((high - low) / 2 + offset / bank.step * bend) / bank.step
        return noiseVariance / bank.information(asked, 1) + byTheta * byTheta / information
    }

    private companion object {
        /** The search reaches so many standard deviations of the belief about ln τ either way. */
        const val SEARCHED = 1.5

        /** Distances of the bank's nodes: a parabola is good over the widest, and numbers over the narrowest. */
        const val WIDEST_STEP = 0.15
        const val NARROWEST_STEP = 1e-3
        const val FARTHEST_OFFSET = 2.0
        const val MOST_ROUNDS = 8
        const val HALF = 0.5
    }
}
