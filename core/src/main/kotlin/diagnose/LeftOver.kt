package stillwater.diagnose

import java.util.Locale
import kotlin.math.IEEErem
import kotlin.math.PI
import kotlin.math.abs
import kotlin.math.exp
import kotlin.math.expm1
import kotlin.math.sqrt

/**
 * What no cause of the list explains, in words that a reader can look for in the field: [base] is the model without
 * causes, and [chosen] are not enough.
 */
internal class LeftOver(private val base: ModelFit, private val chosen: List<Trial>) {
    private val series = base.model.series

    /** What is left, where it depends on [most]. */
    fun words(most: Dependence): String = "the residuals depend on ${most.description}" +
        (if (most.description == Structure.SLOW) settling() else "") + beside()

    /** An offset that settles: most drifts of a probe that warms up, or is overgrown, level off. */
    private fun settling(): String {
        val residuals = base.residuals
        val mean = residuals.average()
        val all = residuals.sumOf { (it - mean) * (it - mean) }
        val best = TIMES.map { it * series.duration }.map(::settled).minBy { it.left }
        val slow = all - leftBy(Structure.slow(series))
        // As one curve it explains nearly all that six do.
        if (all - best.left < MOST_OF * slow) return ""
        return ": an offset that moves by %.2g and settles within some %.2g s, as of a probe that warms up or is overgrown"
            .format(Locale.ROOT, best.size, SETTLED * best.time)
    }

    private class Settled(val time: Double, val size: Double, val left: Double)

    private fun settled(time: Double): Settled {
        val curve = DoubleArray(series.size) { 1 - exp(-(series.times[it] - series.times[0]) / time) }
        val mean = curve.average()
        val middle = base.residuals.average()
        val squares = curve.sumOf { (it - mean) * (it - mean) }
        val size = if (squares > 0) curve.indices.sumOf { (curve[it] - mean) * base.residuals[it] } / squares else 0.0
        val left = curve.indices.sumOf { i ->
            (base.residuals[i] - middle - size * (curve[i] - mean)).let { it * it }
        }
        return Settled(time, size, left)
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
        return "; ${main.term.cause.label} explains ${(100 * share).toInt()} % of what the base model leaves, and not " +
            "the rest" + if (main.term.cause == Cause.POSITION_OFFSET) turning(main.fit) else ""
    }

    /** A probe on a rigid arm leaves the track where the boat turns, and no shift along the track shows that. */
    private fun turning(fit: ModelFit): String {
        val turned = turned(fit.numbers[ResponseModel.TIME_CONSTANT])
        val most = turned.sortedArray()[(TURNING * (turned.size - 1)).toInt()]
        val (inTurns, straight) = turned.indices.partition { turned[it] > most }
        fun spread(rows: List<Int>) = sqrt(rows.sumOf { fit.residuals[it] * fit.residuals[it] } / maxOf(rows.size, 1))
        return if (spread(inTurns) > MORE * spread(straight)) {
            ", which is largest where the boat turns, as with a probe on a rigid arm"
        } else {
            ""
        }
    }

    /** How fast the boat turns, as a lag of [tau] s shows it. */
    private fun turned(tau: Double): DoubleArray {
        val heading = series.heading
        var state = 0.0
        return DoubleArray(series.size) { i ->
            val before = maxOf(i - 1, 0)
            val dt = series.times[i] - series.times[before]
            val turn = abs((heading[i] - heading[before]).IEEErem(2 * PI)) / maxOf(dt, series.period / 2)
            state += -expm1(-dt / tau) * (turn - state)
            state
        }
    }

    private companion object {
        /** Over the log's duration. */
        val TIMES = listOf(0.02, 0.03, 0.05, 0.08, 0.12, 0.18, 0.25, 0.35, 0.5, 0.7)
        const val MOST_OF = 0.9

        /** Time constants after which 95 % is done. */
        const val SETTLED = 3.0
        const val LEAST_SHARE = 0.1
        const val TURNING = 0.8
        const val MORE = 1.5
    }
}
