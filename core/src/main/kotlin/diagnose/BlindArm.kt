package stillwater.diagnose

import kotlin.math.abs
import kotlin.math.ln

/** Steps in which the end of the arm is found. */
private const val ARM_STEPS = 5

/** Part of a step, over the one before it, of which no end is foretold. */
private const val MOST_LEFT = 0.8

/** Rows' way within which the end of the arm is found. */
private const val NEAR = 0.05

/** Lengths of arms over that of the shortest wave. */
private val FAR_ARMS = doubleArrayOf(0.25, 0.5, 0.75, 1.0, 1.5).toList()

/** Rows of a log in which ten arms are fitted in about a second. */
private const val MOST_ROWS = 2000

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

/**
 * A sensor on an arm, whose end turns may take so far off the boat's way that nothing of it shows along that.
 *
 * @property state the model with it. @property anew what finding the waves anew is worth by itself.
 * @property searched what the best of so many arms gains by chance. Both are twice log-likelihoods.
 */
internal class FarArm(val state: BlindState, val anew: Double, val searched: Double)

/**
 * The likeliest of some arms under [state]; null where none is likelier.
 *
 * Of an arm that nobody knows of passes contradict each other everywhere, and only noise that wanders as much as any may
 * explains that; so it is asked only where there is such. How good an arm is shows once the lag and the noise suit it:
 * all are fitted. Not in long logs, where that takes too long.
 */
internal fun BlindSearch.farArm(state: BlindState): FarArm? {
    val isWandering = state.fit.design.noise.noise.share >= BlindSearch.SHARES.last()
    if (state.modes.lengths.isEmpty() || !isWandering || state.residuals.size > MOST_ROWS) return null
    val term = Term(Cause.POSITION_OFFSET)
    val model = model(state.model.terms + term, state.modes, state.water)
    val arms = FAR_ARMS.flatMap { listOf(it, -it) }.map { it * state.modes.shortest }
    val found = loops.all(listOf(0.0) + arms) { behind ->
        val numbers = model.carried(state.model, state.numbers).also { it[model.slot(term)] = behind }
        checkNotNull(movedTo(behind, state, model.terms, numbers))
    }
    val best = found.maxBy { it.score }
    if (best === found[0]) return null
    return FarArm(onArm(best), maxOf(found[0].score - state.score, 0.0), 2 * ln(arms.size.toDouble()))
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

/**
 * [state], or what it is begun from with other [terms] and [numbers], with the water told so far [behind] the fixes, m, and
 * what suits that; null where the track is a line.
 */
private fun BlindSearch.movedTo(
    behind: Double,
    state: BlindState,
    terms: List<Term> = state.model.terms,
    numbers: DoubleArray = state.numbers,
): BlindState? {
    val modes = state.modes.onArm(behind, state.variances) ?: return null
    val noise = state.fit.design.noise
    return fullySuited(settled(terms, numbers, noise, modes.first, BlindSearch.FIRST_ROUNDS, modes))
}
