package stillwater.diagnose

import kotlin.math.ln

/**
 * How readings are whitened: each is divided by its own spread, then the correlation of [noise] is taken off.
 *
 * @property spread relative standard deviation of each row's noise, length n, above 0.
 */
internal class BlindNoise(val noise: CorrelatedNoise, val spread: DoubleArray) {
    private val work = DoubleArray(spread.size)

    /** Whitens [column] into [out], which may be the same. */
    fun whiten(column: DoubleArray, out: DoubleArray) {
        for (i in column.indices) work[i] = column[i] / spread[i]
        noise.whiten(work, out)
    }

    /** Sum of ln of the variances that whitening divides by. */
    val logDeterminant: Double = noise.logDeterminant + 2 * spread.sumOf { ln(it) }
}

/**
 * The waves as the sensor shows them, whitened, and their normal equations: all that is needed to integrate the water
 * out.
 *
 * @param shown each wave as the sensor shows it, not whitened; flat-prior columns last. Retained.
 * @property flat number of columns at the end, and the level, of which nothing is believed.
 */
internal class BlindDesign(shown: Array<DoubleArray>, val noise: BlindNoise) {
    /** Number of columns. */
    val size: Int = shown.size
    private val n = shown[0].size
    private val rows = DoubleArray(n * size)

    /** RᵀR, row-major, the lower half. */
    val gram = DoubleArray(size * size)

    init {
        val z = DoubleArray(n)
        for (k in 0 until size) {
            noise.whiten(shown[k], z)
            for (i in 0 until n) rows[i * size + k] = z[i]
        }
        var i = 0
        while (i + 3 < n) {
            addFour(i)
            i += 4
        }
        while (i < n) {
            for (a in 0 until size) {
                val w = rows[i * size + a]
                for (b in 0..a) gram[a * size + b] += w * rows[i * size + b]
            }
            i++
        }
    }

    private fun addFour(i: Int) {
        val p = i * size
        val q = p + size
        val r = q + size
        val s = r + size
        for (a in 0 until size) {
            val wp = rows[p + a]
            val wq = rows[q + a]
            val wr = rows[r + a]
            val ws = rows[s + a]
            val at = a * size
            for (b in 0..a) {
                gram[at + b] += wp * rows[p + b] + wq * rows[q + b] + wr * rows[r + b] + ws * rows[s + b]
            }
        }
    }

    /** Row [i] of R, length [size]; new. */
    fun row(i: Int): DoubleArray = rows.copyOfRange(i * size, (i + 1) * size)

    /** Rᵀ [z], length [size]. */
    fun transposed(z: DoubleArray): DoubleArray {
        val out = DoubleArray(size)
        for (i in 0 until n) {
            val w = z[i]
            val at = i * size
            if (w != 0.0) for (k in 0 until size) out[k] += w * rows[at + k]
        }
        return out
    }

    /** R [beta], length n. */
    fun times(beta: DoubleArray): DoubleArray {
        val out = DoubleArray(n)
        for (i in 0 until n) {
            var a = 0.0
            var b = 0.0
            val at = i * size
            var k = 0
            while (k + 1 < size) {
                a += rows[at + k] * beta[k]
                b += rows[at + k + 1] * beta[k + 1]
                k += 2
            }
            if (k < size) a += rows[at + k] * beta[k]
            out[i] = a + b
        }
        return out
    }
}

/** L with L Lᵀ = [matrix], row-major [n] × [n], of which the lower half is read and replaced. Modified. */
internal class FlatCholesky(private val matrix: DoubleArray, private val n: Int) {
    /** Logarithm of the determinant. */
    val logDeterminant: Double

    init {
        var sum = 0.0
        // By columns of the remaining triangle, so that the innermost loop runs along rows.
        val column = DoubleArray(n)
        for (j in 0 until n) {
            val pivot = kotlin.math.sqrt(maxOf(matrix[j * n + j], TINY))
            sum += 2 * ln(pivot)
            matrix[j * n + j] = pivot
            for (i in j + 1 until n) {
                column[i] = matrix[i * n + j] / pivot
                matrix[i * n + j] = column[i]
            }
            for (i in j + 1 until n) {
                val w = column[i]
                val at = i * n
                if (w != 0.0) for (k in j + 1..i) matrix[at + k] -= w * column[k]
            }
        }
        logDeterminant = sum
    }

