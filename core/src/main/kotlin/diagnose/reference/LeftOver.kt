package stillwater.diagnose.reference

import stillwater.diagnose.Cause
import stillwater.diagnose.Dependence
import stillwater.diagnose.algebra.squares
import stillwater.diagnose.evidence.Evidence
import stillwater.diagnose.evidence.Settling
import stillwater.diagnose.evidence.Structure
import stillwater.diagnose.evidence.Trial
import stillwater.diagnose.response.ModelFit

/**
 * What no cause of the list explains, in words that a reader can look for in the field: [base] is the model without
 * causes, and [chosen] are not enough.
 */
internal class LeftOver(private val base: ModelFit, private val chosen: List<Trial>) {
    private val series = base.model.series

    /** What is left, where it depends on [most]. */
    fun words(most: Dependence): String = "the residuals depend on ${most.description}" +
        (if (most.description in setOf(Structure.SLOW, Structure.SETTLES)) settling() else "") + beside()

    /** An offset that settles: most drifts of a probe that warms up, or is overgrown, level off. */
    private fun settling(): String {
        val all = leftBy(emptyList())
        val best = Settling.TIMES.map { it * series.duration }.map(::settled).minBy { it.left }
        val slow = all - leftBy(Structure.slow(series))
        val line = listOf(DoubleArray(series.size) { series.times[it] - series.times[0] })
        // As one curve it explains nearly all that six do, and more than a straight line.
        if (all - best.left < MOST_OF * slow || best.left >= leftBy(line)) return ""
        return ": " + Settling.words(best.size, best.time)
    }

    private class Settled(val time: Double, val size: Double, val left: Double)

    private fun settled(time: Double): Settled {
        val curve = Settling.column(series, time)
        val mean = curve.average()
        val squares = curve.sumOf { (it - mean) * (it - mean) }
        val size = if (squares > 0) curve.indices.sumOf { (curve[it] - mean) * base.residuals[it] } / squares else 0.0
        return Settled(time, size, leftBy(listOf(curve)))
    }

    /** Squares that [columns] and a mean leave of the base's residuals. */
    private fun leftBy(columns: List<DoubleArray>): Double {
        val directions = Evidence.orthonormal(listOf(DoubleArray(series.size) { 1.0 }) + columns)
        return squares(Evidence.without(base.residuals, directions))
    }

    /** What explains most of it, and where the rest is. */
    private fun beside(): String {
        val main = chosen.firstOrNull() ?: return ""
        val share = 1 - squares(main.fit.residuals) / maxOf(squares(base.residuals), 1e-300)
        if (share < LEAST_SHARE) return ""
        return "; ${main.term.cause.label} explains ${(100 * share).toInt()} % of what the base model leaves, and " +
            "not the rest" + if (main.term.cause == Cause.POSITION_OFFSET) ARM else ""
    }

    private companion object {
        const val MOST_OF = 0.9

        const val LEAST_SHARE = 0.1

        /** A shift along the track is all that a log tells of the probe's place. */
        const val ARM =
            ": a probe to the side of the track, or on a rigid arm that swings out in turns, leaves such a rest"
    }
}
