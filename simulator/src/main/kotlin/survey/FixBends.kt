package stillwater.survey

import kotlin.math.hypot
import kotlin.math.sqrt

/**
 * How far fixes scatter from one to the next, from their third differences: these hold 20 times the variance of an error that
 * is new with each fix, and next to nothing of a boat's way. An error that stays for many fixes is not seen.
 *
 * Rows that repeat a fix are passed over. Confined to one thread; memory is bounded.
 */
internal class FixBends {
    private val bends = ThinnedSamples(width = 1)
    private val xs = DoubleArray(FIXES)
    private val ys = DoubleArray(FIXES)
    private var count = 0
    private var isLine = true

    /** Takes the next row's fix, m. */
    fun take(x: Double, y: Double) {
        if (count > 0 && x == xs[FIXES - 1] && y == ys[FIXES - 1]) return
        if (count > 0 && y != ys[FIXES - 1]) isLine = false
        xs.copyInto(xs, 0, 1)
        ys.copyInto(ys, 0, 1)
        xs[FIXES - 1] = x
        ys[FIXES - 1] = y
        if (++count >= FIXES) bends.offer(hypot(bend(xs), bend(ys)))
    }

    private fun bend(of: DoubleArray) = of[3] - 3 * of[2] + 3 * of[1] - of[0]

    /** Standard deviation of a fix along either axis, m; 0 where there are too few fixes to tell. */
    fun scatter(): Double {
        if (count < FEWEST) return 0.0
        // Along a line the median is that of a normal distribution's size, in the plane that of Rayleigh's.
        val median = if (isLine) NORMAL_MEDIAN else RAYLEIGH_MEDIAN
        return Quantiles(bends.column(0)).median / (median * sqrt(THIRD))
    }

    private companion object {
        const val FIXES = 4
        const val FEWEST = 30
        const val NORMAL_MEDIAN = 0.6745
        const val RAYLEIGH_MEDIAN = 1.1774

        /** 1 + 3² + 3² + 1. */
        const val THIRD = 20.0
    }
}
