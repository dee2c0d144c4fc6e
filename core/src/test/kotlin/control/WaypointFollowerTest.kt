package stillwater.control

import org.junit.jupiter.api.Test
import org.junit.jupiter.api.assertThrows
import stillwater.model.Actuation
import stillwater.model.Conditions
import stillwater.model.Drive
import stillwater.sensor.GaussianNoise
import stillwater.virtual.BoatDynamics
import stillwater.virtual.Hull
import kotlin.math.PI
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class WaypointFollowerTest {
    private val hull = Hull()

    @Test
    fun theDriftIsLearned() {
        val random = Random(11)
        val noise = GaussianNoise(1.5, random)
        val track = TrackEstimator()
        for (second in 0..600) {
            track.advance(1.0, 0.0, 1.0)
            val errorX = noise.step(0.0, 1.0, Conditions.NONE)
            val errorY = noise.step(0.0, 1.0, Conditions.NONE)
            track.fix(1.0 * second + errorX, 0.3 * second + errorY)
        }
        // Steady state: the drift's deviation is 0.07 m/s for this noise; three of them.
        assertEquals(0.3, track.driftY, 0.21)
        assertEquals(0.0, track.driftX, 0.21)
        assertTrue(track.deviation < 0.8, "${track.deviation} m")
    }

    @Test
    fun impossibleFixesAreRefusedAndNothingThrows() {
        val track = TrackEstimator()
        assertEquals(FixUse.NOT_FINITE, track.fix(Double.NaN, 0.0))
        assertEquals(FixUse.USED, track.fix(0.0, 0.0))
        track.advance(1.0, 0.0, 0.0)
        assertEquals(FixUse.JUMPED, track.fix(200.0, 0.0))
        assertEquals(1, track.jumps)
        assertEquals(FixUse.USED, track.fix(0.5, 0.5))
        assertEquals(0, track.jumps)
        val follower = WaypointFollower(FollowerSettings(topSpeed = 1.6))
        follower.leg(0.0, 0.0, 10.0, 0.0)
        assertEquals(Drive.NONE, follower.steer(track, Double.NaN, 0.0))
        assertEquals(Drive.NONE, follower.steer(TrackEstimator(), 0.0, 0.0))
        follower.leg(5.0, 5.0, 5.0, 5.0)
        follower.steer(track, 0.0, Double.NaN)
        assertThrows<IllegalArgumentException> { FollowerSettings(topSpeed = 0.5, cruise = 1.0) }
    }

    @Test
    fun mixingKeepsTheTurnAndStaysInRange() {
        assertEquals(Actuation.Differential(0.3, 0.5), Mixing.DIFFERENTIAL.mix(Drive(0.4, 0.1)).rounded())
        assertEquals(Actuation.Vectored(0.4, 0.1), Mixing.VECTORED.mix(Drive(0.4, 0.1)))
        val random = Random(3)
        repeat(1000) {
            val drive = Drive(random.nextDouble(-3.0, 3.0), random.nextDouble(-3.0, 3.0))
            for (mixing in Mixing.entries) mixing.mix(drive)
        }
        for (bad in listOf(Double.NaN, Double.POSITIVE_INFINITY)) {
            for (mixing in Mixing.entries) assertTrue(mixing.mix(Drive(bad, 0.0)).isAtRest)
        }
    }

    private fun Actuation.rounded() = (this as Actuation.Differential).let {
        Actuation.Differential(Math.round(it.left * 1e9) / 1e9, Math.round(it.right * 1e9) / 1e9)
    }

    @Test
    fun aBoatAtFullThrustReachesItsTopSpeedAndTurnsToPort() {
        val boat = BoatDynamics(hull, heading = PI / 2)
        boat.advance(120.0, Actuation.Differential(1.0, 1.0))
        assertEquals(hull.topSpeed, boat.surge, 1e-6) // 120 s are 60 time constants
        assertEquals(0.0, boat.x, 1e-9) // cos of a rounded right angle
        boat.advance(0.5, Actuation.Differential(0.0, 1.0))
        assertTrue(boat.yawRate > 0)
    }
}
