package stillwater.estimate

import kotlin.math.abs
import kotlin.math.sqrt

/**
 * What the blocks' scores say about one or two parameters at their maximum: gradients by block, curvature, and from
 * both
 * the parameters' covariance (White 1982, doi:10.2307/1912526: H⁻¹ V H⁻¹, V from groups of blocks).
 *
 * @param dimensions number of parameters, 1 or 2. @param groups group of each block, 0 to [groupCount] − 1.
 */
internal class ScoreCurvature(private val dimensions: Int, private val groups: IntArray, private val groupCount: Int) {
    /** Sum of the gradients of each group, `groupCount × dimensions`. */
    private val gradients = DoubleArray(groupCount * dimensions)
    private val hessians = DoubleArray(groupCount * dimensions * dimensions)

    /** Takes the scores about the maximum: [scores] gives those of all blocks, moved by so many [step]s. */
    fun take(step: Double, scores: (DoubleArray) -> DoubleArray) {
        val centre = scores(DoubleArray(dimensions))
        val up = Array(dimensions) { i -> scores(DoubleArray(dimensions).also { it[i] = step }) }
        val down = Array(dimensions) { i -> scores(DoubleArray(dimensions).also { it[i] = -step }) }
        for (i in 0 until dimensions) {
            for (b in groups.indices) {
                gradients[groups[b] * dimensions + i] += (up[i][b] - down[i][b]) / (2 * step)
                hessians[at(groups[b], i, i)] += (up[i][b] - 2 * centre[b] + down[i][b]) / (step * step)
            }
        }
        if (dimensions < 2) return
        val both = scores(doubleArrayOf(step, step))
        val neither = scores(doubleArrayOf(-step, -step))
        for (b in groups.indices) {
            val mixed = (both[b] + neither[b] + 2 * centre[b] - up[0][b] - down[0][b] - up[1][b] - down[1][b]) /
                (2 * step * step)
            hessians[at(groups[b], 0, 1)] += mixed
            hessians[at(groups[b], 1, 0)] += mixed
        }
    }

    private fun at(group: Int, i: Int, j: Int) = (group * dimensions + i) * dimensions + j

    /** Where the maximum would be without [group], as moves of the parameters: one Newton step. */
    fun without(group: Int): DoubleArray {
        val g = DoubleArray(dimensions) { i -> total(i) - gradients[group * dimensions + i] }
        val h = Array(dimensions) { i ->
            DoubleArray(dimensions) { j -> total(i, j) - hessians[at(group, i, j)] }
        }
        val inverse = inverse(h)
        return DoubleArray(dimensions) { i ->
            (0 until dimensions).sumOf { inverse[i][it] * g[it] }.coerceIn(-MOST_STEP, MOST_STEP)
        }
    }

    private fun total(i: Int) = (0 until groupCount).sumOf { gradients[it * dimensions + i] }

    private fun total(i: Int, j: Int) = (0 until groupCount).sumOf { hessians[at(it, i, j)] }

    /** Covariance of the parameters, `dimensions × dimensions`. */
    fun covariance(): Array<DoubleArray> {
        val inverse = inverse(Array(dimensions) { i -> DoubleArray(dimensions) { j -> total(i, j) } })
        val influence = Array(groupCount) { group ->
            DoubleArray(dimensions) { i ->
                (0 until dimensions).sumOf {
                    inverse[i][it] *
                        (gradients[group * dimensions + it] - total(it) / groupCount)
                }
            }
        }
        val small = groupCount / (groupCount - 1.0)
        return Array(dimensions) { i -> DoubleArray(dimensions) { j -> small * influence.sumOf { it[i] * it[j] } } }
    }

    /** Of minus the curvature, held away from zero: a flat direction gets a long but finite error. */
    private fun inverse(hessian: Array<DoubleArray>): Array<DoubleArray> {
        if (dimensions == 1) return arrayOf(doubleArrayOf(1 / maxOf(-hessian[0][0], FLAT)))
        val (values, angle) = eigen(-hessian[0][0], -hessian[0][1], -hessian[1][1])
        val a = 1 / maxOf(values[0], FLAT)
        val b = 1 / maxOf(values[1], FLAT)
        val (c, s) = angle
        return arrayOf(
            doubleArrayOf(a * c * c + b * s * s, (a - b) * c * s),
            doubleArrayOf((a - b) * c * s, a * s * s + b * c * c),
        )
    }

    companion object {
        private const val FLAT = 0.3
        private const val MOST_STEP = 0.7

        /** Eigenvalues of [a, b; b, c], and cosine and sine of the first one's direction. */
        private fun eigen(a: Double, b: Double, c: Double): Pair<DoubleArray, DoubleArray> {
            val middle = (a + c) / 2
            val half = (a - c) / 2
            val root = sqrt(half * half + b * b)
            val values = doubleArrayOf(middle + root, middle - root)
            val x = if (abs(b) > 0) {
                b
            } else if (a >= c) {
                1.0
            } else {
                0.0
            }
            val y = if (abs(b) > 0) {
                values[0] - a
            } else if (a >= c) {
                0.0
            } else {
                1.0
            }
            val length = sqrt(x * x + y * y)
            return values to doubleArrayOf(x / length, y / length)
        }

        /** Directions of one standard error of a covariance of one or two parameters. */
        fun axes(covariance: Array<DoubleArray>): List<List<Double>> {
            if (covariance.isEmpty()) return emptyList()
            if (covariance.size == 1) return listOf(listOf(sqrt(covariance[0][0])))
            val (values, angle) = eigen(covariance[0][0], covariance[0][1], covariance[1][1])
            val first = sqrt(maxOf(values[0], 0.0))
            val second = sqrt(maxOf(values[1], 0.0))
            return listOf(
                listOf(first * angle[0], first * angle[1]),
                listOf(-second * angle[1], second * angle[0]),
            )
        }
    }
}
