package stillwater.estimate

import kotlin.math.ln
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** Which responses stay open, by scores written by hand. */
class ResponseChoiceTest {
    /** A candidate whose scores in ten groups are [mean] and, in turn, [spread] more and less. */
    private fun candidate(kind: ResponseKind, mean: Double, spread: Double, error: Double = 0.3) = CandidateResponse(
        kind,
        kind.parameters.map { if (it == "slow_share") 0.1 else 5.0 },
        kind.parameters.map { error },
        emptyList(),
        0.0,
        DoubleArray(GROUPS) { mean + if (it % 2 == 0) spread else -spread },
    )

    private fun open(vararg candidates: CandidateResponse) =
        ResponseChoice.of(candidates.toList(), Random(1)).open.map { it.kind }.toSet()

    private val lag = candidate(ResponseKind.FIRST_ORDER, 100.0, 0.0)

    @Test
    fun twoPathsStayOpenBesideALagThatTheyForetellBetterThan() {
        // Ahead by 20 with a standard error of 2 · √10 · √(10 / 9): neither is ruled out, and neither alone is sure.
        val kinds = setOf(ResponseKind.FIRST_ORDER, ResponseKind.TWO_PATH)
        for (spread in listOf(3.0, 5.0)) {
            assertEquals(kinds, open(lag, candidate(ResponseKind.TWO_PATH, 102.0, spread)), "spread $spread")
        }
        // By less than one standard error, by nothing, or where its slow path is as open as it was beforehand.
        for (rich in listOf(
            candidate(ResponseKind.TWO_PATH, 102.0, 7.0),
            candidate(ResponseKind.TWO_PATH, 100.1, 0.0),
            candidate(ResponseKind.TWO_PATH, 102.0, 3.0, error = 1.1),
        )) {
            assertEquals(setOf(ResponseKind.FIRST_ORDER), open(lag, rich))
        }
        // And alone where the lag is ruled out.
        assertEquals(setOf(ResponseKind.TWO_PATH), open(lag, candidate(ResponseKind.TWO_PATH, 102.0, 0.5)))
    }

    @Test
    fun anAsymmetricLagStaysOpenBesideALagThatItForetellsBetterThan() {
        val kinds = setOf(ResponseKind.FIRST_ORDER, ResponseKind.ASYMMETRIC)
        assertEquals(kinds, open(lag, candidate(ResponseKind.ASYMMETRIC, 102.0, 5.0)))
        assertEquals(setOf(ResponseKind.FIRST_ORDER), open(lag, candidate(ResponseKind.ASYMMETRIC, 102.0, 7.0)))
        assertEquals(setOf(ResponseKind.FIRST_ORDER), open(lag, candidate(ResponseKind.ASYMMETRIC, 100.1, 0.0)))
        assertEquals(setOf(ResponseKind.ASYMMETRIC), open(lag, candidate(ResponseKind.ASYMMETRIC, 102.0, 0.5)))
    }

    @Test
    fun aSlowPathThatIsToldTooWeaklyToStayOpenIsHintedAt() {
        fun hinted(vararg of: CandidateResponse) = ResponseChoice.of(of.toList(), Random(1)).hinted?.kind
        val level = candidate(ResponseKind.TWO_PATH, 100.1, 0.0)
        assertEquals(ResponseKind.TWO_PATH, hinted(lag, level))
        assertEquals(null, hinted(lag, candidate(ResponseKind.TWO_PATH, 99.9, 0.0)), "behind what is open")
        val better = candidate(ResponseKind.DEAD_TIME_AND_TWO_PATH, 100.15, 0.0)
        assertEquals(ResponseKind.DEAD_TIME_AND_TWO_PATH, hinted(lag, level, better))
        // Not where its share is as open as beforehand, where it is ruled out, or where it is open anyway.
        assertEquals(null, hinted(lag, candidate(ResponseKind.TWO_PATH, 100.1, 0.0, error = 1.1)))
        assertEquals(null, hinted(lag, candidate(ResponseKind.TWO_PATH, 98.0, 0.1)))
        assertEquals(null, hinted(lag, candidate(ResponseKind.TWO_PATH, 102.0, 3.0)))
        assertEquals(null, hinted(lag))
        val undone = requireNotNull(ResponseChoice.of(listOf(lag, level), Random(1)).likelyHint()).responses
        assertTrue(undone.all { it.slowShare > 0 }, "$undone")
        assertEquals(null, ResponseChoice.of(listOf(lag), Random(1)).likelyHint())
    }

    @Test
    fun aShareIsNeverMoreThanTheResponseTakes() {
        val wide = candidate(ResponseKind.TWO_PATH, 0.0, 0.0, error = 3.0)
        assertEquals(ResponseKind.LARGEST_SHARE, wide.interval(2).endInclusive)
        val parameters = listOf(5.0, 40.0, 1.7)
        val errors = List(3) { 0.1 }
        val beyond = CandidateResponse(ResponseKind.TWO_PATH, parameters, errors, emptyList(), 0.0, doubleArrayOf())
        assertEquals(ResponseKind.LARGEST_SHARE, beyond.parameter(2))
        assertEquals(beyond.response.slowShare, beyond.parameter(2))
        assertEquals(40.0, beyond.parameter(1))
    }

    @Test
    fun likelyResponsesSpreadAsTheFitIsUncertain() {
        val axes = listOf(listOf(0.1, 0.05), listOf(-0.02, 0.2))
        val errors = axes[0].indices.map { i -> sqrt(axes.sumOf { it[i] * it[i] }) }
        val kind = ResponseKind.ASYMMETRIC
        val two = CandidateResponse(kind, listOf(5.0, 2.0), errors, axes, 0.0, doubleArrayOf())
        val drawn = two.likely().map { likely -> likely.lags.single().let { listOf(ln(it.rising), ln(it.falling)) } }
        for (i in errors.indices) {
            val mean = drawn.map { it[i] }.average()
            assertEquals(ln(two.parameters[i]), mean, 1e-12)
            assertEquals(errors[i], sqrt(drawn.map { (it[i] - mean) * (it[i] - mean) }.average()), 1e-12)
        }
    }

    private companion object {
        const val GROUPS = 10
    }
}
