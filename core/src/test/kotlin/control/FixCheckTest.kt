package stillwater.control

import org.junit.jupiter.api.Test
import stillwater.model.LatLon
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class FixCheckTest {
    private val check = FixCheck()

    /** 0.001 degrees of latitude are 111 m. */
    private fun at(seconds: Double, milliDegrees: Double, accuracy: Double = 3.0) =
        check.isJump(seconds, LatLon(45.0 + milliDegrees / 1000, -73.0), accuracy)

    @Test
    fun aFixFartherThanABoatGoesIsAJumpAndSoIsTheWayBack() {
        assertFalse(at(0.0, 0.0), "the first")
        assertTrue(at(1.0, 1.0), "111 m in a second")
        assertFalse(at(2.0, 0.0), "back at the place before, which is still believed")
        assertEquals(1, check.jumps)
    }

    @Test
    fun twoThatAgreeAreWhereTheBoatIsNow() {
        assertFalse(at(0.0, 0.0))
        assertTrue(at(1.0, 1.0))
        assertTrue(at(2.0, 1.01), "far from the last that was believed, but the doubt is over")
        assertFalse(at(3.0, 1.0))
        assertTrue(at(4.0, 0.0), "and the old place is the jump now")
        assertEquals(3, check.jumps)
    }

    @Test
    fun timeAndTheReceiversOwnErrorExcuseAWay() {
        // The way is 111.1 m; excused are 5 m for each second, and three times both accuracies.
        for ((seconds, accuracy, isJump) in listOf(
            Triple(1.0, 3.0, true), // 23 m
            Triple(1.0, 17.9, false), // 112.4 m
            Triple(19.0, 3.0, false), // 113 m
            Triple(18.0, 3.0, true), // 108 m
        )) {
            val fresh = FixCheck()
            fresh.isJump(0.0, LatLon(45.0, -73.0), accuracy)
            assertEquals(isJump, fresh.isJump(seconds, LatLon(45.001, -73.0), accuracy), "$seconds s, $accuracy m")
        }
    }

    @Test
    fun theOtherSideOfTheGlobeIsFarAndTheDateLineIsNot() {
        val equator = FixCheck()
        equator.isJump(0.0, LatLon(0.0, 0.0), 3.0)
        assertTrue(equator.isJump(1.0, LatLon(0.0, 180.0), 3.0))
        val line = FixCheck()
        line.isJump(0.0, LatLon(10.0, 180.0), 3.0)
        assertFalse(line.isJump(1.0, LatLon(10.0, -180.0), 3.0))
        val pole = FixCheck()
        pole.isJump(0.0, LatLon(90.0, 0.0), 3.0)
        assertTrue(pole.isJump(1.0, LatLon(90.0, 0.0), 3.0), "nobody sails there, and nothing is thrown")
    }

    @Test
    fun whatIsTooWideForAMission() {
        assertEquals(listOf(true, false, false), listOf(10.0, 10.1, null).map(FixCheck::isNarrow))
    }
}
