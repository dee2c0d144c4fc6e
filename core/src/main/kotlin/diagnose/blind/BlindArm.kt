package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.response.Term
import stillwater.diagnose.water.WaterModes
import kotlin.math.abs

/** Steps in which the end of the arm is found. */
private const val ARM_STEPS = 5

/** Part of a step, over the one before it, of which no end is foretold. */
private const val MOST_LEFT = 0.8

/** Rows' way within which the end of the arm is found. */
private const val NEAR = 0.05

/**
 * [state], whose sensor is off the fixes by a way, with the sensor on a rigid arm, whose end leaves the way in turns; the
 * same where that is no likelier.
 *
 * The water is told at the end of the arm: what it is there is not known along the way.
 */
internal fun BlindSearch.onArm(state: BlindState): BlindState {
    var best = state
    var before: BlindState? = null
    repeat(ARM_STEPS) {
        val behind = behind(best) ?: return best
        if (abs(behind - best.modes.behind) < NEAR * scales.ordinarySpeed * best.model.series.period) return best
        val farther = before?.let { farther(it, best) }
        val next = farther?.let { movedTo(it, best) }?.takeIf { it.score > best.score } ?: movedTo(behind, best)
        if (next == null || next.score <= best.score) return best
        before = best
        best = next
    }
    return best
}

/**
 * What a model gains by waves that are found anew, and not by where they are: twice a log-likelihood, 0 at least, that
 * [arm] has over [way], the same sensor on the boat's way, for nothing.
 */
internal fun BlindSearch.anew(way: BlindState, arm: BlindState): Double =
    if (arm === way) 0.0 else maxOf((movedTo(0.0, way)?.score ?: way.score) - way.score, 0.0)

/**
 * Where the arm ends by the secant through what it lacked in [before] and in [now], m: the water at hand holds the sensor
 * back, so that each step is but a part of the way. Null where that is no way on.
 */
private fun farther(before: BlindState, now: BlindState): Double? {
    val lacked = checkNotNull(behind(before)) - before.modes.behind
    val lacks = checkNotNull(behind(now)) - now.modes.behind
    val part = lacks / lacked
    return (now.modes.behind + lacks / (1 - part)).takeIf { part in 0.0..MOST_LEFT }
}

/** Whether the sensor of [state] is on an arm for certain: by [gain] of twice the log-likelihood more than on the way. */
internal fun BlindSearch.isOnArm(state: BlindState, gain: Double): Boolean =
    state.modes.behind != 0.0 && movedTo(0.0, state)?.let { state.score > it.score + gain } == true

/** [state], whose sensor is on a rigid arm, or the same with one that follows the boat's way, if that is likelier. */
internal fun BlindSearch.onArmOrWay(state: BlindState): BlindState {
    if (state.modes.behind == 0.0) return state
    val arm = onArm(state)
    val way = movedTo(0.0, state)
    return if (way != null && way.score > arm.score) way else arm
}

private fun behind(state: BlindState): Double? =
    state.model.terms.firstOrNull { it.cause == Cause.POSITION_OFFSET }?.let { state.numbers[state.model.slot(it)] }

/** [state] with the water told so far [behind] the fixes, m, and what suits that; null where the track is a line. */
private fun BlindSearch.movedTo(behind: Double, state: BlindState): BlindState? =
    begunAt(behind, state, state.model.terms, state.numbers)?.let { fullySuited(it) }

/**
 * [state], begun with other [terms] and [numbers], with the water told so far [behind] the fixes, m; null where the track
 * is a line.
 */
internal fun BlindSearch.begunAt(
    behind: Double,
    state: BlindState,
    terms: List<Term>,
    numbers: DoubleArray,
): BlindState? {
    val modes = state.modes.onArm(behind, state.variances) ?: return null
    return begunIn(modes, state, terms, numbers)
}

/** [state], begun with other [terms] and [numbers], in the water of [modes], found anew. */
internal fun BlindSearch.begunIn(
    modes: WaterModes,
    state: BlindState,
    terms: List<Term> = state.model.terms,
    numbers: DoubleArray = state.numbers,
): BlindState = settled(terms, numbers, state.fit.design.noise, modes.first, BlindSearch.FIRST_ROUNDS, modes)
