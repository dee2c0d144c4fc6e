package stillwater.diagnose.evidence

import stillwater.diagnose.algebra.squares
import kotlin.math.abs

/** What the rows beside a row say of it: steps from row to row are taken as even. */
internal object Neighbours {
    /** Rows on either side that are asked. */
    const val REACH = 3

    /** Of the rows 1, 2 and 3 away in the intercept of a least-squares parabola without the middle row. */
    private val WEIGHTS = doubleArrayOf(3.0 / 7, 3.0 / 14, -1.0 / 7)

    /** How far rows are off what those beside them say, from three rows before a single one that is off by 1. */
    val ABOUT_SINGLE: DoubleArray = about(2 * REACH + 1) { if (it == REACH) 1.0 else 0.0 }

    /** The same from three rows before those that a jump by 1 raises. */
    val ABOUT_JUMP: DoubleArray = about(2 * REACH) { if (it >= REACH) 1.0 else 0.0 }

    /**
     * The same from three rows before one that is at a corner, or half a row before or behind it: readings change by 1 a
     * row more from there on, as those of a lag do beyond a sharp front.
     */
    val ABOUT_CORNER: List<DoubleArray> =
        listOf(-0.5, 0.0, 0.5).map { corner -> about(2 * REACH + 1) { abs(it - REACH - corner) / 2 } }

    /** Variance of a row less what is foretold of it, over that of white noise. */
    val errorVariance: Double = 1 + 2 * squares(WEIGHTS)

    /** What a parabola through the three rows on either side says of row [i] of [values]. */
    private fun foretold(values: DoubleArray, i: Int): Double {
        var sum = 0.0
        for (k in 1..REACH) sum += WEIGHTS[k - 1] * (values[i - k] + values[i + k])
        return sum
    }

    /** How far row [i] of [values] is off what a parabola through the three rows on either side says. */
    fun off(values: DoubleArray, i: Int): Double = values[i] - foretold(values, i)

    /** How far the first [rows] of [shape] are off what those beside them say. */
    private fun about(rows: Int, shape: (Int) -> Double): DoubleArray {
        val values = DoubleArray(rows + 2 * REACH) { shape(it - REACH) }
        return DoubleArray(rows) { off(values, it + REACH) }
    }
}
