package stillwater.diagnose.evidence

import stillwater.diagnose.algebra.dot
import stillwater.diagnose.algebra.squares
import stillwater.diagnose.response.ModelFit
import stillwater.diagnose.response.Term
import kotlin.math.abs

/**
 * What the steps of a sharp truth would add to the readings of [fit] if each came a little later: when within its row it
 * came is not known.
 */
internal class StepShifts(private val fit: ModelFit) {
    private val series = fit.model.series

    /**
     * A column for each step, length n, whitened; none where the truth is not sharp. Of many steps the largest, which add
     * most: work grows with the square of their number.
     */
    val columns: List<DoubleArray> by lazy {
        val isBroken = fit.model.scales.unknown?.takeIf { it.isSharp }?.isBroken
        if (isBroken == null) emptyList() else columns(isBroken)
    }

    private fun columns(isBroken: BooleanArray): List<DoubleArray> {
        val n = series.size
        val starts = (1 until n).filter { isBroken[it] }
        val truth = requireNotNull(series.reference) { "steps are those of a reference" }
        val kept = starts.indices.sortedByDescending { abs(truth[starts[it]] - truth[starts[it] - 1]) }.take(MOST_STEPS)
        return kept.map { k ->
            val from = starts[k]
            val to = starts.getOrElse(k + 1) { n }
            val column = DoubleArray(n) { if (it in from until to) series.rise(fit.predicted, it, it) else 0.0 }
            column.also { fit.noise.whiten(it, it) }
        }
    }

    /**
     * What [change] of the readings, by [term], explains beyond what all other numbers and a shift of each step for itself
     * do: twice a log-likelihood, divided by what the scores' correlation inflates it by.
     */
    fun beyond(term: Term, change: DoubleArray): Double {
        val slot = fit.model.slotOrNull(term)
        val own = if (slot == null) IntRange.EMPTY else slot until slot + fit.model.width(term)
        val others = fit.free.indices.filter { fit.free[it] }.zip(fit.jacobian.toList())
            .filter { (i, _) -> i !in own }.map { it.second }
        val shown = DoubleArray(change.size).also { fit.noise.whiten(change, it) }
        val direction = Evidence.orthonormal(listOf(shown), Evidence.orthonormal(others + columns))
        if (direction.isEmpty()) return 0.0
        // The numbers found with it leave nothing of it.
        val explained = dot(direction.single(), shown).let { it * it }
        val inflation = Evidence.inflation(direction, fit.whitened)
        return Evidence.ratio(squares(fit.whitened) + explained, squares(fit.whitened), fit.noise.rows) / inflation
    }

    private companion object {
        const val MOST_STEPS = 200
    }
}
