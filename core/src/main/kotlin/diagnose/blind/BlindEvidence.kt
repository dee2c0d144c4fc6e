package stillwater.diagnose.blind

import stillwater.diagnose.algebra.squares
import stillwater.diagnose.evidence.Evidence
import kotlin.math.sqrt

/** How strongly residuals speak where the noise is not what its model says. */
internal object BlindEvidence {
    /** Stretches of a log that must agree. */
    const val STRETCHES = 24
    private val BLOCKS = intArrayOf(40, 20, 12)

    /**
     * How many times larger the variance of the score along [columns] is than the noise model says, at least 1: the
     * largest that sums over many short, fewer and few long blocks of rows give, because water that is not resolved is
     * correlated over any time. [columns] are whitened and orthogonal, [z] the whitened residuals.
     */
    fun inflation(columns: List<DoubleArray>, z: DoubleArray): Double = BLOCKS.maxOf { inflation(columns, z, it) }

    private fun inflation(columns: List<DoubleArray>, z: DoubleArray, count: Int): Double {
        var total = 0.0
        for (column in columns) {
            var rows = 0.0
            val sums = DoubleArray(count)
            for (i in z.indices) {
                val score = column[i] * z[i]
                sums[(i.toLong() * count / z.size).toInt()] += score
                rows += score * score
            }
            total += if (rows > 0) squares(sums) / rows else 1.0
        }
        return if (columns.isEmpty()) 1.0 else maxOf(1.0, total / columns.size)
    }

    /**
     * How sure stretches of the log together are of the change [unlike], whitened, where [z] is left without it:
     * Student's t, whatever the noise.
     */
    fun agreed(unlike: DoubleArray, z: DoubleArray): Double {
        val n = z.size
        val scores = DoubleArray(STRETCHES)
        val weights = DoubleArray(STRETCHES)
        for (i in 0 until n) {
            val stretch = (i.toLong() * STRETCHES / n).toInt()
            scores[stretch] += unlike[i] * z[i]
            weights[stretch] += unlike[i] * unlike[i]
        }
        val size = scores.sum() / maxOf(weights.sum(), 1e-300)
        val error = scores.indices.sumOf { (scores[it] - size * weights[it]).let { e -> e * e } }
        return scores.sum() / sqrt(maxOf(error * STRETCHES / (STRETCHES - 1), 1e-300))
    }

    /**
     * How sure stretches of the log together are that [better] foretells each row by all others more surely than
     * [worse]: Student's t. What either leaves of the rows that it was fitted to would speak for the one whose water takes
     * more.
     *
     * Source: Vuong 1989, Likelihood ratio tests for model selection and non-nested hypotheses, doi:10.2307/1912557.
     */
    fun between(worse: BlindState, better: BlindState): Double {
        val a = worse.surprises
        val b = better.surprises
        // What the noises' determinants differ by is the same in all rows.
        val wider = (worse.spare - better.spare) / a.size
        val gains = DoubleArray(STRETCHES)
        for (i in a.indices) gains[(i.toLong() * STRETCHES / a.size).toInt()] += a[i] - b[i] + wider
        return Evidence.t(gains)
    }
}
