package stillwater.diagnose.reference

import stillwater.diagnose.Cause
import stillwater.diagnose.evidence.Spikes
import stillwater.diagnose.noise.CorrelatedNoise
import stillwater.diagnose.noise.Shocks
import stillwater.diagnose.response.Fitting
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Term
import stillwater.diagnose.response.UnknownTruth

/** Times that a fit and the fade of what gaps leave are found in turn. */
private const val TURNS = 6

/** Twice the gain in log-likelihood from which they are found once more. */
private const val ENOUGH = 0.1

/** Shortest lag that fades, in rows. */
private const val SHORTEST = 0.02

/** Robust deviation of what this fit leaves, whitened, sensor units. */
private val ModelFit.spread: Double get() = Spikes.spread(model.series.shown(whitened))

/** Shocks to the readings of a sensor as this fit has it, of what [unknown] leaves open; null for none. */
internal fun ModelFit.shocks(unknown: UnknownTruth, isHeld: Boolean): Shocks? =
    model.shocks(numbers, spread, unknown, isHeld)

private fun ResponseModel.shocks(
    numbers: DoubleArray,
    spread: Double,
    unknown: UnknownTruth,
    isHeld: Boolean,
): Shocks? {
    fun time(cause: Cause) = slotOrNull(Term(cause))?.let { numbers[it] } ?: 0.0
    return unknown.shocks(
        lags(numbers).also { for (i in it.indices) it[i] = maxOf(it[i], SHORTEST * series.period) },
        numbers[ResponseModel.GAIN],
        spread,
        isHeld,
        maxOf(time(Cause.DEAD_TIME), 0.0),
        time(Cause.SECOND_ORDER_RESPONSE),
        time(Cause.POSITION_OFFSET).takeIf { it != 0.0 }?.let { scales.swing?.doubts(it) },
    )
}

/**
 * This model where what gaps leave of the sensor's state fades as [numbers] say, and a probe that is off the boat swings out in
 * turns, under noise as [base] leaves; this one where there is neither.
 */
internal fun ResponseModel.fadingAs(numbers: DoubleArray, base: ModelFit): ResponseModel {
    val unknown = scales.unknown ?: return this
    if (unknown.isGap.none { it } && slotOrNull(Term(Cause.POSITION_OFFSET)) == null) return this
    val shocks = shocks(numbers, base.spread, unknown, steps.isHeld)
    return ResponseModel(series, terms, steps, scales.shaken(unknown, shocks))
}

/** Noise like [noise] of readings of this model. */
internal fun ResponseModel.noise(noise: CorrelatedNoise, rows: BooleanArray): CorrelatedNoise =
    if (noise.shocks === scales.shocks) {
        noise
    } else {
        CorrelatedNoise(series.times, noise.share, noise.time, rows, scales.shocks)
    }

/**
 * This fit where what gaps leave of the sensor's state, often hundreds of deviations of the noise, fades as its own numbers
 * say, and turns take an arm as long as they say off the way: fitted to [rows] with noise that wanders within [longest] s, in
 * turn with these, as long as that makes it likelier.
 */
internal fun ModelFit.withOwnFade(rows: BooleanArray, longest: Double): ModelFit {
    var best = this
    repeat(TURNS) {
        val own = model.fadingAs(best.numbers, best)
        if (own === model) return best
        val next = Fitting.fit(own, best.numbers, free, rows, longest, guess = own.noise(best.noise, rows))
        val gain = next.score - best.score
        if (gain > 0) best = next
        if (!(gain > ENOUGH)) return best
    }
    return best
}
