package stillwater.estimate

import kotlin.math.ln

/**
 * Candidates of the kinds of [found], all of this learner, each at least as good as those that it contains: one whose
 * search ended below such a one is searched again from there.
 */
public fun ResponseLearner.atLeastAsNested(found: List<CandidateResponse>): List<CandidateResponse> {
    val best = LinkedHashMap<ResponseKind, CandidateResponse>()
    for (one in found.sortedBy { it.kind.parameters.size }) {
        val begins = best.values.filter { one.kind.contains(it.kind) }.map { nested ->
            val parameters = one.kind.like(nested, shortest)
            parameters to nested.score + one.kind.belief(parameters.logs())
        }
        val ahead = begins.maxByOrNull { it.second }?.takeIf { it.second > one.believed() + CLOSE }
        val other = ahead?.let { near(one.kind, it.first) }
        best[one.kind] = if (other != null && other.believed() > one.believed()) other else one
    }
    return found.map { best.getValue(it.kind) }
}

private fun List<Double>.logs() = DoubleArray(size) { ln(this[it]) }

private fun CandidateResponse.believed() = score + kind.belief(parameters.logs())

/** Parameters of this kind with which it is nearly [nested], a kind that it contains; times of none are [none], s. */
private fun ResponseKind.like(nested: CandidateResponse, none: Double): List<Double> {
    val own = nested.parameters
    return when (nested.kind) {
        ResponseKind.NONE -> parameters.indices.map { if (isTime(it)) none else SMALL }
        ResponseKind.DEAD_TIME -> own + parameters.indices.drop(1).map { if (isTime(it)) none else SMALL }
        ResponseKind.FIRST_ORDER -> when (this) {
            ResponseKind.ASYMMETRIC -> own + own
            ResponseKind.TWO_LAGS, ResponseKind.DEAD_TIME_AND_LAG -> listOf(none) + own
            ResponseKind.FLOW -> own + SMALL
            ResponseKind.TWO_PATH -> own + SLOWER * own[0] + SMALL
            else -> listOf(none) + own + SLOWER * own[0] + SMALL
        }
        ResponseKind.DEAD_TIME_AND_LAG -> own + SLOWER * own[1] + SMALL
        ResponseKind.SECOND_ORDER -> own + own
        else -> listOf(none) + own
    }
}

/** What a search's end is uncertain by, in log score. */
private const val CLOSE = 0.01

/** A share of a slow path, or an exponent, that is next to none. */
private const val SMALL = 0.02

/** Time of a slow path that is next to none, over the fast one's: any does. */
private const val SLOWER = 8.0
