package stillwater.diagnose.response

import kotlin.math.exp
import kotlin.math.ln

/** Times that the distance to what is tried on either side of the best is halved. */
private const val REFINEMENTS = 4

/**
 * A place near the one of [best] and what is [at] it, where [worth] is most: looked for between places that are [factor] times
 * as far, on a logarithmic scale.
 */
internal fun <T> refined(
    best: Pair<Double, T>,
    factor: Double,
    worth: (T) -> Double,
    at: (Double) -> T,
): Pair<Double, T> {
    var found = best
    var step = ln(factor)
    repeat(REFINEMENTS) {
        step /= 2
        val beside = listOf(exp(step), exp(-step)).map { found.first * it }.map { it to at(it) }
        found = (beside + found).maxBy { worth(it.second) }
    }
    return found
}
