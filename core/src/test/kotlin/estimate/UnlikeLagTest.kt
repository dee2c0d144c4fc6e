package stillwater.estimate

import stillwater.sensor.SensorStage
import kotlin.math.sqrt
import kotlin.test.Test
import kotlin.test.assertTrue

/** A lag of one time constant up and another down, under so much noise that neighbouring readings do not tell which. */
class UnlikeLagTest {
    private class Corrected(val held: Double, val error: Double)

    private fun corrected(stage: SensorStage, lag: ResponseLag, seed: Int): Corrected {
        val log = LawnmowerLog(seed, listOf(stage), legs = 6, noise = 0.1)
        val response = Response(lags = listOf(lag))
        val track = TrackCorrector(log.series, 0.01).correct(listOf(LikelyResponse(listOf(response), 1.0)))
        val rows = log.truth.indices
        val squares = rows.sumOf { (track.values[it] - log.truth[it]) * (track.values[it] - log.truth[it]) }
        val held = rows.count { log.truth[it] in track.lower[it]..track.upper[it] }
        return Corrected(held.toDouble() / rows.count(), sqrt(squares / rows.count()))
    }

    @Test
    fun intervalsHoldTheWaterAsTheyDoBehindALagThatIsTheSameBothWays() {
        var unlikeError = 0.0
        var likeError = 0.0
        for (seed in 61..63) {
            val unlike = corrected(SensorStage.Asymmetric(30.0, 12.0), ResponseLag(30.0, 12.0), seed)
            val like = corrected(SensorStage.Lag(19.0), ResponseLag(19.0), seed)
            // 95 % of 1300 rows that are alike over some ten: two standard errors of 130 rows are 4 %.
            assertTrue(unlike.held > 0.9, "seed $seed: ${unlike.held}")
            unlikeError += unlike.error
            likeError += like.error
        }
        // The slower side of the two passes on less, which makes 1.17 here; with sides by the readings' slopes, 1.69 in
        // seed 61, whose intervals hold 0.80.
        assertTrue(unlikeError < 1.3 * likeError, "$unlikeError for $likeError")
    }
}
