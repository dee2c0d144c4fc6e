package stillwater.diagnose.blind

import org.hipparchus.linear.Array2DRowRealMatrix
import org.hipparchus.linear.ArrayRealVector
import org.hipparchus.linear.QRDecomposition
import stillwater.diagnose.SineTrack
import kotlin.math.abs
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** What is told of leaving out stretches is what fits without them say. */
class JackknifeTest {
    private val n = 240
    private val stretches = BlindEvidence.STRETCHES
    private val fit = SineTrack(n).fit(BooleanArray(n) { it != 61 })
    private val drift = DoubleArray(n) { it / n.toDouble() }
    private val other = DoubleArray(n) { sin(it / 4.0) * it / n }
    private val rows = fit.design.rows(0, n)

    /** The sizes of [drift] and [other] in [readings] without the rows [out]. */
    private fun sizes(readings: DoubleArray, out: IntRange): DoubleArray {
        val columns = rows.toList() + listOf(drift, other).map(fit::whitened)
        val white = fit.whitened(readings)
        val kept = (0 until n).filter { it !in out }
        val matrix = Array2DRowRealMatrix(kept.size + rows.size, columns.size)
        val right = ArrayRealVector(kept.size + rows.size)
        kept.forEachIndexed { i, row ->
            columns.forEachIndexed { k, column -> matrix.setEntry(i, k, column[row]) }
            right.setEntry(i, white[row])
        }
        for (k in rows.indices) matrix.setEntry(kept.size + k, k, sqrt(fit.precisions[k]))
        return QRDecomposition(matrix).solver.solve(right).toArray().takeLast(2).toDoubleArray()
    }

    /** Standard errors of the sizes of [drift] and [other] in [readings] by fits without each stretch. */
    private fun errors(readings: DoubleArray): List<Double> {
        val all = sizes(readings, IntRange.EMPTY)
        val moves = (0 until stretches).map { stretch ->
            val without = sizes(readings, stretch * n / stretches until (stretch + 1) * n / stretches)
            DoubleArray(2) { all[it] - without[it] }
        }
        return List(2) { k ->
            val mean = moves.sumOf { it[k] } / stretches
            sqrt(moves.sumOf { (it[k] - mean) * (it[k] - mean) } * (stretches - 1) / stretches)
        }
    }

    /** What is left of [readings], whitened. */
    private fun left(readings: DoubleArray): DoubleArray {
        val all = sizes(readings, IntRange.EMPTY)
        return fit.residual(DoubleArray(n) { readings[it] - all[0] * drift[it] - all[1] * other[it] })
    }

    /** Student's t of [drift] in [readings] by fits without each stretch, and as it is told. */
    private fun both(readings: DoubleArray): Pair<Double, Double> {
        val size = sizes(readings, IntRange.EMPTY)[0]
        val change = DoubleArray(n) { size * drift[it] }
        return abs(size) / errors(readings)[0] to Jackknife.t(fit, left(readings), change, listOf(other))
    }

    @Test
    fun errorsOfAllNumbersAreThoseOfFitsWithoutEachStretch() {
        val random = java.util.Random(20261128)
        val readings = DoubleArray(n) { sin(it / 30.0) + 0.4 * drift[it] - other[it] + 0.1 * random.nextGaussian() }
        val told = Jackknife.of(fit, left(readings), listOf(drift, other), Stretches(fit))
        errors(readings).forEachIndexed { k, refitted -> assertEquals(refitted, told.error(k), 1e-5 * refitted) }
    }

    @Test
    fun itIsThatOfFitsWithoutEachStretch() {
        for (seed in 1L..8L) {
            val random = java.util.Random(seed)
            val (refitted, told) =
                both(DoubleArray(n) { sin(it / 30.0) + 0.4 * drift[it] + 0.1 * random.nextGaussian() })
            // Sums of a few hundred products, and a ridge of 1e-9.
            assertEquals(refitted, told, 1e-5 * refitted, "seed $seed")
        }
    }

    /**
     * Errors that each stretch has of its own look like a drift by chance. Of those by noise that the model knows few are
     * beyond 2.8 (1 % of Student's t with 23 degrees of freedom), and not many more are of errors it knows nothing of.
     */
    @Test
    fun whatWandersOtherwiseThanTheNoiseIsSeldomSure() {
        val seed = 20261127
        val random = Random(seed)
        val count = 200
        val sure = (1..count).count {
            val own = DoubleArray(stretches) { random.nextDouble(-1.0, 1.0) }
            both(DoubleArray(n) { i -> own[i * stretches / n] + 0.1 * random.nextDouble(-1.0, 1.0) }).second > 2.81
        }
        assertTrue(sure <= count / 20, "seed $seed: $sure of $count")
    }
}
