package stillwater.diagnose.blind

import stillwater.diagnose.algebra.Cholesky
import stillwater.diagnose.algebra.dot
import kotlin.math.sqrt

/**
 * How sure a change of the readings is where each stretch of a log without a reference is foretold by all others.
 *
 * With M = I − R H⁻¹ Rᵀ, which takes off what the water can imitate, C the whitened columns of the change and of the
 * model's other numbers, U = M C and G = Cᵀ U, the residuals are P y with P = M − U G⁻¹ Uᵀ. Without its stretch b the
 * change would be smaller by the first of
 *
 *     G⁻¹ U_bᵀ P_bb⁻¹ z_b,
 *
 * z the residuals. What the water has taken of a stretch's errors is given back so: residuals themselves are small where
 * few passes meet, and scores made of them agree there whatever the errors are.
 *
 * Source: the delete-a-group jackknife and its closed form, MacKinnon, Nielsen and Webb 2023, Leverage, influence, and the
 * jackknife in clustered regression models, doi:10.1177/1536867X231212433.
 */
internal class Jackknife private constructor(private val moves: Array<DoubleArray>) {
    /** Standard error of the size of column [i]. */
    fun error(i: Int): Double {
        val own = moves[i]
        val mean = own.average()
        val variance = own.sumOf { (it - mean) * (it - mean) } * (STRETCHES - 1) / STRETCHES
        return sqrt(maxOf(variance, 1e-290))
    }

    companion object {
        /** p-value above which it is not asked: it only makes causes less sure. */
        const val SURE = 0.01
        private const val STRETCHES = Stretches.COUNT

        /** For rounding: numbers that do the same as others, and stretches that none but themselves foretell. */
        private const val RIDGE = 1e-9

        /**
         * Of [columns], by what readings change with each of the model's numbers, as long as the log, where [fit] leaves [z],
         * whitened. @param stretches those of [fit].
         */
        fun of(
            fit: BlindFit,
            z: DoubleArray,
            columns: List<DoubleArray>,
            stretches: Stretches = Stretches(fit),
        ): Jackknife {
            val all = columns.map { column ->
                val white = fit.whitened(column)
                val unlike = fit.unlike(column)
                val scale = sqrt(maxOf(dot(white, unlike), 1e-290))
                for (i in white.indices) {
                    white[i] /= scale
                    unlike[i] /= scale
                }
                Column(white, unlike, scale)
            }
            val gram = Cholesky(
                Array(all.size) { a ->
                    DoubleArray(a + 1) { b -> dot(all[a].white, all[b].unlike) + if (a == b) RIDGE else 0.0 }
                },
            )
            val moves = stretches.each { from, to, rest ->
                val taken = rest.indices.map { i -> gram.half(DoubleArray(all.size) { all[it].unlike[from + i] }) }
                for (a in rest.indices) {
                    for (b in 0..a) rest[a][b] -= dot(taken[a], taken[b])
                    rest[a][a] += RIDGE
                }
                val factor = Cholesky(rest)
                val missed = factor.back(factor.half(z.copyOfRange(from, to)))
                val pulled = all.map { column -> missed.indices.sumOf { missed[it] * column.unlike[from + it] } }
                gram.back(gram.half(pulled.toDoubleArray()))
            }
            return Jackknife(Array(all.size) { k -> DoubleArray(STRETCHES) { moves[it][k] / all[k].scale } })
        }

        /**
         * Student's t, with one degree of freedom less than there are stretches, of a [change] of the readings that a model
         * has, beside what its [other] numbers change, each as long as the log, where [fit] leaves [z], whitened.
         */
        fun t(fit: BlindFit, z: DoubleArray, change: DoubleArray, other: List<DoubleArray>): Double =
            // The change has its own size.
            1 / of(fit, z, listOf(change) + other).error(0)
    }

    /** A column [white], whitened, and what of it is [unlike] water, both over [scale]. */
    private class Column(val white: DoubleArray, val unlike: DoubleArray, val scale: Double)
}
