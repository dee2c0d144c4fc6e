package stillwater.diagnose

import stillwater.sensor.SensorSpec
import stillwater.sensor.SensorStage

/**
 * The lag of a sensor that is taken as given, held against a log without a reference.
 *
 * @param free the model whose lag the log itself tells.
 */
internal class GivenLag(search: BlindSearch, private val free: BlindState, spec: SensorSpec) {
    /** None where one of them is limited, which this does not look at. */
    private val lags = spec.stages.filterIsInstance<SensorStage.Lag>()
        .takeIf { spec.stages.none { it is SensorStage.LimitedLag } }.orEmpty()

    /** Whether anything of the sensor given was not looked at: a gain and an offset do not show anyway. */
    val isPartial: Boolean = lags.size != 1 ||
        spec.stages.any { it !is SensorStage.Lag && it !is SensorStage.Calibration && it !is SensorStage.Noise }

    /** Its time constant, s; null where it has no lag alone. */
    val timeConstant: Double? = lags.singleOrNull()?.timeConstant

    /** The model with it. */
    val state: BlindState? = timeConstant?.let { tau ->
        val numbers = free.numbers.copyOf()
        numbers[ResponseModel.TIME_CONSTANT] = maxOf(tau, free.model.parameters[ResponseModel.TIME_CONSTANT].lower)
        search.settled(emptyList(), numbers, free.fit.design.noise, free.variances, before = free)
    }

    /** Probability that the given time constant is right and the log prefers its own as much. */
    val pValue: Double = state?.let { given ->
        val column = free.fit.unlike(free.derivative(ResponseModel.TIME_CONSTANT))
        val inflation = BlindEvidence.inflation(listOf(column), free.whitened)
        val t = BlindEvidence.between(given, free)
        val agreement = if (t > 0) Evidence.student(t, BlindEvidence.STRETCHES - 1) else 1.0
        maxOf(Evidence.pValue((free.score - given.score) / inflation, 1), agreement)
    } ?: 1.0
}
