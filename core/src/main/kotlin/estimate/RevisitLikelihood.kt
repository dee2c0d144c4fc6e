package stillwater.estimate

import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.ln1p
import kotlin.math.sqrt

/** How smooth a Gaussian field is: Matérn's ν. */
internal enum class Smoothness(val nu: Double) {
    ROUGH(0.5),
    USUAL(1.5),
    SMOOTH(2.5),
    ;

    /** k(r) at q = 2ν r². */
    fun covariance(q: Double): Double {
        val r = sqrt(q)
        return when (this) {
            ROUGH -> exp(-r)
            USUAL -> (1 + r) * exp(-r)
            SMOOTH -> (1 + r + q / 3) * exp(-r)
        }
    }
}

/**
 * How alike readings are at two places and times: k = M(|Δx| / length) + own · M(Δt / ownTime) + noise, M Matérn's
 * covariance. The first part is the water's and shared by all passes; the second is each pass's own, because the water
 * has changed in between, or the sensor's mood.
 *
 * @property length m. @property own variance over that of the shared part. @property ownTime s. @property noise
 * variance of
 *   a node's noise over that of the shared part.
 */
internal data class FieldScale(
    val length: Double,
    val own: Double,
    val ownTime: Double,
    val noise: Double,
    val smoothness: Smoothness = Smoothness.USUAL,
)

/**
 * How well each block of a track is foretold by the other passes through its water.
 *
 * The values are a Gaussian process of locally unknown scale; a block's score is the logarithm of the density of its
 * values given those of the other passes, which is Student's. See core/docs/TrackCorrection.md, (4) and (5).
 */
internal class RevisitLikelihood(private val nodes: TrackNodes, private val blocks: List<RevisitBlock>) {
    private val factors = Array(blocks.size) { DoubleArray(size(it) * size(it)) }
    private val quadratics = DoubleArray(blocks.size)
    private val givenQuadratics = DoubleArray(blocks.size)
    private val logDeterminants = DoubleArray(blocks.size)
    private val solved = DoubleArray(blocks.indices.maxOfOrNull { size(it) } ?: 0)
    private val places = IntArray(solved.size)

    /** Values in block [index] and its passes. */
    private fun size(index: Int) = blocks[index].lengths.sum()

    private fun own(index: Int) = blocks[index].lengths.last()

    /** Takes the field to be of [scale] from now on. */
    fun assume(scale: FieldScale) {
        for (index in blocks.indices) {
            gather(blocks[index])
            val size = size(index)
            covariance(factors[index], size, scale)
            logDeterminants[index] = decompose(factors[index], size, size - own(index))
        }
    }

    private fun gather(block: RevisitBlock) {
        var at = 0
        for (run in block.firsts.indices) {
            for (i in 0 until block.lengths[run]) places[at++] = block.firsts[run] + i
        }
    }

    private fun covariance(out: DoubleArray, size: Int, scale: FieldScale) {
        val perLength = 2 * scale.smoothness.nu / (scale.length * scale.length)
        val perTime = 2 * Smoothness.ROUGH.nu / (scale.ownTime * scale.ownTime)
        for (i in 0 until size) {
            val a = places[i]
            for (j in 0 until i) {
                val b = places[j]
                val dx = nodes.xs[a] - nodes.xs[b]
                val dy = nodes.ys[a] - nodes.ys[b]
                val dt = nodes.times[a] - nodes.times[b]
                val shared = scale.smoothness.covariance((dx * dx + dy * dy) * perLength)
                val own = Smoothness.ROUGH.covariance(dt * dt * perTime)
                out[i * size + j] = LEVEL + shared + scale.own * own
            }
            out[i * size + i] = 1 + LEVEL + scale.own + scale.noise + JITTER
        }
    }

    /** Cholesky in place, lower triangle; returns the logarithm of the determinant from row [from] on. */
    private fun decompose(factor: DoubleArray, size: Int, from: Int): Double {
        var logDeterminant = 0.0
        for (i in 0 until size) {
            val row = i * size
            for (j in 0 until i) {
                val other = j * size
                var s = factor[row + j]
                for (k in 0 until j) s -= factor[row + k] * factor[other + k]
                factor[row + j] = s / factor[other + j]
            }
            var d = factor[row + i]
            for (k in 0 until i) d -= factor[row + k] * factor[row + k]
            factor[row + i] = sqrt(maxOf(d, JITTER))
            if (i >= from) logDeterminant += 2 * ln(factor[row + i])
        }
        return logDeterminant
    }

    /** Takes [values], one a node, to be judged from now on. Not modified, not retained. */
    fun take(values: DoubleArray) {
        for (index in blocks.indices) solve(index, values)
    }

    private fun solve(index: Int, values: DoubleArray) {
        gather(blocks[index])
        val size = size(index)
        var level = 0.0
        for (i in 0 until size) level += values[places[i]] / size
        val factor = factors[index]
        val given = size - own(index)
        var sum = 0.0
        var sumGiven = 0.0
        for (i in 0 until size) {
            var z = values[places[i]] - level
            for (j in 0 until i) z -= factor[i * size + j] * solved[j]
            z /= factor[i * size + i]
            solved[i] = z
            sum += z * z
            if (i < given) sumGiven += z * z
        }
        quadratics[index] = sum
        givenQuadratics[index] = sumGiven
    }

    /**
     * log p(block | other passes), both Student's with [FREEDOM] degrees of freedom, at the variance [amplitude] of the
     * field, sensor units²; without what depends on the numbers of readings only.
     */
    fun score(index: Int, amplitude: Double): Double {
        val n = size(index)
        val m = n - blocks[index].lengths.last()
        return -(n - m) / 2.0 * ln(amplitude) - logDeterminants[index] / 2 -
            (FREEDOM + n) / 2 * ln1p(quadratics[index] / (FREEDOM * amplitude)) +
            (FREEDOM + m) / 2 * ln1p(givenQuadratics[index] / (FREEDOM * amplitude))
    }

    /** Sum of all blocks' scores. */
    fun total(amplitude: Double): Double {
        var sum = 0.0
        for (index in blocks.indices) sum += score(index, amplitude)
        return sum
    }

    /** The variance of the field that suits all blocks best, sensor units². */
    fun bestAmplitude(): Double {
        var usual = 0.0
        for (i in blocks.indices) usual += quadratics[i] / size(i) / blocks.size
        val from = ln(maxOf(usual, LEAST)) - WIDE
        return exp(Search.maximum(from, from + WIDE + 2, STEPS) { total(exp(it)) })
    }

    private companion object {
        /** How far blocks differ in scale: Student's degrees of freedom. */
        const val FREEDOM = 5.0

        /** Variance of the field's level over that of its variation. */
        const val LEVEL = 10.0
        const val JITTER = 1e-9
        const val LEAST = 1e-300
        const val WIDE = 8.0
        const val STEPS = 20
    }
}
