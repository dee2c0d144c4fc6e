package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.DiagnosisResult
import stillwater.diagnose.DiagnosisSettings
import stillwater.diagnose.Estimate
import stillwater.diagnose.Loops
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.ProgressParts
import stillwater.diagnose.Verdict
import stillwater.diagnose.three
import stillwater.model.Interval
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage

/**
 * The diagnosis of a log without a reference whose given sensor has a dead time: that is taken off the log first, so that
 * whatever is found comes beside it. One that is too long leaves a sensor that is ahead of the water, which no cause is;
 * where something was found the log is therefore diagnosed as it is, too.
 *
 * @param given the sensor, with a dead time.
 */
internal class GivenDelay(
    private val series: MeasuredSeries,
    private val settings: DiagnosisSettings,
    private val given: SensorSpec,
    private val loops: Loops,
    progress: (Double) -> Unit,
) {
    private val progress = ProgressParts(progress)
    private val delay = GivenLag.delay(given)

    /** The answer. */
    fun answer(): DiagnosisResult {
        val taken = BlindDiagnosis(series.atPlacesBefore(delay), settings, loops, progress.next(HALF))
        val result = DelayTaken(delay).whole(taken.run())
        if (result.verdict == Verdict.Consistent) return result
        val prompt = given.copy(stages = given.stages.filter { it !is SensorStage.Delay })
        val without = BlindDiagnosis(series, settings.copy(base = prompt), loops, progress.next(1.0))
        val found = without.run()
        val ratio = (without.found?.score ?: return result) - (taken.found?.score ?: return result)
        val more = DelayTaken.causes(found.verdict).compareTo(DelayTaken.causes(result.verdict))
        val least = when {
            more < 0 -> 0.0
            more == 0 && isShorter(found) -> BlindDiagnosis.ONE_NUMBER
            // As many causes and no shorter one.
            else -> DelayTaken.MUCH
        }
        return if (ratio > least) tooLong(result, found, ratio) else result
    }

    /** Whether the dead time that was [found] is shorter for certain. */
    private fun isShorter(found: DiagnosisResult): Boolean {
        val upper = DelayTaken.deadTime(found)?.interval?.upper
        return upper != null && upper < delay
    }

    /** The answer [found] without the dead time, which makes the log likelier by [ratio] than [given] did. */
    private fun tooLong(given: DiagnosisResult, found: DiagnosisResult, ratio: Double): DiagnosisResult {
        val dead = listOf(Cause.DEAD_TIME)
        val verdict = when (val verdict = found.verdict) {
            is Verdict.Named -> Verdict.Named((dead + verdict.causes).distinct())
            is Verdict.Ambiguous -> {
                val isIn = verdict.sets.any { Cause.DEAD_TIME in it }
                if (isIn) verdict else Verdict.Ambiguous(listOf(dead) + verdict.sets)
            }
            is Verdict.Unexplained -> verdict
            is Verdict.Consistent, is Verdict.InsufficientData -> Verdict.Named(dead)
        }
        val sensor = DelayTaken.sensor(found)
        val left = GivenLag.delay(sensor)
        val numbers = DelayTaken.numbers(found)?.takeIf { left > 0 }
            ?: listOf(Estimate(DelayTaken.DEAD_TIME, "s", left, Interval(0.0, delay)))
        val warning =
            "The dead time of the sensor given, ${three(delay)} s, is too long: without it the log is likelier."
        return DelayTaken.retold(given, found, verdict, numbers, sensor, ratio, warning)
    }

    private companion object {
        /** Of the work, the part that the log with the dead time taken off takes. */
        const val HALF = 0.5
    }
}
