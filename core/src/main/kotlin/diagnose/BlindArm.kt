package stillwater.diagnose

import kotlin.math.abs

/** Steps in which the end of the arm is found. */
private const val ARM_STEPS = 4

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
    repeat(ARM_STEPS) {
        val behind = behind(best) ?: return best
        if (abs(behind - best.modes.behind) < NEAR * scales.ordinarySpeed * best.model.series.period) return best
        val next = movedTo(behind, best) ?: return best
        if (next.score <= best.score) return best
        best = next
    }
    return best
}

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
private fun BlindSearch.movedTo(behind: Double, state: BlindState): BlindState? {
    val modes = state.modes.onArm(behind, state.variances) ?: return null
    val noise = state.fit.design.noise
    val begun = settled(state.model.terms, state.numbers, noise, modes.first, BlindSearch.FIRST_ROUNDS, modes)
    return climbed(requieted(climbed(begun)))
}
