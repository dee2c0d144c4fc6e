package stillwater.correct

import stillwater.estimate.CandidateResponse
import stillwater.estimate.ResponseKind
import stillwater.sensor.SensorStage
import stillwater.survey.LagShift
import stillwater.survey.Wording.Companion.digits
import stillwater.survey.Wording.Companion.percent

/**
 * A [CorrectedLog] in a sentence or three, for somebody who knows the water and not the responses.
 *
 * @param result what it is about. @param open responses that it leaves open, the most likely first.
 * @param unitAfter the readings' unit with a blank before it, or nothing. @param halfWidth of the intervals, sensor
 * units. @param isWorse whether passes disagree by more than before.
 */
internal class CorrectInShort(
    private val result: CorrectedLog,
    private val open: List<CandidateResponse>,
    private val unitAfter: String,
    private val halfWidth: Double,
    private val isWorse: Boolean,
) {
    /** The sentences. */
    val text: String get() = listOfNotNull(found(), legs(), interval()).joinToString(" ")

    private fun found(): String = when (result.origin) {
        SensorOrigin.NOTHING ->
            "Nothing in this log shows how the sensor responds: the values are smoothed, and no lag was undone."
        SensorOrigin.GIVEN -> "The sensor that was given was undone in each row."
        SensorOrigin.RATE -> "The sensor follows no faster than ${rate()}$unitAfter a second, which was undone."
        SensorOrigin.REVISITS, SensorOrigin.REFERENCE -> lag()
    }

    private fun rate() = digits(result.spec.stages.filterIsInstance<SensorStage.Slew>().first().rate, DIGITS)

    private fun lag(): String {
        if (open.firstOrNull()?.kind == ResponseKind.NONE) {
            return "The readings show no lag${if (open.size > 1) " for sure" else ""}: the values are smoothed."
        }
        val delays = open.map { it.response.meanDelay }
        val least = digits(delays.min(), DIGITS)
        val most = digits(delays.max(), DIGITS)
        if (delays.max() < result.series.medianStep / 2) {
            return "The readings trail the water by some $most s, less than half a row: the values are hardly more " +
                "than smoothed."
        }
        val others = when {
            open.any { it.kind == ResponseKind.NONE } -> ", or not at all: this log does not tell"
            least != most -> " ($least to $most s by the ${open.size} kinds of response that this log leaves open)"
            else -> ""
        }
        return "The readings trail the water by ${digits(
            delays.first(),
            DIGITS,
        )} s$others; that was undone in each row."
    }

    private fun legs(): String? {
        if (isWorse) return "Passes in opposite directions then disagree by more than before: look again before use."
        val before = result.before?.opposite?.mean
        val after = result.after?.takeIf { it.scores.size >= LagShift.FEWEST_LEGS }?.opposite?.mean
        if (before == null || after == null || !(after < before) || result.origin == SensorOrigin.NOTHING) return null
        return "Passes in opposite directions then disagree by ${percent(1 - after / before)} less."
    }

    private fun interval(): String {
        val held = result.unknown?.let { ", which holds lags of up to ${digits(it.first, 2)} s" }.orEmpty()
        return "The 95 % intervals reach ${digits(halfWidth, DIGITS)}$unitAfter either way on average$held."
    }

    private companion object {
        const val DIGITS = 3
    }
}
