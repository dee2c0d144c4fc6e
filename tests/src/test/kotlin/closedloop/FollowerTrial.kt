package stillwater.closedloop

import stillwater.control.FollowerSettings
import stillwater.control.Mixing
import stillwater.control.TrackEstimator
import stillwater.control.WaterSpeed
import stillwater.control.WaypointFollower
import stillwater.model.Conditions
import stillwater.model.Drive
import stillwater.model.Position
import stillwater.sensor.GaussianNoise
import stillwater.virtual.BoatDynamics
import stillwater.virtual.Hull
import java.util.Locale
import kotlin.math.PI
import kotlin.math.cos
import kotlin.math.hypot
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.random.Random

/**
 * A boat that follows a survey's legs across a current, seen by fixes of 1.5 m once a second and a compass that is 2 degrees
 * off, with a hull whose drag the follower does not know; the bar.
 *
 * @property turning whether the current turns round once in ten minutes and swells by a half, else it runs across the legs.
 */
internal class FollowerTrial(private val mixing: Mixing, private val turning: Boolean) {
    /** Root mean square distances from the path, m: of all of it, and of its long legs without their last 10 m. */
    class Result(val whole: Double, val legs: Double, val finished: Boolean)

    /** Five legs of 60 m, 10 m apart. */
    private val path = buildList {
        for (row in 0..4) {
            val eastward = row % 2 == 0
            add(Position(if (eastward) 0.0 else 60.0, 10.0 * row))
            add(Position(if (eastward) 60.0 else 0.0, 10.0 * row))
        }
    }

    private val hull = Hull()
    private var leg = 0
    private val squares = DoubleArray(2)
    private val counts = IntArray(2)

    fun run(seed: Long): Result {
        val random = Random(seed)
        val fixNoise = GaussianNoise(FIX_DEVIATION, random)
        val compassNoise = GaussianNoise(COMPASS_DEVIATION, random)
        val phase = if (turning) random.nextDouble(2 * PI) else PI / 2
        // It drifts for 30 s, as while it arms, and gets to the first leg about when it may go.
        val boat = BoatDynamics(hull, x = -30 * CURRENT * cos(phase), y = -30 * CURRENT * sin(phase))
        val track = TrackEstimator()
        val speed = WaterSpeed(hull.topSpeed)
        val follower = WaypointFollower(FollowerSettings(hull.topSpeed, turnThrust = mixing.turnThrust))
        leg = 0
        squares.fill(0.0)
        counts.fill(0)
        var drive = Drive.NONE
        for (tick in 0 until LONGEST) {
            flow(boat, phase, tick / TICKS)
            val compass = boat.heading + COMPASS_OFFSET + noise(compassNoise)
            speed.advance(1 / TICKS, mixing.ahead(drive))
            track.advance(1 / TICKS, compass, speed.value)
            if (tick % TICKS.toInt() == 0) track.fix(boat.x + noise(fixNoise), boat.y + noise(fixNoise))
            if (tick == START || (tick > START && follower.arrived)) {
                if (++leg == path.size) return result(finished = true)
                lead(follower)
            }
            drive = if (tick < START) Drive.NONE else follower.steer(track, compass, boat.yawRate)
            boat.advance(1 / TICKS, mixing.mix(drive))
            if (tick >= START) count(boat)
        }
        return result(finished = false)
    }

    private fun flow(boat: BoatDynamics, phase: Double, seconds: Double) {
        val angle = if (turning) phase + 2 * PI * seconds / TURN else phase
        val size = if (turning) CURRENT * (1 + sin(angle) / 2) else CURRENT
        boat.currentX = size * cos(angle)
        boat.currentY = size * sin(angle)
    }

    private fun lead(follower: WaypointFollower) {
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

    private fun count(boat: BoatDynamics) {
        // At a corner the boat is between two legs.
        val error = (maxOf(0, leg - 2) until minOf(leg + 1, path.size - 1)).minOf { offLeg(boat, it) }
        add(0, error)
        if (leg % 2 == 1 && boat.x in 10.0..50.0) add(1, error)
    }

    private fun add(which: Int, error: Double) {
        squares[which] += error * error
        counts[which]++
    }

    private fun result(finished: Boolean) =
        Result(sqrt(squares[0] / counts[0]), sqrt(squares[1] / counts[1]), finished)

    private fun noise(model: GaussianNoise) = model.step(0.0, 1.0, Conditions.NONE)

    private fun offLeg(boat: BoatDynamics, leg: Int): Double {
        val a = path[leg]
        val b = path[leg + 1]
        val length = a.distanceTo(b)
        val along = ((boat.x - a.x) * (b.x - a.x) + (boat.y - a.y) * (b.y - a.y)) / length
        val t = along.coerceIn(0.0, length) / length
        return hypot(boat.x - a.x - t * (b.x - a.x), boat.y - a.y - t * (b.y - a.y))
    }

    companion object {
        const val CURRENT = 0.3
        const val TURN = 600.0
        const val FIX_DEVIATION = 1.5
        const val COMPASS_DEVIATION = 0.02
        const val COMPASS_OFFSET = 0.035
        const val TICKS = 10.0
        const val START = 300
        const val LONGEST = 9000

        /** A line for each drive and current over [seeds]. */
        fun table(seeds: LongRange): String = buildString {
            appendLine(
                "| drive | current | whole path, mean (worst), m | legs without their ends, mean (worst), m | ended |",
            )
            appendLine("|---|---|---|---|---|")
            for (mixing in Mixing.entries) {
                for (turning in listOf(false, true)) {
                    val runs = seeds.map { FollowerTrial(mixing, turning).run(it) }
                    val name = if (mixing == Mixing.DIFFERENTIAL) "two thrusters" else "one swivelled thruster"
                    val current = if (turning) "0.15 to 0.45 m/s, turning in 600 s" else "0.3 m/s across"
                    appendLine(
                        "| $name | $current | ${text(runs.map { it.whole })} | ${text(runs.map { it.legs })} | " +
                            "${runs.count { it.finished }} of ${runs.size} |",
                    )
                }
            }
        }

        private fun text(values: List<Double>) = "%.2f (%.2f)".format(Locale.ROOT, values.average(), values.max())
    }
}

/** `FIRST COUNT`: prints the table of core/docs/WaypointFollower.md. */
fun main(arguments: Array<String>) {
    val first = arguments[0].toLong()
    print(FollowerTrial.table(first until first + arguments[1].toLong()))
}
