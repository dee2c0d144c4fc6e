package stillwater.estimate

import kotlin.math.expm1

/**
 * One step of a first-order lag whose input runs straight between its ends:
 * s₁ = keep · s₀ + before · f₀ + now · f₁, exact, weights that add up to 1.
 */
internal class LagWeights {
    var keep = 0.0
        private set
    var before = 0.0
        private set
    var now = 1.0
        private set

    /** Sets the weights for [timeConstant] τ, s, and a step of [dt] s, at least 0. */
    fun set(timeConstant: Double, dt: Double) {
        if (!(dt > 0)) {
            keep = 1.0
            before = 0.0
            now = 0.0
            return
        }
        val ratio = dt / timeConstant
        // 1 − e^{−Δ/τ} by itself loses no digits for long time constants; (1 − e)/(Δ/τ) is the input's older share.
        val gain = -expm1(-ratio)
        keep = 1 - gain
        val older = if (ratio > SMALL) gain / ratio else 1 - ratio / 2
        now = 1 - older
        before = older - keep
    }

    private companion object {
        const val SMALL = 1e-8
    }
}
