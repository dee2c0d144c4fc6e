package stillwater.survey

import org.junit.jupiter.api.Test
import stillwater.model.BoatTime
import stillwater.model.Conditions
import kotlin.test.assertEquals

class SurveyScanTest {
    /** The way east at 1 m/s with a reading at each of [seconds]. */
    private fun way(seconds: Iterable<Int>): Double {
        val scan = SurveyScan()
        for (second in seconds) scan.take(BoatTime(second.toDouble()), second.toDouble(), 0.0, 8.0, Conditions.NONE)
        return scan.statistics().distance
    }

    @Test
    fun theWayHasItsLastSecondsToo() {
        assertEquals(3.0, way(0..3), 1e-9, "no stretch of 5 s")
        assertEquals(12.0, way(0..12), 1e-9, "two of them and 2 s")
    }

    @Test
    fun theWayEndsAtAGapAndGoesOnAfterIt() {
        assertEquals(7.0 + 6.0, way((0..7) + (207..213)), 1e-9)
    }
}
