package stillwater.control

import kotlin.math.cos
import kotlin.math.hypot
import kotlin.math.sin
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** A boat at rest at (0, 0) whose fixes have white noise of 1.5 m, one a second, but for what a test adds. */
class TrackEstimatorTest {
    private val random = java.util.Random(881)
    private val track = TrackEstimator()

    private fun second(offX: Double = 0.0, offY: Double = 0.0) {
        repeat(10) { track.advance(0.1, 0.0, 0.0) }
        track.fix(NOISE * random.nextGaussian() + offX, NOISE * random.nextGaussian() + offY)
    }

    @Test
    fun fixesThatAreNoWorseThanTheyShouldBeAreSeldomDoubted() {
        var doubted = 0
        repeat(7200) {
            second()
            if (track.doubt > 0) doubted++
        }
        assertTrue(doubted < 0.015 * 7200, "$doubted of 7200")
    }

    /** What the filter allows for is no reason for a doubt: of one in ninety moments by chance, and then for 20 s. */
    @Test
    fun waterWhoseDriftWandersIsSeldomDoubted() {
        for ((wandering, most) in listOf(0.01 to 0.1, 0.02 to 0.3)) {
            val doubted = secondsDoubted(wandering)
            assertTrue(doubted < most * 7200, "$doubted of 7200 at $wandering m/s per root s")
        }
    }

    /** Of 7200 s in water whose drift wanders by [wandering] m/s per root s. */
    private fun secondsDoubted(wandering: Double): Int {
        track.reset()
        var driftX = 0.0
        var driftY = 0.0
        var offX = 0.0
        var offY = 0.0
        var doubted = 0
        repeat(7200) {
            driftX += wandering * random.nextGaussian()
            driftY += wandering * random.nextGaussian()
            offX += driftX
            offY += driftY
            second(offX, offY)
            if (track.doubt > 0) doubted++
        }
        return doubted
    }

    /** Jumps of 4 to 8 m for ten seconds, each below the gate of some 9 m, and what comes after them. */
    @Test
    fun whereJumpsBelowTheGateMoveThePlaceTheBoatIsWithinWhatIsDoubted() {
        val directions = Random(882)
        var missed = 0
        var missedWithoutDoubt = 0
        var looks = 0
        repeat(200) {
            track.reset()
            repeat(60) { second() }
            val size = directions.nextDouble(4.0, 8.0)
            val angle = directions.nextDouble(6.283)
            repeat(20) {
                val jump = if (it < 10) size else 0.0
                second(jump * cos(angle), jump * sin(angle))
                val off = hypot(track.x, track.y)
                looks++
                if (off > 3 * track.deviation) missedWithoutDoubt++
                if (off > 3 * track.deviation + track.doubt + SLACK) missed++
            }
        }
        // What the filter's own three deviations do not cover most of the time they do with the doubt, within a metre.
        assertTrue(missedWithoutDoubt > looks / 2, "$missedWithoutDoubt of $looks without it")
        assertTrue(missed < looks / 20, "$missed of $looks")
    }

    @Test
    fun fixesThatAgreeEndADoubtAndAResetForgetsIt() {
        repeat(60) { second() }
        repeat(5) { second(offX = 6.0) }
        assertTrue(track.doubt > 2.0, "${track.doubt} m")
        repeat(100) { second() }
        assertEquals(0.0, track.doubt)
        repeat(5) { second(offX = 6.0) }
        track.reset()
        assertEquals(0.0, track.doubt)
    }

    private companion object {
        const val NOISE = 1.5

        /** By which a jump's first seconds, before it shows, put the place off beyond three deviations, m. */
        const val SLACK = 1.0
    }
}
