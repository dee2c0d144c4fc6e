package stillwater.virtual

import stillwater.model.BoatTime
import stillwater.model.Position
import kotlin.math.E
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith

class PlumeWaterTest {
    @Test
    fun itFallsOffFromTheMiddleOfThePlume() {
        val water = PlumeWater(Position(10.0, -5.0), background = 9.0, depth = 4.0, scale = 20.0)
        val now = BoatTime(1.0)
        assertEquals(5.0, water.truth(10.0, -5.0, now))
        // The exponential's own rounding.
        assertEquals(9.0 - 4.0 / E, water.truth(10.0, 15.0, now), 1e-12)
        assertEquals(9.0, water.truth(1e6, 0.0, now))
    }

    @Test
    fun numbersThatMakeNoWaterAreRefused() {
        assertFailsWith<IllegalArgumentException> { PlumeWater(Position(0.0, 0.0), scale = 0.0) }
        assertFailsWith<IllegalArgumentException> { PlumeWater(Position(0.0, 0.0), depth = Double.NaN) }
    }
}
