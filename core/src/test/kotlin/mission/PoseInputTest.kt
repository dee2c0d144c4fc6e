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

    /** A receiver whose clock is half a second fast: its fixes are of now, and one said twice is one. */
    @Test
    fun twoSentencesOfAFixThatIsAheadAreOne() {
        fixes(20)
        input.fix(BoatTime(now + 0.5), frame.toLatLon(Position(0.0, 0.0)))
        pass(0.1, Drive.NONE)
        assertTrue(age() <= 0.1, "it is of now, not of a time to come")
        val before = input.track.deviation
        for (stamp in listOf(now + 0.4, now + 0.4 - 1e-5, now + 0.4 + 1e-5)) {
            input.fix(BoatTime(stamp), frame.toLatLon(Position(0.0, 0.0)))
        }
        input.advance(BoatTime(now), 0.0, Drive.NONE)
        assertEquals(before, input.track.deviation, "as well known as before")
        assertEquals(0, input.refused)
        assertTrue(age() <= 0.1)
    }

    @Test
    fun ofABurstOfFixesTheNewestCountsInWhateverOrderTheyCome() {
        fixes(20)
        val before = input.refused
        for (ago in listOf(4.0, 3.0, 0.5, 2.0, 1.0)) {
            input.fix(BoatTime(now + 5.0 - ago), frame.toLatLon(Position(-ago, 0.0)))
        }
        pass(5.0, Drive.NONE)
        assertEquals(0.5, age(), 1e-9)
        assertEquals(2, input.refused - before, "those older than one that came before them")
        // A fix of 1.5 m against a place known to less: half the way to it at most.
        assertEquals(-0.3, input.track.x, 0.3)
    }

    /** A burst is no proof of agreement: the boat has not been watched for any longer. */
    @Test
    fun aBurstDoesNotAgreeWithItself() {
        now = 20.0
        for (ago in 16 downTo 0) input.fix(BoatTime(now - ago), frame.toLatLon(Position(0.0, 0.0)))
        pass(0.1, Drive.NONE)
        assertEquals(Double.POSITIVE_INFINITY, age())
    }

    /** A backlog of a receiver: what it says is of some time ago, and the boat went on. */
    @Test
    fun aLateFixIsOfWhereTheBoatWas() {
        val places = ArrayList<Position>()
        repeat(60) {
            repeat(10) { pass(0.1, if (now < 16) Drive.NONE else Drive(1.0, 0.0)) }
            places += Position(maxOf(0.0, now - 18) * 1.4, 0.0)
            val late = if (places.size < 30) 0 else 2
            input.fix(BoatTime(now - late), frame.toLatLon(places[places.size - 1 - late]))
        }
        // 2.8 m behind without it.
        assertEquals(places.last().x, input.track.x, 1.0)
        val refused = input.refused
        input.fix(BoatTime(now - 0.5), frame.toLatLon(places.last()))
        pass(10.0, Drive.NONE)
        assertEquals(refused + 1, input.refused, "ten seconds ago is no place any more")
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
