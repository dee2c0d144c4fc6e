package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.CrossingTrack
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Term
import java.util.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertNull
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

    /** On part of Lac Hertel's log a temperature with a lag of 3.8 to 1100 s had a delay of 32.5 ± 0.1 s. */
    @Test
    fun whereTheTimeConstantMayBeAnythingAChannelHasNoDelay() {
        // A lag of 5 s delays waves by less than that.
        assertEquals(4.0, lag.channel("temp_c", 0.1).delay, 1.0, "seed $SEED")
        assertTrue(lag.channel("temp_c", 0.55).isSeen)
        assertFalse(lag.channel("temp_c", 0.56).isSeen, "its interval reaches over more than ten times")
        assertNull(lag.channel("temp_c", 3.0).interval)
    }

    private companion object {
        const val SEED = 20261127L
    }
}
