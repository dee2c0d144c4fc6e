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
    private val columns = Array(size) { k -> DoubleArray(n).also { noise.whiten(shown[k], it) } }

    /** RᵀR, row-major, the lower half. */
    val gram = DoubleArray(size * size)

    init {
        // Stretches of rows that stay in the nearest cache, and products of three columns with four at a time.
        for (from in 0 until n step STRETCH) {
            for (a in 0 until size step 3) {
                for (b in 0..a + 2 step 4) products(a, b, from, minOf(from + STRETCH, n))
            }
        }
    }

    /** Adds rows [from] until [to] to the products of the columns from [a] with those from [b]. */
    private fun products(a: Int, b: Int, from: Int, to: Int) {
        val last = size - 1
        val x0 = columns[a]
        val x1 = columns[minOf(a + 1, last)]
        val x2 = columns[minOf(a + 2, last)]
        val y0 = columns[minOf(b, last)]
        val y1 = columns[minOf(b + 1, last)]
        val y2 = columns[minOf(b + 2, last)]
        val y3 = columns[minOf(b + 3, last)]
        var s00 = 0.0
        var s01 = 0.0
        var s02 = 0.0
        var s03 = 0.0
        var s10 = 0.0
        var s11 = 0.0
        var s12 = 0.0
        var s13 = 0.0
        var s20 = 0.0
        var s21 = 0.0
        var s22 = 0.0
        var s23 = 0.0
        for (i in from until to) {
            val y = y0[i]
            val z = y1[i]
            val v = y2[i]
            val w = y3[i]
            s00 += x0[i] * y
            s01 += x0[i] * z
            s02 += x0[i] * v
            s03 += x0[i] * w
            s10 += x1[i] * y
            s11 += x1[i] * z
            s12 += x1[i] * v
            s13 += x1[i] * w
            s20 += x2[i] * y
            s21 += x2[i] * z
            s22 += x2[i] * v
            s23 += x2[i] * w
        }
        add(a, b, s00, s01, s02, s03)
        add(a + 1, b, s10, s11, s12, s13)
        add(a + 2, b, s20, s21, s22, s23)
    }

    private fun add(a: Int, b: Int, first: Double, second: Double, third: Double, fourth: Double) {
        if (a >= size) return
        val at = a * size
        if (b <= a) gram[at + b] += first
        if (b + 1 <= a) gram[at + b + 1] += second
        if (b + 2 <= a) gram[at + b + 2] += third
        if (b + 3 <= a) gram[at + b + 3] += fourth
    }

    /** Row [i] of R, length [size]; new. */
    fun row(i: Int): DoubleArray = DoubleArray(size) { columns[it][i] }

    /** Rᵀ [z], length [size]. */
    fun transposed(z: DoubleArray): DoubleArray {
        val out = DoubleArray(size)
        for (k in 0 until size step 4) {
            val a = columns[k]
            val b = columns[minOf(k + 1, size - 1)]
            val c = columns[minOf(k + 2, size - 1)]
            val d = columns[minOf(k + 3, size - 1)]
            var p = 0.0
            var q = 0.0
            var r = 0.0
            var s = 0.0
            for (i in 0 until n) {
                val w = z[i]
                p += a[i] * w
                q += b[i] * w
                r += c[i] * w
                s += d[i] * w
            }
            out[k] = p
            if (k + 1 < size) out[k + 1] = q
            if (k + 2 < size) out[k + 2] = r
            if (k + 3 < size) out[k + 3] = s
        }
        return out
    }

    /** R [beta], length n. */
    fun times(beta: DoubleArray): DoubleArray {
        val out = DoubleArray(n)
        for (k in 0 until size step 4) {
            val last = size - 1
            val a = columns[k]
            val b = columns[minOf(k + 1, last)]
            val c = columns[minOf(k + 2, last)]
            val d = columns[minOf(k + 3, last)]
            val p = beta[k]
            val q = if (k + 1 <= last) beta[k + 1] else 0.0
            val r = if (k + 2 <= last) beta[k + 2] else 0.0
            val s = if (k + 3 <= last) beta[k + 3] else 0.0
            for (i in 0 until n) out[i] += p * a[i] + q * b[i] + r * c[i] + s * d[i]
        }
        return out
    }

    private companion object {
        const val STRETCH = 512
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
            var c = 0.0
            var d = 0.0
            var k = 0
            while (k + 3 < i) {
                a += matrix[at + k] * out[k]
                b += matrix[at + k + 1] * out[k + 1]
                c += matrix[at + k + 2] * out[k + 2]
                d += matrix[at + k + 3] * out[k + 3]
                k += 4
            }
            while (k < i) {
                a += matrix[at + k] * out[k]
                k++
            }
            out[i] = (out[i] - (a + b) - (c + d)) / matrix[at + i]
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
internal class BlindFit private constructor(
    val design: BlindDesign,
    val precisions: DoubleArray,
    val heights: DoubleArray,
    private val factor: FlatCholesky,
) {
    constructor(design: BlindDesign, precisions: DoubleArray, heights: DoubleArray) :
        this(design, precisions, heights, factored(design, precisions))

    private val n = design.noise.spread.size
    private val size = design.size

    /** Rows in use. */
    val rows: Int get() = design.noise.noise.rows
    private val z = DoubleArray(n)
    private val prior = heights.indices.sumOf { precisions[it] * heights[it] * heights[it] }

    /** ln det of the posterior's precision less that of the prior's, and the noise's ln det. */
    val logDeterminant: Double =
        factor.logDeterminant - precisions.sumOf { ln(it) } + design.noise.logDeterminant

    /** The same at other [heights]. */
    fun at(heights: DoubleArray) = BlindFit(design, precisions, heights, factor)

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

    /** L⁻¹ of the pull of [r], whose square sum is what the water takes of it; see [left]. */
    fun taken(r: DoubleArray): DoubleArray = factor.half(pull(r))

    /** What a whitened column [white] moves the water, as [taken] measures it. */
    fun imitated(white: DoubleArray): DoubleArray = factor.half(design.transposed(white))

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

        fun factored(design: BlindDesign, precisions: DoubleArray): FlatCholesky {
            val size = design.size
            val matrix = design.gram.copyOf()
            for (k in 0 until size) matrix[k * size + k] += precisions[k]
            return FlatCholesky(matrix, size)
        }
    }
}
