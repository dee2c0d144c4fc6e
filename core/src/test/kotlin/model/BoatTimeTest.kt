package stillwater.model

import org.junit.jupiter.api.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class BoatTimeTest {
    @Test
    fun differencesAndSums() {
        assertEquals(2.5, BoatTime(10.0) - BoatTime(7.5), 0.0)
        assertEquals(-2.5, BoatTime(7.5) - BoatTime(10.0), 0.0)
        assertEquals(BoatTime(10.0), BoatTime(7.5) + 2.5)
    }

    @Test
    fun comparesByMoment() {
        assertTrue(BoatTime(1.0) < BoatTime(2.0))
        assertTrue(BoatTime(-1.0) < BoatTime(0.0))
        assertEquals(0, BoatTime(3.0).compareTo(BoatTime(3.0)))
        assertEquals(listOf(1.0, 2.0, 3.0), listOf(3.0, 1.0, 2.0).map(::BoatTime).sorted().map { it.seconds })
    }

    @Test
    fun aUnixStampKeepsAMicrosecond() {
        // Doubles near 1.6e9 are 2.4e-7 apart: two stamps 1 µs apart differ, by 1 µs to within that.
        val stamp = BoatTime(1.6e9)
        assertTrue(stamp < stamp + 1e-6)
        assertEquals(1e-6, (stamp + 1e-6) - stamp, 2.4e-7)
    }

    @Test
    fun anUnknownTimeStaysUnknown() {
        assertTrue((BoatTime(Double.NaN) - BoatTime(1.0)).isNaN())
        assertTrue((BoatTime(Double.NaN) + 1.0).seconds.isNaN())
    }

    @Test
    fun aClockIsOneFunction() {
        var now = 5.0
        val clock = Clock { BoatTime(now) }
        now += 1.0
        assertEquals(BoatTime(6.0), clock.now())
    }
}
