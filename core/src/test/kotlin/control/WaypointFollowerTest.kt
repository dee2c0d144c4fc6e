package stillwater.control

import org.junit.jupiter.api.Test
import org.junit.jupiter.api.assertThrows
import stillwater.model.Actuation
import stillwater.model.Conditions
import stillwater.model.Drive
import stillwater.model.Position
import stillwater.sensor.GaussianNoise
import stillwater.virtual.BoatDynamics
import stillwater.virtual.Hull
import kotlin.math.PI
import kotlin.math.hypot
import kotlin.math.sqrt
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class WaypointFollowerTest {
    private val hull = Hull()

    /** Five legs of 60 m, 10 m apart: a survey's. */
    private val path = buildList {
        for (row in 0..4) {
            val eastward = row % 2 == 0
            add(Position(if (eastward) 0.0 else 60.0, 10.0 * row))
            add(Position(if (eastward) 60.0 else 0.0, 10.0 * row))
        }
    }

    private class Run(val rms: Double, val onLegs: Double, val finished: Boolean)

    /** The bar of the issue, with a compass that errs by 2 degrees and a hull whose drag the follower does not know. */
    private fun run(seed: Int, mixing: Mixing, currentX: Double, currentY: Double): Run {
        val random = Random(seed)
        val fixNoise = GaussianNoise(1.5, random)
        val compassNoise = GaussianNoise(0.02, random)
        // It drifts for 30 s, as while it arms, and gets to the first leg about when it may go.
        val boat = BoatDynamics(hull, x = -30 * currentX, y = -30 * currentY)
        boat.currentX = currentX
        boat.currentY = currentY
        val track = TrackEstimator()
        val follower = WaypointFollower(FollowerSettings(topSpeed = hull.topSpeed))
        var leg = 0
        var speed = 0.0
        var drive = Drive.NONE
        var squares = 0.0
        var steps = 0
        var legSquares = 0.0
        var legSteps = 0
        for (tick in 0 until 10 * 900) {
            val compass = boat.heading + 0.035 + noise(compassNoise)
            speed += 0.1 / 2.0 * (hull.topSpeed * sqrt(maxOf(0.0, drive.forward)) - speed)
            track.advance(0.1, compass, speed)
            if (tick % 10 == 0) track.fix(boat.x + noise(fixNoise), boat.y + noise(fixNoise))
            if (tick == 300 || (tick > 300 && follower.arrived)) {
                if (++leg == path.size) return Run(sqrt(squares / steps), sqrt(legSquares / legSteps), true)
                val after = path.getOrNull(leg + 1)
                follower.leg(
                    path[leg - 1].x,
                    path[leg - 1].y,
                    path[leg].x,
                    path[leg].y,
                    after?.x ?: Double.NaN,
                    after?.y ?: Double.NaN,
                )
            }
            drive = if (tick < 300) Drive.NONE else follower.steer(track, compass, boat.yawRate)
            boat.advance(0.1, mixing.mix(drive))
            if (tick >= 300) {
                val error = (maxOf(0, leg - 2) until minOf(leg + 1, path.size - 1)).minOf { offLeg(boat, it) }
                squares += error * error
                steps++
                if (leg % 2 == 1 && boat.x in 10.0..50.0) {
                    legSquares += error * error
                    legSteps++
                }
            }
        }
        return Run(sqrt(squares / steps), Double.NaN, false)
    }

    private fun noise(model: GaussianNoise) = model.step(0.0, 1.0, Conditions.NONE)

    private fun offLeg(boat: BoatDynamics, leg: Int): Double {
        val a = path[leg]
        val b = path[leg + 1]
        val length = a.distanceTo(b)
        val along = ((boat.x - a.x) * (b.x - a.x) + (boat.y - a.y) * (b.y - a.y)) / length
        val t = along.coerceIn(0.0, length) / length
        return hypot(boat.x - a.x - t * (b.x - a.x), boat.y - a.y - t * (b.y - a.y))
    }

    @Test
    fun crossTrackErrorStaysBelowAMetreInACrossCurrent() {
        for (mixing in Mixing.entries) {
            // Seeds fixed before the first run.
            val runs = (301..320).map { run(it, mixing, currentX = 0.0, currentY = 0.3) }
            val whole = runs.maxOf { it.rms }
            val legs = runs.maxOf { it.onLegs }
            val text =
                "$mixing: RMS of the whole path ${runs.map { it.rms }.average()} m on average, $whole m at worst; " +
                    "of the legs without their ends ${runs.map { it.onLegs }.average()} m, $legs m"
            if (java.lang.Boolean.getBoolean("stillwater.show")) println(text)
            assertTrue(runs.all { it.finished }, "$mixing: every run ends")
            // The bar. A swivelled thruster turns in a bow only, which counts for its corners, not its legs.
            assertTrue(legs < 1.0, text)
            if (mixing == Mixing.DIFFERENTIAL) assertTrue(whole < 1.0, text)
        }
    }

    @Test
    fun theDriftIsLearned() {
        val random = Random(11)
        val noise = GaussianNoise(1.5, random)
        val track = TrackEstimator()
        for (second in 0..600) {
            track.advance(1.0, 0.0, 1.0)
            track.fix(1.0 * second + noise(noise), 0.3 * second + noise(noise))
        }
        // Steady state: the drift's deviation is 0.05 m/s for this noise; three of them.
        assertEquals(0.3, track.driftY, 0.15)
        assertEquals(0.0, track.driftX, 0.15)
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
