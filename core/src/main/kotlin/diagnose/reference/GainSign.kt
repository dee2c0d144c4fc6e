package stillwater.diagnose.reference

import stillwater.diagnose.algebra.SymmetricSystem
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.ResponseModel
import kotlin.math.sqrt

/**
 * Whether readings rise with the reference, as [base] has it for certain.
 *
 * A log in which the water moves once, up, has readings that rise with it. A model with numbers enough may explain the shape of
 * that rise better by a sensor that falls, from a state before the log that no reading shows. Readings that fall with the reference in the
 * base may rise in truth: a delay of half a period turns what is periodic.
 */
internal class GainSign(private val base: ModelFit) {
    private val gain = base.numbers[ResponseModel.GAIN]
    private val isRising by lazy { gain > DEVIATIONS * deviation() }

    /** Whether readings fall with the reference in [fit] though they rise with it. */
    fun isTurned(fit: ModelFit): Boolean = fit.numbers[ResponseModel.GAIN] < 0 && isRising

    /** Standard error of the gain; 0 of one that was given. */
    private fun deviation(): Double {
        if (!base.free[ResponseModel.GAIN]) return 0.0
        val place = (0 until ResponseModel.GAIN).count { base.free[it] }
        val squared = SymmetricSystem.of(base.jacobian, base.whitened).inverseDiagonal(place) * base.variance
        return sqrt(squared)
    }

    private companion object {
        const val DEVIATIONS = 3.0
    }
}
