package stillwater.survey

import kotlin.math.abs

/**
 * A mean with its standard error.
 *
 * @property mean the mean. @property standardError by bootstrap over legs, in blocks of [LegComparison.BLOCK]; NaN where
 *   there are no more legs than that.
 */
data class Estimate(val mean: Double, val standardError: Double)

/**
 * How far one leg is from its neighbours.
 *
 * @property number the leg's place among all legs, from 1.
 * @property opposite mean absolute difference to the mean of the legs before and after it, sensor units.
 * @property same the same against the legs two before and two after it, which run its own way; NaN where one lacks.
 */
data class LegScore(val number: Int, val opposite: Double, val same: Double)

/**
 * The shift in time that makes opposite passes agree best; a diagnostic, not a sensor model.
 *
 * @property seconds readings are best put where the boat was so many s earlier; negative for later.
 * @property low lower end of the 95 % bootstrap interval, s, half a step of [shifts] beyond the lowest that was found,
 *   because only these are tried. @property high upper end, s.
 * @property mismatch the mismatch that is left, sensor units.
 * @property gain what of the mismatch went, leg by leg, sensor units.
 * @property legs number of legs compared.
 * @property limit shifts up to this were tried either way, s.
 * @property shifts shifts tried, s. Not modified.
 * @property curve mean mismatch at each of [shifts], sensor units. Not modified.
 */
class LagShift(
    val seconds: Double,
    val low: Double,
    val high: Double,
    val mismatch: Double,
    val gain: Estimate,
    val legs: Int,
    val limit: Double,
    val shifts: DoubleArray,
    val curve: DoubleArray,
) {
    private val step: Double get() = shifts[1] - shifts[0]

    /**
     * Whether the shift is told from none: from [FEWEST_LEGS] legs or more, with an interval that leaves out 0 and
     * both ends of the range, and a gain of more than two standard errors.
     */
    val isClear: Boolean
        get() {
            val inside = (low > 0 || high < 0) && low > -limit + step && high < limit - step
            return legs >= FEWEST_LEGS && inside && gain.mean > 2 * gain.standardError
        }

    /** Whether the best of the shifts tried is the first or the last: a better one may lie beyond. */
    val isAtEnd: Boolean get() = abs(seconds) > limit - step

    companion object {
        /** Legs below which a bootstrap over legs says nothing. */
        const val FEWEST_LEGS = 8
    }
}

/**
 * How far opposite-direction passes of a survey disagree, which is the lag made visible.
 *
 * @property legs the legs found.
 * @property scores legs that could be compared.
 * @property binWidth width of the bins along the legs, m.
 * @property opposite mean of the opposite-direction scores, sensor units.
 * @property paired the same over those legs alone that have a same-direction score too; null without any.
 * @property same mean of the same-direction scores, at twice the distance; null without any.
 * @property excess mean of opposite minus same, leg by leg; null without any.
 * @property shift the best shift in time.
 * @property aside how far legs one way lie to one side of those the other way; null where they do not.
 */
class LegMismatch(
    val legs: Legs,
    val scores: List<LegScore>,
    val binWidth: Double,
    val opposite: Estimate,
    val paired: Estimate?,
    val same: Estimate?,
    val excess: Estimate?,
    val shift: LagShift,
    val aside: LegAside? = null,
) {
    /** Number of legs in [excess]. */
    val pairedLegs: Int get() = scores.count { it.same.isFinite() }

    /** What [excess] says. */
    val verdict: LegVerdict get() = LegVerdict.of(excess, pairedLegs, aside?.most ?: 0.0)

    /** [aside] where opposite legs may differ by all that they do because of it, else null. */
    val otherWater: LegAside? get() = aside?.takeIf { it.most >= opposite.mean }

    /** Whether opposite legs may differ by all that they do because those one way lie to one side of the others. */
    val isAside: Boolean get() = otherWater != null

    /** Whether [shift] is clear although the paired comparison sees no lag: it may fit the water's own change. */
    val hasReserve: Boolean get() = shift.isClear && verdict != LegVerdict.LAG_SEEN
}