    /** L⁻¹ [right]; new. */
    fun half(right: DoubleArray): DoubleArray {
        val out = right.copyOf()
        for (i in 0 until n) {
            val at = i * n
            var a = 0.0
            var b = 0.0
            var k = 0
            while (k + 1 < i) {
                a += matrix[at + k] * out[k]
                b += matrix[at + k + 1] * out[k + 1]
                k += 2
            }
            if (k < i) a += matrix[at + k] * out[k]
            out[i] = (out[i] - a - b) / matrix[at + i]
        }
        return out
    }

    /** L⁻ᵀ [right]; new. */
    fun back(right: DoubleArray): DoubleArray {
        val out = right.copyOf()
        for (i in n - 1 downTo 0) {
            out[i] /= matrix[i * n + i]
            val w = out[i]
            val at = i * n
            for (k in 0 until i) out[k] -= matrix[at + k] * w
        }
        return out
    }

    /** The diagonal of the inverse of what was factorised. */
    fun inverseDiagonal(): DoubleArray {
        // Row i of L⁻¹ by rows: X = L⁻¹, diagonal of XᵀX.
        val inverse = DoubleArray(n * n)
        val out = DoubleArray(n)
        for (i in 0 until n) {
            val at = i * n
            for (k in 0 until i) {
                val w = matrix[at + k]
                val from = k * n
                if (w != 0.0) for (j in 0..k) inverse[at + j] -= w * inverse[from + j]
            }
            val pivot = matrix[at + i]
            for (j in 0 until i) inverse[at + j] /= pivot
            inverse[at + i] = 1 / pivot
            for (j in 0..i) out[j] += inverse[at + j] * inverse[at + j]
        }
        return out
    }

    private companion object {
        const val TINY = 1e-12
    }
}

/**
 * A log without a reference under one model, with the water integrated out.
 *
 * For residuals r of the model at the water's heights β̂, and readings' derivatives R by the heights,
 * min over δ of |W(r − Rδ)|² + (β̂ + δ)ᵀΛ(β̂ + δ) is what is left once the water has taken what it can.
 *
 * @property design the derivatives. @property precisions Λ's diagonal. @property heights β̂.
 */
internal class BlindFit(val design: BlindDesign, val precisions: DoubleArray, val heights: DoubleArray) {
    private val n = design.noise.spread.size
    private val size = design.size

    /** Rows in use. */
    val rows: Int get() = design.noise.noise.rows
    private val factor: FlatCholesky = FlatCholesky(
        design.gram.copyOf().also { h -> for (k in 0 until size) h[k * size + k] += precisions[k] },
        size,
    )
    private val z = DoubleArray(n)
    private val prior = heights.indices.sumOf { precisions[it] * heights[it] * heights[it] }

    /** ln det of the posterior's precision less that of the prior's, and the noise's ln det. */
    val logDeterminant: Double =
        factor.logDeterminant - precisions.sumOf { ln(it) } + design.noise.logDeterminant

    /** Diagonal of the posterior's covariance over the noise's variance. */
    fun spreads(): DoubleArray = factor.inverseDiagonal()

    private fun pull(r: DoubleArray): DoubleArray {
        design.noise.whiten(r, z)
        val right = design.transposed(z)
        for (k in 0 until size) right[k] -= precisions[k] * heights[k]
        return right
    }

    /** What is left of [r], square sum. */
    fun left(r: DoubleArray): Double {
        val half = factor.half(pull(r))
        return maxOf(squares(z) + prior - squares(half), TINY)
    }

    /** By how much the water changes to take what it can of [r]. */
    fun change(r: DoubleArray): DoubleArray = factor.back(factor.half(pull(r)))

    /** W(r − Rδ): what is left of [r], whitened. */
    fun residual(r: DoubleArray): DoubleArray {
        val shown = design.times(change(r))
        design.noise.whiten(r, z)
        return DoubleArray(n) { z[it] - shown[it] }
    }

    /** [column] of readings, whitened, less what the water can imitate of it. */
    fun unlike(column: DoubleArray): DoubleArray {
        val white = DoubleArray(n)
        design.noise.whiten(column, white)
        val shown = design.times(factor.back(factor.half(design.transposed(white))))
        for (i in 0 until n) white[i] -= shown[i]
        return white
    }

    /** L⁻¹ of row [i] of the derivatives, L Lᵀ the posterior's precision. */
    fun halfRow(i: Int): DoubleArray = factor.half(design.row(i))

    /** [column] whitened. */
    fun whitened(column: DoubleArray): DoubleArray = DoubleArray(n).also { design.noise.whiten(column, it) }

    /** Twice the log-likelihood, less a constant, where [left] is left. */
    fun score(left: Double): Double = -rows * ln(left / rows) - logDeterminant

    private companion object {
        const val TINY = 1e-290
    }
}
