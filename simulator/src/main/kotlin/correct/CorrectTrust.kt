package stillwater.correct

import stillwater.estimate.TrackAgreement
import stillwater.sensor.SensorStage
import stillwater.survey.Wording.Companion.digits
import stillwater.survey.Wording.Companion.percent
import kotlin.math.sqrt

/**
 * How far the intervals of a [CorrectedLog] were checked, and held, in words.
 *
 * @param result what it is about. @param unitAfter the readings' unit with a blank before it, or nothing.
 */
internal class CorrectTrust(private val result: CorrectedLog, private val unitAfter: String) {
    private val agreement = result.agreement
    private val isContradicted = agreement.isContradicted && result.learned.stillBoat == null
    private val isWidened = result.isWidenedForPasses

    private val isUneven = result.isWidenedForUnevenness

    /** What the track says of the intervals, for the facts. */
    val words: String
        get() = when {
            result.origin == SensorOrigin.NOTHING ->
                "if the sensor has no lag" + if (isWidened) ", widened by what passes disagree in ${places()}" else ""
            isUneven ->
                "widened by how unevenly late passes beside each other are; else not checked, for ${crossings()}"
            agreement.ratio.isNaN() -> "not checked, for ${crossings()}"
            isWidened -> "widened by what passes disagree in ${places()}"
            isContradicted -> "passes disagree by more in ${places()}"
            else -> "passes agree as far as that in ${places()}"
        }

    private fun places() = when (agreement.crossings) {
        0 -> "no place"
        1 -> "1 place"
        else -> "${agreement.crossings} places"
    }

    private fun different() = if (agreement.places == 1) "1 place" else "${agreement.places} places"

    /** How seldom the boat was where it had been; legs beside each other are different places. */
    private fun crossings() = when {
        !result.log.hasPlaces -> "the log has no places"
        agreement.alike >= TrackAgreement.FEWEST ->
            "where passes come to the same place again they go the same way at the same speed, and agree whatever " +
                "the sensor's lag, but in ${different()}"
        agreement.places < agreement.crossings -> "the boat's track crosses itself in the same ${different()} only"
        result.log.oneDimensional -> "later passes go through ${places()} again"
        agreement.crossings == 0 -> "the boat's track nowhere crosses itself"
        else -> "the boat's track crosses itself in ${places()} only"
    }

    /** What the user should know, one line each. */
    val warnings: List<String>
        get() = listOfNotNull(
            unbounded(),
            calibrated(),
            misfit(),
            contradicted(),
            uneven(),
            wandered(),
            unchecked(),
            alike(),
            limited(),
        )

    /** A time as long as any that was looked for. */
    private fun unbounded(): String? {
        val open = result.choice?.open?.firstOrNull { it.atLongest.isNotEmpty() } ?: return null
        val longest = digits(open.parameter(open.atLongest.first()), 2)
        return "the log does not show how slow the sensor is: $longest s, of the ${open.kind.label}, is as long as " +
            "was looked for, a quarter of the log. It may be slower still; intervals hold one that is a few times as " +
            "slow"
    }

    /** The reference is in another unit, or the sensor is far out. */
    private fun calibrated(): String? {
        if (result.origin != SensorOrigin.REFERENCE) return null
        val found = result.learned.stages.filterIsInstance<SensorStage.Calibration>().singleOrNull() ?: return null
        if (found.gain in USUAL_GAIN) return null
        return "the readings are ${digits(found.gain, 3)} times the reference plus ${digits(found.offset, 3)}: the " +
            "corrected values are in the reference's unit"
    }

    /** The reference knows better than the intervals. */
    private fun misfit(): String? {
        val margin = result.margin?.takeIf { it.isMisfit } ?: return null
        val outside = percent(1 - margin.covered)
        val why = if (result.origin == SensorOrigin.NOTHING) {
            "the sensor has a lag that was not undone, or does something else"
        } else {
            "the sensor does something that none of the responses tried has, such as to follow the flow or the " +
                "temperature"
        }
        val learned = if (result.origin == SensorOrigin.REFERENCE) ", though in the sensor they had" else ""
        return "the reference lies outside the intervals in $outside of ${margin.rows} rows: $why. Intervals were " +
            "made ${digits(margin.factor, 2)} times as wide, which holds ${percent(margin.heldOut)} of rows in " +
            "tenths of the log that had no say in the factor$learned; diagnose --reference looks for the cause"
    }

