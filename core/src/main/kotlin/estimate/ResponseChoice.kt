package stillwater.estimate

import kotlin.math.sqrt
import kotlin.random.Random

/**
 * How one candidate stands beside the best.
 *
 * @property candidate the candidate. @property behind by how much its held-out score is below the best one's.
 * @property error standard error of [behind], from the groups' scatter. @property weight probability given to it; 0
 * if it
 *   is ruled out or a simpler one stands for it.
 */
public class CandidateStanding internal constructor(
    public val candidate: CandidateResponse,
    public val behind: Double,
    public val error: Double,
    public val weight: Double,
) {
    /** Whether the log leaves it open. */
    public val isOpen: Boolean get() = weight > 0
}

/**
 * Which responses a log leaves open, by scores on data that they were not fitted to.
 *
 * A candidate is ruled out if it is behind any other by more than [RULED_OUT] standard errors and by more than
 * [SMALLEST_LOSS]. An asymmetric lag, two unequal lags and two paths give way to what they contain and is still open: two
 * time constants fit noise better than one, and nothing is lost. But where they are ahead of it by more than [AHEAD] standard
 * errors they stay open beside it, because it alone would be far too sure of itself; two paths only if the log says more
 * of the slow path, which hides from a single lag, than was believed beforehand.
 *
 * @property standings all candidates, the most likely first.
 * @property hinted a response with two paths that the log hints at, too weakly to leave it open: it is no less likely
 *   than what is open, and its share is known better than it was believed beforehand. Null without one, or where two paths are open.
 */
public class ResponseChoice private constructor(
    public val standings: List<CandidateStanding>,
    public val hinted: CandidateResponse?,
) {
    /** What the log leaves open, the most likely first; not empty. */
    public val open: List<CandidateResponse> get() = standings.filter { it.isOpen }.map { it.candidate }

    /** The most likely. */
    public val first: CandidateResponse get() = open.first()

    /** Whether more than one response is left open. */
    public val isAmbiguous: Boolean get() = open.size > 1

    /** The open responses with their probabilities, for [TrackCorrector]. */
    public fun likely(): List<LikelyResponse> =
        standings.filter { it.isOpen }.map { LikelyResponse(it.candidate.likely(), it.weight) }

    /** The [hinted] response alone, for [TrackCorrector]; null without one. */
    public fun likelyHint(): LikelyResponse? = hinted?.let { LikelyResponse(it.likely(), 1.0) }

    public companion object {
        /** Standard errors behind the best from which a candidate is ruled out. */
        public const val RULED_OUT: Double = 2.6

        /** Loss in log score that is none. */
        public const val SMALLEST_LOSS: Double = 2.0

        /** Standard errors by which an asymmetric lag or two paths are ahead of something simpler beside which they stay open. */
        public const val AHEAD: Double = 1.0

        private const val DRAWS = 2000

        /** Student's variance is (n − 1) / (n − 3) of that many groups. */
        private const val FEWEST_GROUPS = 3

        /** Kinds that give way to an open one that they contain. */
        private val RICH = setOf(
            ResponseKind.ASYMMETRIC,
            ResponseKind.TWO_LAGS,
            ResponseKind.TWO_PATH,
            ResponseKind.DEAD_TIME_AND_TWO_PATH,
            ResponseKind.FLOW,
        )

        /**
         * The choice among [candidates], at least one, of the same log.
         *
         * @param random for the bootstrap over groups that gives the probabilities. Retained no longer than the call.
         */
        public fun of(candidates: List<CandidateResponse>, random: Random): ResponseChoice {
            require(candidates.isNotEmpty()) { "candidates must not be empty" }
            require(candidates.map { it.heldOut.size }.distinct().size == 1) { "candidates must be of one log" }
            val best = candidates.maxBy { it.heldOutScore }
            val behind = candidates.map { best.heldOutScore - it.heldOutScore }
            val errors = candidates.map { error(best, it) }
            val notRuledOut = candidates.indices.filterNot { i -> candidates.any { rulesOut(it, candidates[i]) } }
            val open = notRuledOut.filterNot { rich ->
                val kind = candidates[rich].kind
                kind in RICH && notRuledOut.any {
                    kind.contains(candidates[it].kind) && !isToldFrom(candidates[rich], candidates[it])
                }
            }
            val weights = weights(open.map { candidates[it] }, random)
            val standings = candidates.indices.map { i ->
                CandidateStanding(
                    candidates[i],
                    behind[i],
                    errors[i],
                    weights.getOrElse(open.indexOf(i)) { 0.0 },
                )
            }
            val inOrder = standings.sortedWith(compareBy({ -it.weight }, { it.behind }))
            return ResponseChoice(inOrder, hinted(open.map { candidates[it] }, notRuledOut.map { candidates[it] }))
        }

        private fun hinted(open: List<CandidateResponse>, notRuledOut: List<CandidateResponse>): CandidateResponse? =
            notRuledOut.filter { it.kind.hasTwoPaths && it.relativeErrors.last() < ResponseKind.BELIEVED }
                .maxByOrNull { it.heldOutScore }
                ?.takeIf { hint -> open.none { it.kind.hasTwoPaths || it.heldOutScore > hint.heldOutScore } }

        /** Not the best alone: how far it is behind that may be told less well than how far behind another. */
        private fun rulesOut(better: CandidateResponse, other: CandidateResponse): Boolean =
            isAhead(better, other, RULED_OUT)

        private fun isToldFrom(rich: CandidateResponse, other: CandidateResponse): Boolean {
            val ofSlowPath = rich.kind.parameters.indices.filter { rich.kind.isBelieved(it) }
            return ofSlowPath.all { rich.relativeErrors[it] < ResponseKind.BELIEVED } && isAhead(rich, other, AHEAD)
        }

        private fun isAhead(one: CandidateResponse, other: CandidateResponse, errors: Double): Boolean {
            val ahead = one.heldOutScore - other.heldOutScore
            return ahead > SMALLEST_LOSS && ahead > errors * error(one, other)
        }

        private fun error(best: CandidateResponse, other: CandidateResponse): Double {
            val n = best.heldOut.size
            if (n <= FEWEST_GROUPS) return Double.POSITIVE_INFINITY
            val differences = DoubleArray(n) { best.heldOut[it] - other.heldOut[it] }
            val mean = differences.average()
            // Of a few groups a standard error is itself uncertain: by so much Student's distribution is wider.
            return sqrt(differences.sumOf { (it - mean) * (it - mean) } / (n - FEWEST_GROUPS) * n)
        }

        /** How often each is the best when the groups are drawn anew. */
        private fun weights(open: List<CandidateResponse>, random: Random): DoubleArray {
            val wins = DoubleArray(open.size)
            val groups = open.first().heldOut.size
            val sums = DoubleArray(open.size)
            repeat(DRAWS) {
                sums.fill(0.0)
                repeat(groups) {
                    val group = random.nextInt(groups)
                    for (k in open.indices) sums[k] += open[k].heldOut[group]
                }
                wins[sums.indices.maxBy { sums[it] }]++
            }
            val total = wins.sum()
            // What the log does not tell apart is not to be told apart by chance either: half is shared evenly.
            return DoubleArray(open.size) { (wins[it] / total + 1.0 / open.size) / 2 }
        }
    }
}
