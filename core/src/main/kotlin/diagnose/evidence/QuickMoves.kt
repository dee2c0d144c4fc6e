package stillwater.diagnose.evidence

import stillwater.diagnose.noise.Shocks
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.NoiseSearch
import stillwater.diagnose.response.Scales

/**
 * Moves of a truth that are over within a row. When between two rows each came is not known, so that they shake the
 * readings after them; but where samples change just at rows, or the log is of a simulation, nothing shakes.
 */
internal object QuickMoves {
    /**
     * Whether readings after such moves are foretold by [fit] as well as all others: whether they are likelier unshaken, and
     * hardly any was left out for being far off.
     *
     * @param longest longest correlation time of noise, s.
     */
    fun areForetold(fit: ModelFit, longest: Double): Boolean {
        val scales = fit.model.scales
        val unknown = scales.unknown ?: return true
        val shocks = scales.shocks ?: return true
        val moves = unknown.isBroken.indices.filter { unknown.isBroken[it] && !unknown.isGap[it] }
        val used = fit.noise.used
        val wild = moves.count { !used[it] || !used.getOrElse(it + 1) { true } }
        if (wild > MOST_WILD * moves.size) return false
        // What was passed in gaps stays unknown.
        val left = DoubleArray(shocks.variance.size) { if (unknown.isGap[it]) shocks.variance[it] else 0.0 }
        val calm = Scales(scales.series, unknown, if (left.any { it > 0 }) Shocks(left, shocks.keep) else null)
        val search = NoiseSearch(calm, fit.residuals, used, longest)
        search.near(fit.noise)
        return search.score > fit.score + SURE
    }

    /** Twice a log-likelihood ratio that is certain. */
    private const val SURE = 30.0

    /** Of the moves, those after which a reading may be left out. */
    private const val MOST_WILD = 0.05
}