    private fun contradicted(): String? {
        if (!isContradicted) return null
        // What differs by more counts as the largest, so that the mean says little near it.
        val least = if (agreement.ratio > TrackAgreement.LARGEST / 2) "at least " else ""
        val times = least + digits(sqrt(agreement.ratio), 2)
        val excess = "passes through the same ${places()} differ by $times times what the intervals allow"
        val parts = listOfNotNull(
            "as if times were wrong by ${digits(agreement.lateness, 2)} s".takeIf { agreement.lateness > 0 },
            "as if values were wrong by ${digits(agreement.spread, 2)}$unitAfter".takeIf { agreement.spread > 0 },
        ).joinToString(" and ")
        val causes = "another response, water that changed in between, or fixes that are off"
        return if (isWidened) {
            "$excess ($parts): $causes. The intervals were widened by it; errors that all passes share are not in them"
        } else {
            "$excess ($parts): $causes. They were left as the given sensor has them"
        }
    }

    /** What passes beside each other say of a response that is not the same everywhere. */
    private fun uneven(): String? {
        if (!isUneven) return null
        val late = digits(result.learned.unevenness(agreement) ?: 0.0, 2)
        return "passes beside each other differ as if times were wrong by $late s beyond what fixes may be off, here " +
            "by more and there by less, as with a lag that follows the flow or the temperature, a rate limit that " +
            "was not recognised, or fixes that are off by more. The intervals were widened by it; they may still be " +
            "too narrow where the lag is longest. diagnose looks for the cause"
    }

    /** What legs beside each other say of the zero. */
    private fun wandered(): String? {
        val wander = result.wander?.takeIf { it.isSeen } ?: return null
        val wide = digits(result.wandered?.meanHalfWidth ?: return null, 2)
        return "legs beside each other differ as if the sensor's zero had wandered by some " +
            "${digits(wander.walked, 2)}$unitAfter by the end of the log, or as water with a front between them, or " +
            "that all changed meanwhile, does: the log does not tell which. Values and intervals are for a zero that " +
            "kept still; if it wandered, the intervals are $wide$unitAfter either way"
    }

    /** What of the zero would not be seen. */
    private fun zero(): String {
        val zero = "They do not hold a sensor whose zero wanders or that fouls"
        val wander = result.wander?.takeIf { !it.isSeen && it.walked > 0 } ?: return zero
        return "$zero, by some ${digits(wander.walked, 2)}$unitAfter at the end of this log without being seen"
    }

    private fun unchecked(): String? {
        if (!agreement.ratio.isNaN()) return null
        if (result.origin == SensorOrigin.GIVEN) {
            return "nothing in the log checked the sensor given, for ${crossings()}, and intervals are checked where " +
                "two passes read the same place, ${TrackAgreement.FEWEST} places at least: they hold if the sensor " +
                "is this one"
        }
        if (result.origin !in LEARNED) return null
        return "${crossings()}, and intervals are checked where two passes read the same place, " +
            "${TrackAgreement.FEWEST} places at least: unchecked, they hold if the sensor is one of those named. " +
            "${zero()}, which looks like water that differs from leg to leg; nor all of a lag that changes along the " +
            "track or of a rate limit that was not recognised. " +
            "A few legs across the others would check them"
    }

    /** A course that is sailed again and again. */
    private fun alike(): String? {
        val alike = result.learned.alike.takeIf { it > 0 && result.origin == SensorOrigin.REVISITS } ?: return null
        return "in $alike of ${alike + result.learned.blocks} runs of the track all passes go the same way at the " +
            "same speed, and agree whatever the sensor's lag: it was learned, and its interval is, from the few " +
            "places that are passed another way. Legs across the course would tell more"
    }

    /** A rate that is reached often hides what else the sensor does. */
    private fun limited(): String? {
        if (result.origin != SensorOrigin.RATE || result.choice != null) return null
        return "a lag beside the rate limit was not looked for and is not in the intervals, which then hold far less " +
            "than 95 % of the rows: diagnose looks for both, and --sensor takes what it finds"
    }

    private companion object {
        /** Gains of a sensor in the unit of its reference, dimensionless: one that is farther out is told all the same. */
        val USUAL_GAIN = 0.8..1.25
        val LEARNED = setOf(SensorOrigin.REVISITS, SensorOrigin.RATE)
    }
}
