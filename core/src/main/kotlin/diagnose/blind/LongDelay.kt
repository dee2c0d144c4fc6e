package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.DiagnosisResult
import stillwater.diagnose.DiagnosisSettings
import stillwater.diagnose.Loops
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.ModelAssessment
import stillwater.diagnose.ProgressParts
import stillwater.diagnose.Verdict
import stillwater.diagnose.three
import stillwater.diagnose.track.PassShift

/**
 * The diagnosis of a log without a reference whose readings may be later than any lag tells: water that takes half a
 * minute through a tube. Where the lag is left open, passes over the same places say by how much later readings agree
 * best; part of that is taken off the log, which is diagnosed once more, and the likelier answer stands.
 */
internal class LongDelay(
    private val series: MeasuredSeries,
    private val settings: DiagnosisSettings,
    private val loops: Loops,
    progress: (Double) -> Unit,
) {
    private val progress = ProgressParts(progress)

    /** The answer. */
    fun answer(): DiagnosisResult {
        val plain = BlindDiagnosis(series, settings, loops, progress.next(PLAIN))
        val result = plain.run()
        val before = plain.found ?: return result
        val late = if (isVague(result.baseline)) PassShift(series).late() else null
        if (late == null) return result
        val found = SHARES.firstNotNullOfOrNull { share -> tried(share * late, before, result) } ?: return result
        if (found.verdict == ALONE) return found
        // What is still to be told of a long dead time may look like more beside it: less of it does not.
        val whole = DelayTaken.deadTime(found) ?: return found
        return tried(NEARLY * whole.value, before, result)?.takeIf { it.verdict == ALONE } ?: found
    }

    /** Whether a lag alone may be many times as long as another. */
    private fun isVague(base: ModelAssessment): Boolean {
        val reach = base.parameters.firstOrNull { it.name == "time_constant_s" }?.interval ?: return false
        return reach.upper > VAGUE * reach.lower
    }

    /** The answer with a dead time of [delay] s off the log; null where that is not for certain better than [before]. */
    private fun tried(delay: Double, before: BlindState, result: DiagnosisResult): DiagnosisResult? {
        val later = BlindDiagnosis(series.atPlacesBefore(delay), settings, loops, progress.next(HALF))
        val found = later.run()
        val after = later.found ?: return null
        val ratio = after.score - before.score
        val verdict = verdict(found.verdict)
        if (verdict == null || ratio < DelayTaken.MUCH) return null
        // Where other causes stand for the delay stretches need not agree that it is better, if it takes no more of them.
        val isInstead = result.verdict is Verdict.Named || result.verdict is Verdict.Ambiguous
        val isAsSimple = isInstead && DelayTaken.causes(verdict) <= DelayTaken.causes(result.verdict)
        if (!isAsSimple && BlindEvidence.between(before, after) < BlindLag.SURE) return null
        val taken = DelayTaken(delay)
        val whole = taken.whole(found)
        val numbers = DelayTaken.numbers(whole).orEmpty()
        val sensor = taken.whole(DelayTaken.sensor(found))
        val warning =
            "The readings are ${three(delay)} s late or more: that was taken off first, their lag is told beside it."
        return DelayTaken.retold(result, whole, verdict, numbers, sensor, ratio, warning)
    }

    /** [found] on the log without most of its dead time, which is certain; null where that explains nothing. */
    private fun verdict(found: Verdict): Verdict? = when (found) {
        is Verdict.Consistent -> ALONE
        is Verdict.Named -> Verdict.Named((ALONE.causes + found.causes).distinct())
        is Verdict.Ambiguous -> {
            val sets = listOf(ALONE.causes) + found.sets.filter { Cause.DEAD_TIME !in it }
            if (sets.all { it.size == 1 }) Verdict.Named(sets.flatten()) else Verdict.Ambiguous(sets)
        }
        is Verdict.Unexplained, is Verdict.InsufficientData -> null
    }

    private companion object {
        /** The upper end of an interval of the lag over the lower one from which it is open. */
        const val VAGUE = 4.0

        /** Of the shift that suits passes, which holds the lag as well: what is taken off, the larger first. */
        val SHARES = listOf(0.75, 0.5)
        const val NEARLY = 0.95

        /** Of the work, the part that the log as it is takes; and of what is left, that which each time more takes. */
        const val PLAIN = 0.6
        const val HALF = 0.5
        val ALONE = Verdict.Named(listOf(Cause.DEAD_TIME))
    }
}
