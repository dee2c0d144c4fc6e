package stillwater.estimate

import kotlin.math.exp
import kotlin.math.ln
import kotlin.math.sqrt

/** Learns how a sensor responds from one log: fits one kind of response after the other to the same evidence. */
public interface ResponseLearner {
    /** Number of groups of neighbouring blocks, over which evidence is counted; 0 without any. */
    public val groups: Int

    /** [kind] as it fits best; null where the log holds no evidence on it. */
    public fun candidate(kind: ResponseKind): CandidateResponse?

    /** [kind] as it fits best near [parameters], in their order; null where it is not searched from there. */
    public fun near(kind: ResponseKind, parameters: List<Double>): CandidateResponse? = null

    /** Shortest time that is told from none, s, above 0. */
    public val shortest: Double get() = Double.MIN_VALUE
}

/**
 * Fits one kind of response to scores that blocks of a log give it.
 *
 * @param groupOf group of each block. @param groups number of groups.
 * @param total sum of the scores at the logarithms of the parameters. @param scores one score a block, likewise.
 * @param longest times are not longer than that, s; infinite without an end.
 * @param areFew whether groups are so few that their scatter alone says too little: how the scores bend counts as well.
 * @param isSharp whether the scores may tell a parameter to far less than [CURVATURE_STEP], and are smooth below it.
 */
internal class ResponseFit(
    private val kind: ResponseKind,
    private val groupOf: IntArray,
    private val groups: Int,
    private val total: (DoubleArray) -> Double,
    private val scores: (DoubleArray) -> DoubleArray,
    private val isSharp: Boolean = false,
    private val longest: Double = Double.POSITIVE_INFINITY,
    private val areFew: Boolean = false,
) {
    private val size = kind.parameters.size

    /** The best parameters, searched from those that have one of the mean [delays], s: of each shape the best one. */
    fun best(delays: List<Double>): CandidateResponse {
        if (size == 0) return judged(DoubleArray(0))
        val shapes = delays.map(::starts)
        val begins = shapes.first().indices.map { shape -> shapes.map { it[shape] }.maxBy(::believed) }
        val logs = begins.map { start ->
            Search.simplex(start, DoubleArray(size) { STEP }, EVALUATIONS * size, CLOSE, ::believed)
        }
        return judged(logs.maxBy(::believed))
    }

    private fun believed(logs: DoubleArray) = total(logs) + kind.belief(logs)

    /** The best parameters near [logs]. */
    fun near(logs: DoubleArray): CandidateResponse =
        judged(Search.simplex(logs, DoubleArray(size) { STEP }, EVALUATIONS * maxOf(1, size), CLOSE, ::believed))

    private fun starts(delay: Double): List<DoubleArray> {
        fun logs(vararg times: Double) = DoubleArray(times.size) { ln(times[it]) }
        return when (kind) {
            ResponseKind.NONE, ResponseKind.SLEW -> listOf(logs())
            ResponseKind.FIRST_ORDER, ResponseKind.DEAD_TIME -> listOf(logs(delay))
            ResponseKind.SECOND_ORDER -> listOf(logs(delay / 2))
            ResponseKind.TWO_LAGS -> listOf(0.04, 0.2).map { logs(delay * it, delay * (1 - it)) }
            ResponseKind.DEAD_TIME_AND_LAG -> listOf(0.04, 1 / 3.0, 2 / 3.0).map { logs(delay * it, delay * (1 - it)) }
            ResponseKind.TWO_PATH -> listOf(logs(delay * FAST, delay * 4, 0.1), logs(delay * FAST, delay * 10, 0.05))
            ResponseKind.DEAD_TIME_AND_TWO_PATH -> listOf(0.2, 0.6).map { early ->
                logs(delay * early, delay * (FAST - early).coerceAtLeast(0.1), delay * 6, 0.07)
            }
            ResponseKind.FLOW -> listOf(logs(delay, 0.3), logs(delay, 1.2))
            ResponseKind.ASYMMETRIC -> listOf(logs(delay * MORE, delay / MORE), logs(delay / MORE, delay * MORE))
        }
    }

    private fun judged(logs: DoubleArray): CandidateResponse {
        val at = scores(logs)
        fun moved(move: DoubleArray) = scores(DoubleArray(size) { logs[it] + move[it] })
        val curvature = ScoreCurvature(size, groupOf, groups)
        if (size > 0) {
            fun belief(move: DoubleArray) = kind.belief(DoubleArray(size) { logs[it] + move[it] })
            curvature.take(steps(logs), ::belief, ::moved)
        }
        val heldOut = DoubleArray(groups) { group ->
            val each = if (size == 0) at else moved(curvature.without(group))
            groupOf.indices.sumOf { if (groupOf[it] == group) each[it] else 0.0 }
        }
        val covariance = if (size > 0) curvature.covariance() else emptyArray()
        if (areFew && size > 0) {
            val bend = curvature.ofCurvature()
            for (i in 0 until size) for (j in 0 until size) covariance[i][j] += bend[i][j]
        }
        // From groups this few a standard error is itself uncertain: by so much Student's distribution is wider.
        if (isSharp && groups > FEWEST_GROUPS) {
            val wider = (groups - 1.0) / (groups - FEWEST_GROUPS)
            for (row in covariance) for (i in row.indices) row[i] *= wider
        }
        return CandidateResponse(
            kind,
            List(size) { exp(logs[it]) },
            List(size) { sqrt(covariance[it][it]) },
            ScoreCurvature.axes(covariance),
            at.sum(),
            heldOut,
            (0 until size).filter { kind.isTime(it) && !kind.isSlow(it) && exp(logs[it]) > AT_LONGEST * longest },
        )
    }

    /** By how much each parameter is moved to see how the scores bend: where they are sharp by as little as they fall by. */
    private fun steps(logs: DoubleArray): DoubleArray {
        val steps = DoubleArray(size) { CURVATURE_STEP }
        if (!isSharp) return steps
        val most = believed(logs)
        for (i in 0 until size) {
            fun fall() = 2 * most - listOf(-1, 1).sumOf { side ->
                believed(logs.copyOf().also { it[i] += side * steps[i] })
            }
            while (steps[i] > LEAST_STEP && fall() > MOST_FALL) steps[i] /= 2
        }
        return steps
    }

    private companion object {
        const val STEP = 0.3
        const val EVALUATIONS = 40
        const val CLOSE = 0.005
        const val MORE = 1.2
        const val FAST = 0.8
        const val CURVATURE_STEP = 0.15

        /** Share of the longest time at which a search that was stopped there ends. */
        const val AT_LONGEST = 0.95

        /** Student's variance is (n − 1) / (n − 3) of that many groups. */
        const val FEWEST_GROUPS = 3
        const val LEAST_STEP = 1e-6

        /** Both sides together: about two standard errors to either. */
        const val MOST_FALL = 4.0
    }
}
