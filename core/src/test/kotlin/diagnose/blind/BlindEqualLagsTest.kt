package stillwater.diagnose.blind

import org.junit.jupiter.api.Tag
import stillwater.diagnose.Cause
import stillwater.diagnose.CrossingTrack
import stillwater.diagnose.Diagnosis
import stillwater.diagnose.MeasuredSeries
import kotlin.test.Test
import kotlin.test.assertTrue

/** Of two equal lags either makes up for the other, so that neither seems to show by itself. */
class BlindEqualLagsTest {
    /** Of three lags a model of two has the likeliest numbers where both are the same. */
    @Test
    @Tag("long")
    fun aSecondLagThatIsAsLongAsTheFirstShows() {
        val random = java.util.Random(7)
        val track = CrossingTrack(900)
        val values = track.shown(3.0, 3.0, 1.2).map { it + 0.01 * random.nextGaussian() }.toDoubleArray()
        val result = Diagnosis(MeasuredSeries(track.times, track.x, track.y, values, null)).run()
        val second = result.candidates.first { it.cause == Cause.SECOND_ORDER_RESPONSE }
        assertTrue(second.pValue < 1e-6, "${second.pValue}, ${result.verdict}")
    }
}
