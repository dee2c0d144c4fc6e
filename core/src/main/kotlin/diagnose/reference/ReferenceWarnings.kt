package stillwater.diagnose.reference

import stillwater.diagnose.Dependence
import stillwater.diagnose.DiagnosisSettings
import stillwater.diagnose.Verdict
import stillwater.diagnose.evidence.AnyResponse
import stillwater.diagnose.evidence.AveragedNoise
import stillwater.diagnose.evidence.SmallShifts
import stillwater.diagnose.evidence.Spikes
import stillwater.diagnose.evidence.StillReadings
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ReferenceLead
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Steps
import stillwater.diagnose.three

/**
 * What a reader must know beside the verdict of a log with a reference: [base] is the model without causes, [last] that with
 * all that was chosen.
 *
 * @param late by how much the reference was late, s, before it was put right. @param before the share that the row before
 * has in a truth that is held over each step.
 */
internal class ReferenceWarnings(
    private val base: ModelFit,
    private val last: ModelFit,
    private val settings: DiagnosisSettings,
    private val late: Double,
    private val before: Double,
) {
    private val series = base.model.series
    private val unknown = base.model.scales.unknown

    /**
     * In words, beside [verdict]: [most] is the strongest of what is left, [uneven] what the noise goes with, [caution] what
     * may be wrong with the reference, null for nothing; so many readings are far [off], and some may stand [still];
     * noise may be [averaged].
     */
    fun of(
        most: Dependence,
        verdict: Verdict,
        uneven: String?,
        caution: String?,
        off: Int,
        still: StillReadings,
        averaged: AveragedNoise?,
    ): List<String> = buildList {
        val named = verdict is Verdict.Named || verdict is Verdict.Ambiguous
        val isAnswered = verdict !is Verdict.Consistent && verdict !is Verdict.InsufficientData
        if (named && most.adjusted < settings.structureLevel) {
            add("Structure is left beside what was named: the residuals depend on ${most.description}.")
        }
        uneven?.takeIf { named }?.let { add("Beside what was named $it.") }
        steps(verdict)?.let(::add)
        apart(verdict)?.let(::add)
        val isConstant = ConstantTruth.isOf(series)
        if (isConstant && named) add(ConstantTruth.caution(base))
        if (!isConstant && isAnswered && AnyResponse.hardlyTurns(series)) add(ONE_WAY)
        if (verdict is Verdict.Consistent && mayHide) {
            add(
                "The noise that was found wanders for ${three(last.noise.time)} s at a time, longer than the lag is: " +
                    "what comes and goes as slowly, as a pump that stops for a while, is not told from it.",
            )
        }
        averaged?.sentenceBeside(verdict)?.let(::add)
        unknown?.words()?.let(::add)
        if (late > 0) add("Put right before the causes were weighed: ${ReferenceLead.words(late)}.")
        caution?.let(::add)
        still.repeats()?.let(::add)
        val all = off + series.wild.size
        if (all > 0) add("${Spikes.words(all)} and left out of the fits.")
    }

    /** How the truth went from row to row, as far as it matters. */
    private fun steps(verdict: Verdict): String? = when {
        unknown?.isSharp == true -> "A delay of less than ${three(series.period)} s cannot show: ${SmallShifts.SHARP}"
        before == 1.0 -> SmallShifts.UNTIL_NEXT
        before > 0 -> null
        // Where something else is at work it may look so for that.
        base.model.steps == Steps.HELD && tau(base) > series.period / 2 && verdict !is Verdict.Unexplained ->
            "The truth looks held over each step, as a simulation holds it; a sensor in water would have a time " +
                "constant half a step shorter."
        else -> null
    }

    /** What rows that are far apart for the water leave open; null where they are not. */
    private fun apart(verdict: Verdict): String? = when {
        last.model.scales.doubt.between == null -> null
        verdict is Verdict.Unexplained -> "$APART What is left may be that."
        last.model.scales.lengthScale > 0 -> "$APART The rows beside tell it, and what that may be off is noise."
        else -> null
    }

    /** Whether nearly all noise wanders, more slowly than the sensor answers. */
    private val mayHide: Boolean get() = last.noise.share > MOSTLY && last.noise.time > tau(last)

    private fun tau(fit: ModelFit) = fit.numbers[ResponseModel.TIME_CONSTANT]

    private companion object {
        const val ONE_WAY =
            "The reference goes up or down, or there and back, once: a cause that goes with the value or the time " +
                "shows only beyond what a response of another shape does. Several moves to and fro would tell them apart."
        const val APART =
            "Rows are far apart for what the water changes by, and how it went between them is not in the log."

        /** Of the noise's variance. */
        const val MOSTLY = 0.8
    }
}
