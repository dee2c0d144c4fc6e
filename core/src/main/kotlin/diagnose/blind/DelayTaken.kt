package stillwater.diagnose.blind

import stillwater.diagnose.Candidate
import stillwater.diagnose.Cause
import stillwater.diagnose.DiagnosisResult
import stillwater.diagnose.Estimate
import stillwater.diagnose.Verdict
import stillwater.diagnose.evidence.Evidence
import stillwater.model.Interval
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage

/** A dead time of [delay] s that was taken off a log without a reference before it was diagnosed. */
internal class DelayTaken(private val delay: Double) {
    /** [found] on that log, with it in the dead times that are told. */
    fun whole(found: DiagnosisResult): DiagnosisResult =
        found.with({ it.with(whole(it.parameters)) }, { it.with(whole(it.parameters)) })

    private fun whole(numbers: List<Estimate>) = numbers.map { number ->
        val reach = number.interval?.let { Interval(it.lower + delay, minOf(it.upper + delay, Estimate.OPEN)) }
        if (number.name == DEAD_TIME) number.copy(value = number.value + delay, interval = reach) else number
    }

    /** [found] on that log as a sensor on the log itself. */
    fun whole(found: SensorSpec): SensorSpec {
        if (delay == 0.0) return found
        val more = GivenLag.delay(found)
        val rest = found.stages.filter { it !is SensorStage.Delay }
        return found.copy(stages = listOf(SensorStage.Delay(delay + more)) + rest)
    }

    companion object {
        /** The name of a dead time among a model's numbers. */
        const val DEAD_TIME = "dead_time_s"

        /** Twice the log-likelihood by which another dead time must be likelier by itself: twice what tells kinds of lag. */
        const val MUCH = 2 * BlindLag.MUCH

        /** The numbers of the dead time that was tried in [found]; null where none was. */
        fun numbers(found: DiagnosisResult): List<Estimate>? =
            found.candidates.firstOrNull { it.cause == Cause.DEAD_TIME }?.parameters

        /** The dead time itself among [numbers]. */
        fun deadTime(found: DiagnosisResult): Estimate? = numbers(found)?.firstOrNull { it.name == DEAD_TIME }

        /** What [found] makes of the sensor, the base's where nothing was named. */
        fun sensor(found: DiagnosisResult): SensorSpec =
            found.extendedSensor ?: found.baseSensor.copy(name = "extended")

        /** How many causes [verdict] takes to explain the log; more than any where it does not. */
        fun causes(verdict: Verdict): Int = when (verdict) {
            is Verdict.Consistent -> 0
            is Verdict.Named -> verdict.causes.size
            is Verdict.Ambiguous -> verdict.sets.size
            is Verdict.Unexplained, is Verdict.InsufficientData -> Int.MAX_VALUE
        }

        /**
         * The answer [found] by another dead time than that of [before], as [verdict] has it: that of the dead time [numbers],
         * with which the log is likelier by [ratio], and of [sensor].
         */
        fun retold(
            before: DiagnosisResult,
            found: DiagnosisResult,
            verdict: Verdict,
            numbers: List<Estimate>,
            sensor: SensorSpec,
            ratio: Double,
            warning: String,
        ): DiagnosisResult {
            val isNamed = verdict !is Verdict.Unexplained
            val after = found.extended ?: found.baseline
            val p = Evidence.pValue(ratio, 1)
            val candidate = Candidate(
                Cause.DEAD_TIME,
                null,
                numbers,
                after.trainRmse,
                after.heldOutRmse,
                after.heldOutLogLikelihood,
                p,
                p,
                after.predicted,
            )
            return DiagnosisResult(
                verdict,
                listOf(candidate) + found.candidates.filter { it.cause != Cause.DEAD_TIME },
                before.baseline,
                after.takeIf { isNamed },
                before.baseSensor,
                sensor.takeIf { isNamed },
                found.separatingManoeuvre,
                found.dependences,
                found.spikes,
                listOf(warning) + found.warnings,
                found.effects,
                found.revisits,
                found.mayHaveChanged,
                found.lag,
            )
        }
    }
}
