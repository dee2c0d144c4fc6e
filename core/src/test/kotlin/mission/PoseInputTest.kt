package stillwater.mission

import org.junit.jupiter.api.Test
import stillwater.control.Mixing
import stillwater.control.Situation
import stillwater.model.BoatTime
import stillwater.model.Drive
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import stillwater.model.Position
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class PoseInputTest {
    private val frame = LocalFrame(LatLon(45.5, -73.6))
    private val input = PoseInput(frame, 1.5, Mixing.DIFFERENTIAL)
    private var now = 0.0

    private fun pass(dt: Double, drive: Drive) {
        now += dt
        input.compass(BoatTime(now), 0.0, 0.0)
        input.advance(BoatTime(now), dt, drive)
    }

    private fun fix(x: Double) = input.fix(BoatTime(now), frame.toLatLon(Position(x, 0.0)))

    private fun age() = Situation().also(input::describe).fixAge

    /** Fixes a second apart at [x], for [seconds] s. */
    private fun fixes(seconds: Int, x: Double = 0.0) = repeat(seconds) {
        fix(x)
        pass(1.0, Drive.NONE)
    }

    @Test
    fun aFixOfATimeToComeIsRefusedAndThoseAfterItAreNot() {
        fixes(20)
        assertTrue(age() <= 1.0)
        input.fix(BoatTime(now + 3600), frame.toLatLon(Position(0.0, 0.0)))
        pass(1.0, Drive.NONE)
        assertEquals(1, input.refused)
        pass(4.0, Drive.NONE)
        assertTrue(age() > 3.0, "it is no fix of now")
        fixes(2)
        assertEquals(1, input.refused, "later ones are taken")
    }

    @Test
    fun aHeadingOfATimeToComeGrowsOld() {
        pass(0.1, Drive.NONE)
        input.compass(BoatTime(now + 3600), 0.5, 0.0)
        input.advance(BoatTime(now + 0.1), 0.1, Drive.NONE)
        assertEquals(0.5, input.heading)
        input.advance(BoatTime(now + 1.5), 1.4, Drive.NONE)
        assertTrue(input.heading.isNaN())
    }

    @Test
    fun afterAPauseFixesHaveToAgreeAgain() {
        fixes(20)
        pass(60.0, Drive.NONE)
        // The gate is 40 m wide by now.
        fixes(1, 30.0)
        assertEquals(Double.POSITIVE_INFINITY, age(), "the first fix back may be the wrong one")
        fixes(12, 0.0)
        assertEquals(Double.POSITIVE_INFINITY, age(), "three disagreed with it, and the place is a new one")
        fixes(8)
        assertTrue(age() <= 1.0)
        pass(10.0, Drive.NONE)
        fixes(4)
        assertEquals(Double.POSITIVE_INFINITY, age())
        fixes(2)
        assertTrue(age() <= 1.0, "five seconds do where they agree with what was believed")
    }

    @Test
    fun twoFixesFarApartDoNotAgree() {
        fix(0.0)
        pass(16.0, Drive.NONE)
        fix(0.0)
        pass(0.1, Drive.NONE)
        assertEquals(Double.POSITIVE_INFINITY, age())
    }

    @Test
    fun twoSentencesOfOneFixAreOne() {
        fixes(20)
        val before = input.track.deviation
        input.fix(BoatTime(now - 1.0 + 1e-5), frame.toLatLon(Position(0.0, 0.0)))
        input.advance(BoatTime(now), 0.0, Drive.NONE)
        assertEquals(before, input.track.deviation, "as well known as before")
    }

    @Test
    fun aBoatUnderPowerIsFollowedStepByStep() {
        fix(0.0)
        pass(0.1, Drive.NONE)
        repeat(100) { pass(0.1, Drive(1.0, 0.0)) }
        // 1.5 m/s within some 2 s: 10 s of it less what the hull takes to get there.
        assertEquals(12.0, input.track.x, 0.2)
    }

    @Test
    fun aBoatWhosePhoneSleptCameToRest() {
        fix(0.0)
        pass(0.1, Drive.NONE)
        repeat(100) { pass(0.1, Drive(1.0, 0.0)) }
        val before = input.track.x
        pass(30.0, Drive(1.0, 0.0))
        // Half a second under power, and 1.5 m/s that die away in 2 s; it is not 45 m farther.
        assertTrue(input.track.x - before in 1.0..4.0, "${input.track.x - before} m")
        fix(before + 2.5)
        pass(0.1, Drive.NONE)
        assertEquals(0, input.refused, "where it is found is where it may be")
    }
}
