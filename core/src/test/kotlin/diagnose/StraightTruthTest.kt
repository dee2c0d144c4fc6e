package stillwater.diagnose

import stillwater.estimate.LagWeights
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertIs

/** Water that goes straight from row to row, with a corner at each: a smooth curve through the rows is not it. */
class StraightTruthTest {
    private fun log(seed: Long): MeasuredSeries {
        val random = java.util.Random(seed)
        val weights = LagWeights().also { it.set(LAG, PERIOD) }
        val truth = DoubleArray(ROWS)
        var water = 5.0
        for (row in truth.indices) {
            truth[row] = water
            water += 0.005 * (5 - water) + 0.1 * random.nextGaussian()
        }
        var state = truth[0]
        val readings = DoubleArray(ROWS) { row ->
            if (row > 0) state = weights.keep * state + weights.before * truth[row - 1] + weights.now * truth[row]
            state + 0.01 * random.nextGaussian()
        }
        val still = DoubleArray(ROWS)
        return MeasuredSeries(DoubleArray(ROWS) { PERIOD * it }, still, still, readings, truth)
    }

    /** A simulation that holds the mean of two rows is so near that the lag was 0.05 s short, of errors of 0.025 s. */
    @Test
    fun itsLagIsNotThatOfASimulationByMeans() {
        val lags = (1L..6L).map { seed ->
            val result = Diagnosis(log(seed)).run()
            assertIs<Verdict.Consistent>(result.verdict, "seed $seed")
            result.baseline.parameters.first().value
        }
        // Three standard errors of the mean.
        assertEquals(LAG, lags.average(), 0.031, "$lags")
    }

    private companion object {
        const val ROWS = 1000
        const val PERIOD = 2.0
        const val LAG = 8.0
    }
}
