package stillwater.estimate

import stillwater.sensor.SensorStage
import kotlin.math.exp
import kotlin.math.ln
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertNotNull
import kotlin.test.assertTrue

/** Lags as long as a log shows them, and responses that contain others. */
class LongLagTest {
    private fun learner(vararg stages: SensorStage) =
        RevisitLearner.of(LawnmowerLog(seed = 31, stages.toList(), legs = 7).series)

    @Test
    fun aLagOfMoreThanFortyRowsIsLearned() {
        val learner = learner(SensorStage.Lag(LONG))
        val found = assertNotNull(learner.candidate(ResponseKind.FIRST_ORDER))
        assertTrue(LONG in found.interval(0), "${found.parameters} ${found.interval(0)}")
        // Within a quarter, as for shorter ones: 40 rows are off by a third.
        assertEquals(LONG, found.parameters[0], LONG / 4)
        assertEquals(emptyList(), found.atLongest)
    }

    @Test
    fun aRicherResponseIsNoWorseThanThoseItContains() {
        val learner = learner(SensorStage.Asymmetric(1.3 * LONG, LONG / 1.3))
        val kinds = listOf(
            ResponseKind.NONE,
            ResponseKind.FIRST_ORDER,
            ResponseKind.DEAD_TIME,
            ResponseKind.DEAD_TIME_AND_LAG,
            ResponseKind.ASYMMETRIC,
        )
        val found = learner.atLeastAsNested(kinds.mapNotNull(learner::candidate))
        assertEquals(kinds, found.map { it.kind })
        for (one in found) {
            for (nested in found.filter { one.kind.contains(it.kind) }) {
                // What is none is a hundredth of a row, and a search ends within 0.005.
                assertTrue(one.score > nested.score - 0.02, "${one.kind} ${one.score}, ${nested.kind} ${nested.score}")
            }
        }
        val errors = found.last().relativeErrors
        assertTrue(errors.all { it < 1 }, "an asymmetric lag is told to better than a factor of e: $errors")
    }

    @Test
    fun oneThatIsBehindIsSearchedAgainFromWhatItContains() {
        fun candidate(kind: ResponseKind, score: Double, vararg parameters: Double) =
            CandidateResponse(kind, parameters.toList(), parameters.map { 0.1 }, emptyList(), score, DoubleArray(0))
        val begins = ArrayList<List<Double>>()
        val learner = object : ResponseLearner {
            override val groups = 1
            override val shortest = 0.01

            override fun candidate(kind: ResponseKind) = null

            override fun near(kind: ResponseKind, parameters: List<Double>): CandidateResponse {
                begins += parameters
                return candidate(kind, 101.0, *parameters.toDoubleArray())
            }
        }
        val lag = candidate(ResponseKind.FIRST_ORDER, 100.0, 40.0)
        val better = candidate(ResponseKind.DEAD_TIME_AND_LAG, 100.5, 3.0, 38.0)
        val behind = candidate(ResponseKind.ASYMMETRIC, -370.0, 1e3, 1e-3)
        val found = learner.atLeastAsNested(listOf(behind, lag, better))
        assertEquals(listOf(listOf(40.0, 40.0)), begins)
        assertEquals(listOf(101.0, 100.0, 100.5), found.map { it.score })
    }

    @Test
    fun aTimeAtTheLongestThatWasLookedForIsOpenUpwards() {
        // The scores grow with the time, and beyond ten there are none.
        fun at(logs: DoubleArray) = if (logs[0] > ln(10.0)) Double.NEGATIVE_INFINITY else logs[0]
        val groupOf = IntArray(8) { it }
        val fit = ResponseFit(
            ResponseKind.FIRST_ORDER,
            groupOf,
            groupOf.size,
            { 8 * at(it) },
            { logs -> DoubleArray(8) { logs[0] - it * (logs[0] - ln(9.0)) * (logs[0] - ln(9.0)) } },
            longest = 10.0,
        )
        val found = fit.best(listOf(5.0))
        assertEquals(10.0, found.parameters[0], 0.5)
        assertEquals(listOf(0), found.atLongest)
        assertEquals(Double.POSITIVE_INFINITY, found.interval(0).endInclusive)
        assertTrue(!found.isBounded)
        // Corrections hold one that is longer by a factor of e.
        assertTrue(found.likely().maxOf { it.lags.single().rising } > exp(1.0) * 10 * 0.9)
    }

    private companion object {
        /** Beyond forty rows of a second, s. */
        const val LONG = 60.0
    }
}
