package stillwater.diagnose.blind

import stillwater.diagnose.algebra.Cholesky
import stillwater.diagnose.algebra.squares
import stillwater.diagnose.evidence.HeldOutScore
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
    /**
     * The score of [state], with the [stretches] of its fit. Its errors are those with which a row is foretold by other
     * passes and by the rows before it in its stretch, of all rows the geometric mean: an error where no other pass comes
     * near counts by how little could be foretold there, and models with other noise or rougher water are measured alike.
     */
    fun score(state: BlindState, stretches: Stretches = Stretches(state.fit)): HeldOutScore {
        val fit = state.fit
        val z = state.whitened
        val variance = maxOf(state.variance, 1e-300)
        var errors = 0.0
        var twice = 0.0
        var spread = fit.design.noise.logDeterminant
        for (stretch in stretches.each { from, to, unforeseen -> Stretch(unforeseen, z.copyOfRange(from, to)) }) {
            errors += stretch.squares
            twice += stretch.squares / variance + stretch.count * ln(2 * PI * variance)
            spread -= stretch.logDeterminant
        }
        val rows = maxOf(fit.rows, 1)
        return HeldOutScore(sqrt(errors / rows) * exp(spread / (2 * rows)), -(twice + spread) / 2)
    }

    /** The forecast of a stretch that has [own] of the whitened residuals, of which the others leave [unforeseen]. */
    private class Stretch(unforeseen: Array<DoubleArray>, own: DoubleArray) {
        private val factor = Cholesky(unforeseen)

        /** Number of rows. */
        val count = own.size

        /** ln det of what the errors are multiplied by. */
        val logDeterminant = factor.logDeterminant

        /** Square sum of the errors, each over how well it could be foretold. */
        val squares = squares(factor.half(own))
    }
}
