package stillwater.mission

import org.junit.jupiter.api.Test
import stillwater.control.Mixing
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
