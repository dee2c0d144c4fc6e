package stillwater.diagnose.blind

import stillwater.diagnose.evidence.Evidence
import stillwater.diagnose.response.ResponseModel
import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage
import kotlin.math.abs
import kotlin.math.ln

/**
 * The lag of a sensor that is taken as given, held against a log without a reference.
 *
 * @param free the model whose lag the log itself tells. @param beside the same with what was found beside a lag; null where
 *   nothing was.
 */
internal class GivenLag(
    private val search: BlindSearch,
    private val free: BlindState,
    spec: SensorSpec,
    private val beside: BlindState? = null,
) {
    /** None beside what shapes the response as well, which this does not look at: the log's own lag makes up for that. */
    private val lags = spec.stages.filterIsInstance<SensorStage.Lag>()
        .takeIf { spec.stages.none(::isShaping) }.orEmpty()

    /** Its dead time, which was taken off the log, s. */
    val delay: Double = delay(spec)

    /** Whether anything of the sensor given was not looked at: a gain and an offset do not show anyway. */
    val isPartial: Boolean = lags.size != 1 || spec.stages.any { !isLookedAt(it) }

    /** [found], on a log without the [delay], as a sensor on the log itself. */
    fun delayed(found: SensorSpec): SensorSpec = DelayTaken(delay).whole(found)

    /** Its time constant, s; null where it has no lag alone. */
    val timeConstant: Double? = lags.singleOrNull()?.timeConstant

    /** The model with it. */
    val state: BlindState? = timeConstant?.let { tau ->
        val numbers = free.numbers.copyOf()
        numbers[ResponseModel.TIME_CONSTANT] = maxOf(tau, free.model.parameters[ResponseModel.TIME_CONSTANT].lower)
        search.settled(emptyList(), numbers, free.fit.design.noise, free.variances, before = free)
    }

    /** Probability that the given time constant is right, alone or beside what was found, and the log prefers its own as much. */
    val pValue: Double = maxOf(alone(), ofBeside())

    private fun alone(): Double = state?.let { given ->
        val column = free.fit.unlike(free.derivative(ResponseModel.TIME_CONSTANT))
        val inflation = BlindEvidence.inflation(listOf(column), free.whitened)
        val t = BlindEvidence.between(given, free)
        val agreement = if (t > 0) Evidence.student(t, BlindEvidence.STRETCHES - 1) else 1.0
        maxOf(Evidence.pValue((free.score - given.score) / inflation, 1), agreement)
    } ?: 1.0

    /** A lag alone makes up for what is at work beside the lag: with that the time constant may be the given one again. */
    private fun ofBeside(): Double {
        if (beside == null || timeConstant == null) return 0.0
        val error = BlindErrors.WIDER * BlindErrors.of(search, beside)[ResponseModel.TIME_CONSTANT]
        val off = abs(ln(timeConstant / beside.timeConstant))
        return if (error > 0) Evidence.student(off / error, BlindEvidence.STRETCHES - 1) else 0.0
    }

    companion object {
        /** The dead time of [spec], s. */
        fun delay(spec: SensorSpec): Double =
            spec.stages.filterIsInstance<SensorStage.Delay>().sumOf { it.deadTime }

        private fun isShaping(stage: SensorStage) =
            stage is SensorStage.LimitedLag || stage is SensorStage.Slew || stage is SensorStage.Backlash

        private fun isLookedAt(stage: SensorStage) = stage is SensorStage.Lag || stage is SensorStage.Delay ||
            stage is SensorStage.Calibration || stage is SensorStage.Noise || stage is SensorStage.Wander
    }
}
