package stillwater.control

import org.junit.jupiter.api.Test
import kotlin.math.PI
import kotlin.test.assertEquals

class PhoneTurnTest {
    @Test
    fun aCompassAndAHeadingAreTheSameDirection() {
        for ((compass, heading) in listOf(0.0 to PI / 2, 90.0 to 0.0, 180.0 to -PI / 2, 270.0 to -PI)) {
            assertEquals(heading, PhoneTurn.heading(compass), 1e-12) // rounding
            assertEquals(compass, PhoneTurn.compassDeg(heading), 1e-9)
            assertEquals(compass, PhoneTurn.compassDeg(heading + 4 * PI), 1e-9)
        }
    }

    @Test
    fun theRateIsAboutTheUprightHoweverThePhoneLies() {
        val flat = floatArrayOf(1f, 0f, 0f, 0f, 1f, 0f, 0f, 0f, 1f)
        assertEquals(0.5, PhoneTurn.yawRate(flat, floatArrayOf(9f, 9f, 0.5f)))
        // On its long edge: what points up is the phone's own y.
        val upright = floatArrayOf(1f, 0f, 0f, 0f, 0f, -1f, 0f, 1f, 0f)
        assertEquals(0.5, PhoneTurn.yawRate(upright, floatArrayOf(9f, 0.5f, 9f)))
    }
}
