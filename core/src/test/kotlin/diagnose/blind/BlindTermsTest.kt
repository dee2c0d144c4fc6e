package stillwater.diagnose.blind

import stillwater.diagnose.Cause
import stillwater.diagnose.CrossingTrack
import stillwater.diagnose.MeasuredSeries
import stillwater.diagnose.response.ResponseModel
import stillwater.diagnose.response.Steps
import stillwater.diagnose.response.Term
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** What is asked where a lag may be a time constant or a dead time. */
class BlindTermsTest {
    private val track = CrossingTrack(300)
    private val series = MeasuredSeries(track.times, track.x, track.y, track.shown(4.0), null)
    private val search = BlindSearch(series)
    private val place = Term(Cause.POSITION_OFFSET)

    @Test
    fun besideALagOfEitherKindAPlaceIsAskedForAndNoOtherShape() {
        val open = BlindTerms.of(search, hasShape = false).map { it.cause }
        assertTrue(Cause.POSITION_OFFSET in open)
        assertFalse(Cause.DEAD_TIME in open || Cause.SECOND_ORDER_RESPONSE in open)
        assertEquals(open.toSet() + Cause.DEAD_TIME + Cause.SECOND_ORDER_RESPONSE, causes(hasShape = true))
    }

    private fun causes(hasShape: Boolean) = BlindTerms.of(search, hasShape).map { it.cause }.toSet()

    /** An offset of place, or what [term] else is, of [behind] m. */
    private fun tried(term: Term, behind: Double): BlindTrial {
        val model = ResponseModel(series.withReference(track.truth), listOf(term), Steps.EVEN, search.scales)
        val numbers = doubleArrayOf(4.0, 1.0, 0.0, 0.0, behind)
        val none = DoubleArray(series.size)
        return BlindTrial(term, term.key, model, BlindPoint(numbers, none, 1.0), none, 0.0, 1.0, 1, 1.0)
    }

    @Test
    fun aSensorBehindTheFixesIsLateAndOneAheadIsNot() {
        assertTrue(tried(place, 0.7).isLate)
        assertFalse(tried(place, -0.7).isLate)
        assertFalse(tried(Term(Cause.ASYMMETRIC_RESPONSE), 0.7).isLate)
    }
}
