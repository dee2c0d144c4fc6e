package stillwater.diagnose.reference

import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ResponseModel

/**
 * Whether readings rise with the reference, as [base] has it for certain.
 *
 * A log in which the water moves once, up, has readings that rise with it. A model with numbers enough may explain the shape of
 * that rise better by a sensor that falls, from a state before the log that no reading shows. Readings that fall with the reference in the
 * base may rise in truth: a delay of half a period turns what is periodic.
 */
internal class GainSign(private val base: ModelFit) {
    private val gain = base.numbers[ResponseModel.GAIN]

    /** A gain that was given is known. */
    private val isRising by lazy {
        val isGiven = !base.free[ResponseModel.GAIN]
        gain > if (isGiven) 0.0 else DEVIATIONS * base.standardError(ResponseModel.GAIN)
    }

    /** Whether readings fall with the reference in [fit] though they rise with it. */
    fun isTurned(fit: ModelFit): Boolean = fit.numbers[ResponseModel.GAIN] < 0 && isRising

    private companion object {
        const val DEVIATIONS = 3.0
    }
}
