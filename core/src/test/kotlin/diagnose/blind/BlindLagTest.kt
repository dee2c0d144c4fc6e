package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.CrossingTrack
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Term
import java.util.Random
import kotlin.test.Test
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** Which kind of lag there is, once a model has both beside what else was found. */
class BlindLagTest {
    private val rows = 400
    private val search = run {
        val track = CrossingTrack(rows)
        val random = Random(SEED)
        val values = track.shown(5.0).map { it + 0.004 * random.nextGaussian() }.toDoubleArray()
        BlindSearch(MeasuredSeries(track.times, track.x, track.y, values, null))
    }
    private val lag = BlindLag(search, search.best())

    /** The model with a dead time of [delay] s beside the lag. */
    private fun both(delay: Double): BlindState = lag.timeConstant.let { base ->
        val numbers = base.numbers + delay
        search.settled(listOf(Term(Cause.DEAD_TIME)), numbers, base.fit.design.noise, base.variances, before = base)
    }

    @Test
    fun aTimeConstantThatIsSureBesideNoDeadTimeIsTold() {
        val none = both(0.1)
        val sure = DoubleArray(none.numbers.size) { 0.05 }
        assertTrue(lag.isToldIn(none, sure), "seed $SEED")
        assertFalse(lag.isToldIn(both(0.6), sure), "seed $SEED")
        for (i in listOf(ResponseModel.TIME_CONSTANT, none.numbers.size - 1)) {
            assertFalse(lag.isToldIn(none, sure.copyOf().also { it[i] = 0.3 }), "seed $SEED, number $i")
        }
        // Who has not looked at a dead time does not know.
        assertFalse(lag.isToldIn(lag.timeConstant, sure), "seed $SEED")
    }

    private companion object {
        const val SEED = 20261127L
    }
}
