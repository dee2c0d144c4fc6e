package stillwater.io

import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertNull

class PositionJumpsTest {
    private fun jumps(unit: String, vararg places: Pair<Double, Double>) = PositionJumps(unit).apply {
        places.forEachIndexed { i, (x, y) -> take(i + 2L, i.toDouble(), x, y) }
    }

    @Test
    fun stepsThatNoBoatMakesAreCountedAndTheFirstIsNamed() {
        val there = jumps("m/s", 5.0 to 5.0, 6.0 to 5.0, 206.0 to 105.0, 207.0 to 105.0, 7.0 to 5.0, 0.0 to 0.0)
        assertEquals(2, there.count)
        assertEquals(
            "2 jumps in the positions are faster than 20 m/s, the first at line 4: check the receiver's fixes",
            there.note,
        )
        val once = jumps("units of pres_dbar per s", 5.0 to 0.0, 6.0 to 0.0, 7.0 to 0.0, -20.0 to 0.0)
        assertEquals(1, once.count)
        assertEquals(
            "1 jump in the positions is faster than 20 units of pres_dbar per s, at line 5: check the receiver's fixes",
            once.note,
        )
    }

    @Test
    fun aStepThatIsShortOrTakesItsTimeIsNone() {
        val jumps = PositionJumps("m/s")
        jumps.take(2, 0.0, 0.0, 0.0)
        jumps.take(3, 0.1, 7.0, 7.0)
        jumps.take(4, 60.1, 1207.0, 7.0)
        assertEquals(0, jumps.count)
        assertNull(jumps.note)
    }
}
