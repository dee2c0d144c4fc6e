package stillwater.diagnose.track

import kotlin.math.sqrt

/**
 * Smooth courses through a noisy column: as near to it, and with as small fourth differences, as a stiffness says
 * (Whittaker 1922; with even times its response is 1 / (1 + stiffness · ω⁸)).
 *
 * Where water has a shortest wave this parts it from noise far more sharply than a cubic spline, 1 / (1 + ω⁴): what
 * that leaves of the noise is enough, in a log of thousands of rows, to look like a response of another shape.
 *
 * Source: Eilers 2003, A perfect smoother, Analytical Chemistry 75, doi:10.1021/ac034173t.
 *
 * @param isBroken whether a course starts anew at a row, length n.
 */
internal class SmoothCourse(private val column: DoubleArray, private val isBroken: BooleanArray) {
    /** The course of [stiffness], the column's units; a stretch too short to have fourth differences is as it was. */
    fun of(stiffness: Double): DoubleArray {
        val out = column.copyOf()
        var from = 0
        for (i in 1..column.size) {
            if (i < column.size && !isBroken[i]) continue
            if (i - from > ORDER) smooth(out, from, i, stiffness)
            from = i
        }
        return out
    }

    /** Solves (1 + stiffness DᵀD) course = column for rows [from] until [to] by a banded Cholesky factor. */
    private fun smooth(out: DoubleArray, from: Int, to: Int, stiffness: Double) {
        val n = to - from
        // lower[i][k] stands k columns left of the diagonal.
        val lower = Array(n) { DoubleArray(ORDER + 1) }
        for (i in 0 until n) lower[i][0] = 1.0
        for (first in 0 until n - ORDER) {
            for (a in 0..ORDER) for (b in 0..a) lower[first + a][a - b] += stiffness * WEIGHTS[a] * WEIGHTS[b]
        }
        for (i in 0 until n) {
            for (k in minOf(ORDER, i) downTo 0) {
                var sum = lower[i][k]
                for (m in k + 1..minOf(ORDER, i)) sum -= lower[i][m] * lower[i - k][m - k]
                lower[i][k] = if (k == 0) sqrt(sum) else sum / lower[i - k][0]
            }
        }
        for (i in 0 until n) {
            var sum = out[from + i]
            for (k in 1..minOf(ORDER, i)) sum -= lower[i][k] * out[from + i - k]
            out[from + i] = sum / lower[i][0]
        }
        for (i in n - 1 downTo 0) {
            var sum = out[from + i]
            for (k in 1..minOf(ORDER, n - 1 - i)) sum -= lower[i + k][k] * out[from + i + k]
            out[from + i] = sum / lower[i][0]
        }
    }

    companion object {
        private const val ORDER = 4
        private val WEIGHTS = doubleArrayOf(1.0, -4.0, 6.0, -4.0, 1.0)

        /** From waves of some five rows, which halve, to those of some thirty. */
        val STIFFNESSES: List<Double> = List(8) { Math.pow(10.0, it - 1.0) }
    }
}
