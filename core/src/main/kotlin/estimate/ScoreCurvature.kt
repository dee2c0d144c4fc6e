package stillwater.estimate

import kotlin.math.sqrt

/**
 * What the blocks' scores say about a few parameters at their maximum: gradients by block, curvature, and from
 * both the parameters' covariance (White 1982, doi:10.2307/1912526: H⁻¹ V H⁻¹, V from groups of blocks).
 *
 * @param dimensions number of parameters, 1 or more. @param groups group of each block, 0 to [groupCount] − 1.
 */
internal class ScoreCurvature(private val dimensions: Int, private val groups: IntArray, private val groupCount: Int) {
    /** Sum of the gradients of each group, `groupCount × dimensions`. */
    private val gradients = DoubleArray(groupCount * dimensions)
    private val hessians = DoubleArray(groupCount * dimensions * dimensions)

    private val beliefGradient = DoubleArray(dimensions)
    private val beliefHessian = DoubleArray(dimensions * dimensions)

    /**
     * Takes the scores about the maximum of their sum and the [belief]: [scores] gives those of all blocks, each parameter
     * moved by its own of [steps].
     */
    fun take(steps: DoubleArray, belief: (DoubleArray) -> Double, scores: (DoubleArray) -> DoubleArray) {
        differences(steps, groups, gradients, hessians, scores)
        differences(steps, intArrayOf(0), beliefGradient, beliefHessian) { doubleArrayOf(belief(it)) }
    }

    private fun differences(
        steps: DoubleArray,
        groups: IntArray,
        gradients: DoubleArray,
        hessians: DoubleArray,
        scores: (DoubleArray) -> DoubleArray,
    ) {
        val centre = scores(DoubleArray(dimensions))
        val up = Array(dimensions) { i -> scores(DoubleArray(dimensions).also { it[i] = steps[i] }) }
        val down = Array(dimensions) { i -> scores(DoubleArray(dimensions).also { it[i] = -steps[i] }) }
        for (i in 0 until dimensions) {
            for (b in groups.indices) {
                gradients[groups[b] * dimensions + i] += (up[i][b] - down[i][b]) / (2 * steps[i])
                hessians[at(groups[b], i, i)] += (up[i][b] - 2 * centre[b] + down[i][b]) / (steps[i] * steps[i])
            }
            for (j in 0 until i) {
                val both = scores(diagonal(i, j, 1.0, steps))
                val neither = scores(diagonal(i, j, -1.0, steps))
                for (b in groups.indices) {
                    val mixed = both[b] + neither[b] + 2 * centre[b] - up[i][b] - down[i][b] - up[j][b] - down[j][b]
                    hessians[at(groups[b], i, j)] += mixed / (2 * steps[i] * steps[j])
                    hessians[at(groups[b], j, i)] += mixed / (2 * steps[i] * steps[j])
                }
            }
        }
    }

    private fun diagonal(i: Int, j: Int, side: Double, steps: DoubleArray) = DoubleArray(dimensions).also {
        it[i] = side * steps[i]
        it[j] = side * steps[j]
    }

    private fun at(group: Int, i: Int, j: Int) = (group * dimensions + i) * dimensions + j

    /** Where the maximum would be without [group], as moves of the parameters: one Newton step. */
    fun without(group: Int): DoubleArray {
        val g = DoubleArray(dimensions) { i -> total(i) + beliefGradient[i] - gradients[group * dimensions + i] }
        val h = Array(dimensions) { i ->
            DoubleArray(dimensions) { j -> believed(i, j) - hessians[at(group, i, j)] }
        }
        val inverse = inverse(h)
        return DoubleArray(dimensions) { i ->
            (0 until dimensions).sumOf { inverse[i][it] * g[it] }.coerceIn(-MOST_STEP, MOST_STEP)
        }
    }

    private fun total(i: Int) = (0 until groupCount).sumOf { gradients[it * dimensions + i] }

    private fun total(i: Int, j: Int) = (0 until groupCount).sumOf { hessians[at(it, i, j)] }

    private fun believed(i: Int, j: Int) = total(i, j) + beliefHessian[at(0, i, j)]

    /** Covariance if the scores were all there is to know, H⁻¹. */
    fun ofCurvature(): Array<DoubleArray> =
        inverse(Array(dimensions) { i -> DoubleArray(dimensions) { j -> believed(i, j) } })

    /** Covariance of the parameters, `dimensions × dimensions`. */
    fun covariance(): Array<DoubleArray> {
        val inverse = ofCurvature()
        val influence = Array(groupCount) { group ->
            DoubleArray(dimensions) { i ->
                (0 until dimensions).sumOf {
                    inverse[i][it] *
                        (gradients[group * dimensions + it] - total(it) / groupCount)
                }
            }
        }
        val small = groupCount / (groupCount - 1.0)
        return Array(dimensions) { i ->
            DoubleArray(dimensions) { j ->
                // The belief's own spread, where it holds up what the scores do not.
                val held = (0 until dimensions).sumOf { a ->
                    (0 until dimensions).sumOf { b -> inverse[i][a] * -beliefHessian[at(0, a, b)] * inverse[b][j] }
                }
                small * influence.sumOf { it[i] * it[j] } + held
            }
        }
    }

    /** Of minus the curvature, held away from zero: a flat direction gets a long but finite error. */
    private fun inverse(hessian: Array<DoubleArray>): Array<DoubleArray> {
        val eigen = SymmetricEigen(Array(dimensions) { i -> DoubleArray(dimensions) { j -> -hessian[i][j] } })
        return Array(dimensions) { i ->
            DoubleArray(dimensions) { j ->
                (0 until dimensions).sumOf {
                    eigen.vectors[it][i] * eigen.vectors[it][j] / maxOf(eigen.values[it], FLAT)
                }
            }
        }
    }

    companion object {
        private const val FLAT = 0.3
        private const val MOST_STEP = 0.7

        /** Directions of one standard error of a parameters' [covariance]. */
        fun axes(covariance: Array<DoubleArray>): List<List<Double>> {
            val eigen = SymmetricEigen(covariance)
            return eigen.values.indices.map { k ->
                eigen.vectors[k].map { it * sqrt(maxOf(eigen.values[k], 0.0)) }
            }
        }
    }
}
