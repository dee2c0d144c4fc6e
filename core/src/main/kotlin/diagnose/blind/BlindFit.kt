package stillwater.diagnose.blind

import stillwater.diagnose.algebra.Cholesky
import stillwater.diagnose.algebra.FourColumns
import stillwater.diagnose.algebra.squares
import stillwater.diagnose.independentResiduals
import stillwater.diagnose.noise.CorrelatedNoise
import stillwater.diagnose.noise.PlaceErrors
import stillwater.diagnose.noise.PlacedNoise
import stillwater.diagnose.standardNormal
import kotlin.math.ln
import kotlin.math.sqrt
import kotlin.random.Random

/**
 * How readings are whitened: each is divided by its own spread, then the correlation of [noise] is taken off, and that of
 * what [places] add to it.
 *
 * @property spread relative standard deviation of each row's noise, length n, above 0. @property places errors of fixes;
 *   null where they do nothing.
 */
internal class BlindNoise(
    val noise: CorrelatedNoise,
    val spread: DoubleArray,
    val places: PlaceErrors? = null,
) {
    private val placed = places?.let { PlacedNoise(noise, it) }

    /** The same with [other] for [noise]. */
    fun with(other: CorrelatedNoise) = BlindNoise(other, spread, places)

    /** The same with another [spread]. */
    fun with(spread: DoubleArray) = BlindNoise(noise, spread, places)

    /** The same where [rows] alone are in use. */
    fun over(rows: BooleanArray) = with(noise.over(rows))

    /** Whitens [column] into [out], which may be the same. */
    fun whiten(column: DoubleArray, out: DoubleArray) {
        for (i in column.indices) out[i] = column[i] / spread[i]
        if (placed == null) noise.whiten(out, out) else placed.whiten(out, out)
    }

    /** Whitens [columns] from [from] until [to] where they are, two together: each waits for its own row before. */
    fun whiten(columns: List<DoubleArray>, from: Int, to: Int) {
        for (k in from until to step 2) {
            val one = columns[k]
            if (k + 1 == to) return whiten(one, one)
            val two = columns[k + 1]
            for (i in one.indices) {
                one[i] /= spread[i]
                two[i] /= spread[i]
            }
            if (placed == null) noise.whitenBoth(one, two) else placed.whitenBoth(one, two)
        }
    }

    /** Wᵀ [whitened], where whitening is W: with a column it is what [whitened] is with that, whitened; new. */
    fun turned(whitened: DoubleArray): DoubleArray = DoubleArray(whitened.size).also { turned(whitened, it) }

    private fun turned(whitened: DoubleArray, out: DoubleArray) {
        if (placed == null) noise.turned(whitened, out) else placed.turned(whitened, out)
        for (i in out.indices) out[i] /= spread[i]
    }

    /** Writes what [whitened] is with whitened jumps into [out]: jumps of one unit at each row, which stay. */
    fun jumps(whitened: DoubleArray, out: DoubleArray) {
        turned(whitened, out)
        var sum = 0.0
        for (i in out.indices.reversed()) {
            sum += out[i]
            out[i] = sum
        }
    }

    /** Whether [other] whitens in the same way. */
    fun isSame(other: BlindNoise): Boolean = this === other ||
        (places === other.places && noise.isSame(other.noise) && spread.contentEquals(other.spread))

    /** Sum of ln of the variances that whitening divides by. */
    val logDeterminant: Double = (placed?.logDeterminant ?: noise.logDeterminant) + 2 * spread.sumOf { ln(it) }
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
    private val factor: Cholesky,
) {
    constructor(design: BlindDesign, precisions: DoubleArray, heights: DoubleArray) :
        this(design, precisions, heights, factored(design, precisions))

    private val n = design.noise.spread.size
    private val size = design.size

    /** Rows in use. */
    val rows: Int get() = design.noise.noise.rows
    private val prior = heights.indices.sumOf { precisions[it] * heights[it] * heights[it] }

    /** ln det of the posterior's precision less that of the prior's, and the noise's ln det. */
    val logDeterminant: Double =
        factor.logDeterminant - precisions.sumOf { ln(it) } + design.noise.logDeterminant

    /** The same at other [heights]. */
    fun at(heights: DoubleArray) = BlindFit(design, precisions, heights, factor)

    /** Diagonal of the posterior's covariance over the noise's variance. */
    fun spreads(): DoubleArray = factor.inverseDiagonal(design.loops)

    /** Rᵀ of the whitened residuals [z] less what the prior wants. */
    private fun pull(z: DoubleArray): DoubleArray {
        val right = design.transposed(z)
        for (k in 0 until size) right[k] -= precisions[k] * heights[k]
        return right
    }

    /** What is left of [r], square sum. */
    fun left(r: DoubleArray): Double = whitened(r).let { left(it, taken(it)) }

    /** What is left of residuals that are [z] whitened, where the water takes [taken] of them, square sum. */
    fun left(z: DoubleArray, taken: DoubleArray): Double = maxOf(squares(z) + prior - squares(taken), TINY)

    /** L⁻¹ of the pull of whitened residuals [z], whose square sum is what the water takes of them; see [left]. */
    fun taken(z: DoubleArray): DoubleArray = factor.half(pull(z))

    /** What a whitened column [white] moves the water, as [taken] measures it. */
    fun imitated(white: DoubleArray): DoubleArray = factor.half(design.transposed(white))

    /** The same of each of [white]. */
    fun imitated(white: List<DoubleArray>): List<DoubleArray> = design.transposed(white).map(factor::half)

    /** By how much the water changes to take what it can of [r]. */
    fun change(r: DoubleArray): DoubleArray = moved(whitened(r))

    private fun moved(z: DoubleArray) = factor.back(factor.half(pull(z)))

    /** W(r − Rδ): what is left of [r], whitened. */
    fun residual(r: DoubleArray): DoubleArray {
        val z = whitened(r)
        val shown = design.times(moved(z))
        return DoubleArray(n) { z[it] - shown[it] }
    }

    /**
     * What would be left of readings that the model is right about, whitened, over the noise's standard deviation: [count]
     * draws of the normal numbers whose covariance is I − R H⁻¹ Rᵀ, H = RᵀR + Λ. For ε and ξ independent of variance 1
     * that is the covariance of ε − R H⁻¹ (Rᵀε + Λ^½ ξ).
     */
    fun nullResiduals(count: Int, random: Random): List<DoubleArray> {
        val noise = independentResiduals(design.noise.noise.used).draw(count, random)
        val pulls = design.transposed(noise)
        for (pull in pulls) {
            val prior = standardNormal(size, random)
            for (k in 0 until size) pull[k] += sqrt(precisions[k]) * prior[k]
        }
        val taken = design.times(Array(count) { solved(pulls[it]) })
        for (draw in 0 until count) for (i in 0 until n) noise[draw][i] -= taken[draw][i]
        return noise
    }

    /** [column] of readings, whitened, less what the water can imitate of it. */
    fun unlike(column: DoubleArray): DoubleArray {
        val white = whitened(column)
        val shown = design.times(factor.back(factor.half(design.transposed(white))))
        for (i in 0 until n) white[i] -= shown[i]
        return white
    }

    /**
     * L⁻¹ of the rows [from] until [to] of the derivatives, L Lᵀ the posterior's precision: element (k, i) is the k-th of
     * row from + i.
     */
    fun halfRows(from: Int, to: Int): Array<DoubleArray> = design.rows(from, to).also(factor::halves)

    /**
     * The lower half of I − R_b H⁻¹ R_bᵀ, row by row, R_b the rows [from] until [to] of the derivatives: what is left of
     * these rows, whitened, is that times what all others foretell them wrong by.
     */
    fun unforeseen(from: Int, to: Int): Array<DoubleArray> {
        val count = to - from
        val rest = Array(count) { a -> DoubleArray(a + 1) { b -> if (a == b) 1.0 else 0.0 } }
        val halves = halfRows(from, to)
        val none = DoubleArray(count)
        for (k in halves.indices step AT_ONCE) {
            fun half(c: Int) = halves.getOrElse(k + c) { none }
            val first = half(0)
            val second = half(1)
            val third = half(2)
            val fourth = half(3)
            val four = FourColumns(first, second, third, fourth)
            for (a in 0 until count) four.add(rest[a], 0, a + 1, -first[a], -second[a], -third[a], -fourth[a])
        }
        return rest
    }

    /** H⁻¹ [pulled], H the posterior's precision. */
    fun solved(pulled: DoubleArray): DoubleArray = factor.back(factor.half(pulled))

    /** Jumps at each of [rows], which ascend. */
    fun jumps(rows: List<Int>): List<BlindJump> =
        design.jumps(rows).mapIndexed { k, pulled -> BlindJump(this, rows[k], pulled) }

    /** Heights of which the posterior's covariance is that over the noise's variance, for [signs] of unit covariance. */
    fun drawn(signs: DoubleArray): DoubleArray = factor.back(signs)

    /** [column] whitened. */
    fun whitened(column: DoubleArray): DoubleArray = DoubleArray(n).also { design.noise.whiten(column, it) }

    /** Twice the log-likelihood, less a constant, where [left] is left. */
    fun score(left: Double): Double = -rows * ln(left / rows) - logDeterminant

    private companion object {
        const val TINY = 1e-290
        const val AT_ONCE = 4

        fun factored(design: BlindDesign, precisions: DoubleArray): Cholesky {
            val matrix = Array(design.size) { design.gram[it].copyOf() }
            for (k in matrix.indices) matrix[k][k] += precisions[k]
            return Cholesky(matrix)
        }
    }
}
