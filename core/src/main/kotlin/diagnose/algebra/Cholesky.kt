package stillwater.diagnose.algebra

import stillwater.diagnose.Loops
import kotlin.math.ln
import kotlin.math.sqrt

/**
 * L with L Lᵀ = [lower], of which row i holds the first i + 1 elements at least; modified.
 *
 * Rows are arrays of their own, and innermost loops run along them, so that several neighbours are done in one step.
 */
internal class Cholesky(private val lower: Array<DoubleArray>) {
    private val n = lower.size

    /** Logarithm of the determinant. */
    val logDeterminant: Double

    init {
        var sum = 0.0
        val columns = Array(AT_ONCE) { DoubleArray(n) }
        for (j in 0 until n step AT_ONCE) {
            val count = minOf(AT_ONCE, n - j)
            for (c in 0 until count) sum += 2 * ln(column(j + c, columns, c))
            for (c in count until AT_ONCE) columns[c].fill(0.0)
            val (p, q, r) = columns
            val s = columns[3]
            val four = FourColumns(p, q, r, s)
            for (i in j + AT_ONCE until n) four.add(lower[i], j + AT_ONCE, i + 1, -p[i], -q[i], -r[i], -s[i])
        }
        logDeterminant = sum
    }

    /** Finds column [k] of L, from which all but the last [c] columns have been taken off, and returns its pivot. */
    private fun column(k: Int, columns: Array<DoubleArray>, c: Int): Double {
        val own = columns[c]
        var pivot = 1.0
        for (i in k until n) {
            var sum = lower[i][k]
            for (b in 0 until c) sum -= columns[b][i] * columns[b][k]
            if (i == k) pivot = sqrt(maxOf(sum, TINY))
            own[i] = if (i == k) pivot else sum / pivot
            lower[i][k] = own[i]
        }
        return pivot
    }

    /** L⁻¹ [right]; new. */
    fun half(right: DoubleArray): DoubleArray {
        val out = right.copyOf()
        var i = 0
        while (i + AT_ONCE <= n) {
            dots(i, out)
            for (a in i until i + AT_ONCE) {
                val row = lower[a]
                for (k in i until a) out[a] -= row[k] * out[k]
                out[a] /= row[a]
            }
            i += AT_ONCE
        }
        while (i < n) {
            val row = lower[i]
            for (k in 0 until i) out[i] -= row[k] * out[k]
            out[i] /= row[i]
            i++
        }
        return out
    }

    /** Replaces [rows], those of a matrix, by L⁻¹ of it; whole rows are taken off each other. */
    fun halves(rows: Array<DoubleArray>) {
        val all = rows.asList()
        val heights = DoubleArray(n)
        for (a in 0 until n) {
            val own = rows[a]
            val row = lower[a]
            for (k in 0 until a) heights[k] = -row[k]
            Combination.add(all, heights, own, a)
            for (i in own.indices) own[i] /= row[a]
        }
    }

    /** Takes what is known of [out], the elements before [i], off the next four: each sum waits for its own alone. */
    private fun dots(i: Int, out: DoubleArray) {
        val a = lower[i]
        val b = lower[i + 1]
        val c = lower[i + 2]
        val d = lower[i + 3]
        var p = out[i]
        var q = out[i + 1]
        var r = out[i + 2]
        var s = out[i + 3]
        for (k in 0 until i) {
            val known = out[k]
            p -= a[k] * known
            q -= b[k] * known
            r -= c[k] * known
            s -= d[k] * known
        }
        out[i] = p
        out[i + 1] = q
        out[i + 2] = r
        out[i + 3] = s
    }

    /** L⁻ᵀ [right]; new. */
    fun back(right: DoubleArray): DoubleArray {
        val out = right.copyOf()
        for (i in n - 1 downTo 0) {
            out[i] /= lower[i][i]
            subtract(out, out[i], lower[i], 0, i)
        }
        return out
    }

    /** The diagonal of the inverse of what was factorised, in parts that [loops] goes through. */
    fun inverseDiagonal(loops: Loops = Loops.IN_TURN): DoubleArray {
        // Rows of L⁻¹ with zeros behind them, so that four can be added together.
        val inverse = Array(n) { DoubleArray(it + AT_ONCE) }
        val out = DoubleArray(n)
        // Columns depend on none but themselves; the first are the longest.
        val split = n / 5
        loops.each(2) { half -> if (half == 0) invert(inverse, 0, split, out) else invert(inverse, split, n, out) }
        return out
    }

    /** Columns [first] until [end] of L⁻¹ into [inverse], row by row, and their square sums into [out]. */
    private fun invert(inverse: Array<DoubleArray>, first: Int, end: Int, out: DoubleArray) {
        for (i in first until n) {
            val own = inverse[i]
            val row = lower[i]
            var k = first
            while (k + AT_ONCE <= i) {
                FourColumns(inverse[k], inverse[k + 1], inverse[k + 2], inverse[k + 3])
                    .add(own, first, minOf(k + AT_ONCE, end), -row[k], -row[k + 1], -row[k + 2], -row[k + 3])
                k += AT_ONCE
            }
            while (k < i) {
                subtract(own, row[k], inverse[k], first, minOf(k + 1, end))
                k++
            }
            val last = minOf(i, end)
            for (j in first until last) own[j] /= row[i]
            if (i < end) own[i] = 1 / row[i]
            for (j in first until minOf(i + 1, end)) out[j] += own[j] * own[j]
        }
    }

    private fun subtract(from: DoubleArray, times: Double, what: DoubleArray, start: Int, end: Int) {
        for (k in start until end) from[k] -= times * what[k]
    }

    private companion object {
        const val AT_ONCE = 4
        const val TINY = 1e-12
    }
}
