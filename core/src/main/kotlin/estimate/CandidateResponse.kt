package stillwater.estimate

import kotlin.math.exp
import kotlin.math.sqrt

/**
 * One response as it fits a log best, with how far it can be trusted.
 *
 * @property kind which response. @property parameters its parameters, in the order of [ResponseKind.parameters].
 * @property relativeErrors standard error of the logarithm of each parameter, from the blocks' own scatter (sandwich),
 *   so that it holds for correlated residuals too; infinite where the log does not determine it.
 * @property axes each row is one direction in which the parameters' logarithms are uncertain, one standard error long.
 * @property score sum of the blocks' log scores at [parameters].
 * @property heldOut log score of each group of neighbouring blocks with the parameters moved one Newton step from the
 *   best ones towards what the other groups alone would give; what the scores assume of the water is learned from all
 *   groups. The same groups for all candidates of one log. Not modified.
 * @property atLongest indices of the times that are as long as any that was looked for, in order: the log shows no
 *   end of them.
 */
public class CandidateResponse internal constructor(
    public val kind: ResponseKind,
    public val parameters: List<Double>,
    public val relativeErrors: List<Double>,
    internal val axes: List<List<Double>>,
    public val score: Double,
    public val heldOut: DoubleArray,
    public val atLongest: List<Int> = emptyList(),
) {
    /** The response at the best parameters. */
    public val response: Response get() = kind.response(*parameters.toDoubleArray())

    /** Parameter [index] as [response] takes it, in its unit: a share is none above [ResponseKind.LARGEST_SHARE]. */
    public fun parameter(index: Int): Double = minOf(parameters[index], kind.most(index))

    /** The 95 % interval of parameter [index], lower to upper end, in its unit; no upper end for one [atLongest]. */
    public fun interval(index: Int): ClosedFloatingPointRange<Double> {
        val factor = exp(TWO_SIDED * relativeErrors[index])
        val most = kind.most(index)
        val end = if (index in atLongest) Double.POSITIVE_INFINITY else parameters[index] * factor
        return minOf(parameters[index] / factor, most)..minOf(end, most)
    }

    /** Whether the log limits each parameter from above: that of a share may reach [ResponseKind.LARGEST_SHARE]. */
    public val isBounded: Boolean get() = parameters.indices.all { interval(it).endInclusive < kind.most(it) }

    /** Sum of [heldOut]. */
    public val heldOutScore: Double get() = heldOut.sum()

    /** Responses about the best one that together have the mean and the spread of what is likely. */
    internal fun likely(): List<Response> {
        val open = atLongest.map { at -> parameters.indices.map { if (it == at) OPEN else 0.0 } }
        val all = axes + open
        // The one in the middle counts as much as each of the others and has no spread.
        val scale = sqrt(all.size + 0.5)
        return listOf(response) + all.flatMap { axis ->
            listOf(-scale, scale).map { side ->
                val moved = parameters.indices.map {
                    parameters[it] * exp((side * axis[it]).coerceIn(-MOST_MOVE, MOST_MOVE))
                }
                kind.response(*moved.toDoubleArray())
            }
        }
    }

    private companion object {
        const val TWO_SIDED = 1.96
        const val MOST_MOVE = 1.5

        /** Where a log shows no end of a time it may as well be a factor of e longer. */
        const val OPEN = 1.0
    }
}
