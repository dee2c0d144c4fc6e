package stillwater.diagnose.reference

import stillwater.diagnose.Cause
import stillwater.diagnose.evidence.Spikes
import stillwater.diagnose.noise.CorrelatedNoise
import stillwater.diagnose.response.Doubt
import stillwater.diagnose.response.Fitting
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Scales
import stillwater.diagnose.response.Shaken
import stillwater.diagnose.response.Term
import stillwater.diagnose.response.UnknownTruth

/** Times that a fit and the fade of what gaps leave are found in turn. */
private const val TURNS = 6

/** Twice the gain in log-likelihood from which they are found once more. */
private const val ENOUGH = 0.1

/** Shortest lag that fades, in rows. */
private const val SHORTEST = 0.02

/** Robust deviation of what this fit leaves, whitened, sensor units. */
internal val ModelFit.spread: Double get() = Spikes.spread(model.series.shown(whitened))

/** What of [calm] such fits have whose lag and noise are like this one's, where the truth is held over each step or not ([isHeld]). */
internal fun ModelFit.scales(calm: Scales, unknown: UnknownTruth, isHeld: Boolean): Scales {
    val doubt = if (isHeld) Doubt() else model.scales.doubt
    return calm.shaken(unknown, unknown.shocks(model.shaken(numbers, isHeld), spread, doubt), doubt)
}

/** The sensor that this model at [numbers] is, where the truth is held over each step or not ([isHeld]). */
internal fun ResponseModel.shaken(numbers: DoubleArray, isHeld: Boolean = steps.isHeld): Shaken {
    fun time(cause: Cause) = slotOrNull(Term(cause))?.let { numbers[it] } ?: 0.0
    return Shaken(
        lags(numbers).also { for (i in it.indices) it[i] = maxOf(it[i], SHORTEST * series.period) },
        numbers[ResponseModel.GAIN],
        isHeld,
        maxOf(time(Cause.DEAD_TIME), 0.0),
        time(Cause.SECOND_ORDER_RESPONSE),
        time(Cause.POSITION_OFFSET).takeIf { it != 0.0 }?.let { scales.swing?.doubts(it) },
        beyond(numbers),
    )
}

/**
 * This model where what gaps leave of the sensor's state fades as [numbers] say, a probe that is off the boat swings out in turns,
 * and [doubt] is taken, under noise as [base] leaves; this one where none of it is there.
 */
internal fun ResponseModel.fadingAs(
    numbers: DoubleArray,
    base: ModelFit,
    doubt: Doubt = doubt(numbers, base),
): ResponseModel {
    val unknown = scales.unknown ?: return this
    val isPlain = doubt == Doubt() && scales.doubt == doubt
    if (isPlain && unknown.isGap.none { it } && slotOrNull(Term(Cause.POSITION_OFFSET)) == null) return this
    return ResponseModel(
        series,
        terms,
        steps,
        scales.shaken(unknown, unknown.shocks(shaken(numbers), base.spread, doubt), doubt),
    )
}

/** What is in doubt for this model at [numbers], as far as [base] says, which is another one. */
private fun ResponseModel.doubt(numbers: DoubleArray, base: ModelFit): Doubt {
    val unknown = scales.unknown ?: return Doubt()
    val known = base.model.scales.doubt
    if (known.between != null || !DoubtSearch.isApart(this, numbers, base.spread, unknown)) return known
    return known.copy(between = DoubtSearch.FIRST)
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
 * say, turns take an arm as long as they say off the way, and as much is in doubt of the truth as is likeliest: fitted to [rows]
 * with noise that wanders within [longest] s, in turn with these, as long as that makes it likelier.
 */
internal fun ModelFit.withOwnFade(rows: BooleanArray, longest: Double): ModelFit {
    var best = this
    repeat(TURNS) {
        val unknown = model.scales.unknown ?: return best
        val own = best.model.fadingAs(best.numbers, best, DoubtSearch(best, unknown, longest).likeliest())
        if (own === best.model) return best
        val next = Fitting.fit(own, best.numbers, free, rows, longest, guess = own.noise(best.noise, rows))
        val gain = next.score - best.score
        if (gain > 0) best = next
        if (!(gain > ENOUGH)) return best
    }
    return best
}
