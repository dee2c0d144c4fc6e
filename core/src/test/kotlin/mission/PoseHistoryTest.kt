package stillwater.mission

import org.junit.jupiter.api.Test
import stillwater.model.BoatTime
import stillwater.model.Position
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class PoseHistoryTest {
    @Test
    fun aReadingLiesBetweenThePosesAroundIt() {
        val history = PoseHistory(capacity = 3, longestGap = 2.0)
        assertEquals(null, history.at(BoatTime(0.0)))
        for (second in 0..3) assertTrue(history.add(BoatTime(second.toDouble()), 10.0 * second, -second.toDouble()))
        assertEquals(3, history.size)
        assertEquals(Position(15.0, -1.5), history.at(BoatTime(1.5)))
        assertEquals(Position(20.0, -2.0), history.at(BoatTime(2.0)))
        assertEquals(Position(30.0, -3.0), history.at(BoatTime(5.0)))
        assertEquals(null, history.at(BoatTime(5.1)))
        assertEquals(Position(10.0, -1.0), history.at(BoatTime(0.5)), "before the oldest pose kept")
        history.add(BoatTime(6.0), 0.0, 0.0)
        assertEquals(null, history.at(BoatTime(4.0)), "nobody knows where the boat went in 3 s")
    }

    @Test
    fun posesOutOfOrderOrNotFiniteAreRefused() {
        val history = PoseHistory()
        history.add(BoatTime(5.0), 0.0, 0.0)
        assertFalse(history.add(BoatTime(5.0), 1.0, 1.0))
        assertFalse(history.add(BoatTime(4.0), 1.0, 1.0))
        assertFalse(history.add(BoatTime(Double.NaN), 1.0, 1.0))
        assertFalse(history.add(BoatTime(6.0), Double.NaN, 1.0))
        assertEquals(4, history.refused)
        assertEquals(null, history.at(BoatTime(Double.NaN)))
    }
}

class BoardClockTest {
    @Test
    fun theDelayIsTakenOutAcrossAWrap() {
        val random = Random(21)
        val clock = BoardClock()
        val start = (1L shl 32) - 30_000
        for (tick in 0 until 600) {
            val truth = 100 + tick * 0.1
            val heard = truth + 0.02 + if (random.nextInt(5) == 0) 0.0 else random.nextDouble(0.3)
            val sampled = clock.sampled((start + tick * 100L) % (1L shl 32), BoatTime(heard))
            assertTrue(sampled.seconds <= heard + 1e-6) // rounding at 4e6 s
            // Every fifth line has the least delay, 0.02 s; the first 5 s may still learn it.
            if (tick > 50) assertEquals(truth + 0.02, sampled.seconds, 0.01)
        }
        assertEquals(1, clock.wraps)
        assertEquals(0, clock.resets)
    }

    @Test
    fun stampsThatChangePlacesOverAWrapStayInTheirTurn() {
        val clock = BoardClock(drift = 0.0)
        val before = (1L shl 32) - 100
        val first = clock.sampled(before, BoatTime(10.0)).seconds
        assertEquals(first + 0.15, clock.sampled(50, BoatTime(10.15)).seconds, 1e-6) // rounding at 4e6 s
        assertEquals(first + 0.05, clock.sampled(before + 50, BoatTime(10.16)).seconds, 1e-6)
        assertEquals(first + 0.25, clock.sampled(150, BoatTime(10.25)).seconds, 1e-6)
        assertEquals(1, clock.wraps)
    }

    @Test
    fun aResetStartsAnewAndRubbishIsRefused() {
        val clock = BoardClock()
        clock.sampled(60_000, BoatTime(10.0))
        assertEquals(20.0, clock.sampled(100, BoatTime(20.0)).seconds, 1e-9) // rounding
        assertEquals(1, clock.resets)
        assertTrue(clock.sampled(-1, BoatTime(20.0)).seconds.isNaN())
        assertTrue(clock.sampled(1L shl 32, BoatTime(20.0)).seconds.isNaN())
        assertTrue(clock.sampled(100, BoatTime(Double.NaN)).seconds.isNaN())
    }

    @Test
    fun aPlaceIsNoBetterKnownThanThePosesAroundIt() {
        val history = PoseHistory()
        assertTrue(history.deviationAt(BoatTime(1.0)).isNaN())
        history.add(BoatTime(1.0), 0.0, 0.0, 0.5)
        history.add(BoatTime(2.0), 1.0, 0.0, 0.8)
        history.add(BoatTime(3.0), 2.0, 0.0, 0.6)
        for ((seconds, expected) in listOf(0.5 to 0.5, 1.5 to 0.8, 2.5 to 0.8, 3.5 to 0.6)) {
            assertEquals(expected, history.deviationAt(BoatTime(seconds)), "at $seconds s")
        }
        assertTrue(history.deviationAt(BoatTime(Double.NaN)).isNaN())
    }
}
