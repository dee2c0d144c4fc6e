package stillwater.diagnose

import kotlin.math.PI
import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * How well stretches of a log without a reference are foretold by all others: the water there is what other passes say.
 *
 * With z the whitened residuals and R_b a stretch's rows of the derivatives, the errors of the forecast are
 * (I − R_b H⁻¹ R_bᵀ)⁻¹ z_b, H the posterior's precision; the sensor's numbers stay as they are.
 */
internal object BlindHeldOut {
    private const val STRETCHES = 16

    /**
     * The score of [state]. Its errors are those with which a row is foretold by other passes and by the rows before
     * it in its stretch, of all rows the geometric mean: an error where no other pass comes near counts by how little
     * could be foretold there, and models with other noise or rougher water are measured alike.
     */
    fun score(state: BlindState): HeldOutScore {
        val fit = state.fit
        val z = state.whitened
        val variance = maxOf(state.variance, 1e-300)
        var errors = 0.0
        var twice = 0.0
        var spread = fit.design.noise.logDeterminant
        for (stretch in 0 until STRETCHES) {
            val from = (stretch.toLong() * z.size / STRETCHES).toInt()
            val to = ((stretch + 1).toLong() * z.size / STRETCHES).toInt()
            val halves = Array(to - from) { fit.halfRow(from + it) }
            val count = halves.size
            val left = Array(count) { a ->
                DoubleArray(a + 1) { b -> (if (a == b) 1.0 else 0.0) - dot(halves[a], halves[b]) }
            }
            val factor = Cholesky(left)
            val half = factor.half(DoubleArray(count) { z[from + it] })
            errors += squares(half)
            twice += squares(half) / variance + count * ln(2 * PI * variance)
            spread -= factor.logDeterminant
        }
        val rows = maxOf(fit.rows, 1)
        return HeldOutScore(sqrt(errors / rows) * exp(spread / (2 * rows)), -(twice + spread) / 2)
    }
}
