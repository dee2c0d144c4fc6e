package stillwater.diagnose

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
internal object Jackknife {
    /** p-value above which it is not asked: it only makes causes less sure. */
    const val SURE = 0.01
    private const val STRETCHES = BlindEvidence.STRETCHES

    /** For rounding: numbers that do the same as others, and stretches that none but themselves foretell. */
    private const val RIDGE = 1e-9

    /**
     * Student's t, with one degree of freedom less than there are stretches, of a [change] of the readings that a model
     * has, beside what its [other] numbers change, each as long as the log, where [fit] leaves [z], whitened.
     */
    fun t(fit: BlindFit, z: DoubleArray, change: DoubleArray, other: List<DoubleArray>): Double {
        val all = (listOf(change) + other).map { column ->
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
        val first = gram.back(gram.half(DoubleArray(all.size) { if (it == 0) 1 / all[0].scale else 0.0 }))
        val n = z.size
        val moves = fit.design.loops.all((0 until STRETCHES).toList()) { stretch ->
            val from = (stretch.toLong() * n / STRETCHES).toInt()
            val to = ((stretch + 1).toLong() * n / STRETCHES).toInt()
            val rest = fit.unforeseen(from, to)
            val taken = rest.indices.map { i -> gram.half(DoubleArray(all.size) { all[it].unlike[from + i] }) }
            for (a in rest.indices) {
                for (b in 0..a) rest[a][b] -= dot(taken[a], taken[b])
                rest[a][a] += RIDGE
            }
            val factor = Cholesky(rest)
            val missed = factor.back(factor.half(z.copyOfRange(from, to)))
            missed.indices.sumOf { i -> missed[i] * all.indices.sumOf { first[it] * all[it].unlike[from + i] } }
        }
        val mean = moves.average()
        val variance = moves.sumOf { (it - mean) * (it - mean) } * (STRETCHES - 1) / STRETCHES
        // The change has its own size.
        return 1 / sqrt(maxOf(variance, 1e-290))
    }

    /** A column [white], whitened, and what of it is [unlike] water, both over [scale]. */
    private class Column(val white: DoubleArray, val unlike: DoubleArray, val scale: Double)
}
