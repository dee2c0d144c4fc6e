package stillwater.mission

import stillwater.field.Field
import stillwater.field.FieldMap
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import stillwater.sensor.SensorSpec
import stillwater.virtual.BoardSpec
import stillwater.virtual.Hull
import stillwater.virtual.LinkSpec
import stillwater.virtual.PoseSpec
import stillwater.virtual.VirtualBoat
import stillwater.virtual.VirtualBoatSpec
import stillwater.wire.ByteLink
import kotlin.math.cos
import kotlin.math.sin
import kotlin.math.sqrt
import kotlin.random.Random

/** A mission and a virtual boat on one desk, in virtual time. */
internal class Desk(
    val spec: MissionSpec,
    seed: Int,
    link: LinkSpec = LinkSpec(),
    board: BoardSpec = QUICK,
    pose: PoseSpec = PoseSpec(),
    recovered: RecoveredMission? = null,
    wrapped: (ByteLink) -> ByteLink = { it },
) {
    private val grid = spec.grid.grid()
    val field = field(Random(seed))
    val boat = VirtualBoat(
        VirtualBoatSpec(PROBE, Hull(), board, link, pose, start = spec.home.position, restsAt = 7.0),
        field,
        LocalFrame(LatLon(spec.origin.latitude, spec.origin.longitude)),
        seed.toLong(),
    )
    val lines = ArrayList<String>()
    val log = MissionLog(lines::add, LogStart(1_700_000_000_000, "2023-11-14 22:13:20"), spec)
    val mission = Mission(spec, wrapped(boat.phone), log, recovered = recovered)

    /** Where the boat really was, by the tick of a tenth of a second. */
    val trueX = ArrayList<Double>()
    val trueY = ArrayList<Double>()

    /** What happens in each step besides, before the mission's. */
    var meanwhile: () -> Unit = {}

    /** Lets one tenth of a second pass. */
    fun step(): MissionState {
        boat.advance(0.1)
        trueX.add(boat.dynamics.x)
        trueY.add(boat.dynamics.y)
        meanwhile()
        boat.takeFix()?.let { mission.fix(it.time, it.place) }
        mission.compass(boat.time, boat.heading(), boat.yawRate)
        return mission.step(boat.time)
    }

    /** Lets time pass until [ended] holds, for [seconds] s at most; answers whether it does. */
    fun until(seconds: Double, ended: (MissionState) -> Boolean): Boolean {
        repeat((seconds * 10).toInt()) { if (ended(step())) return true }
        return false
    }

    /** What the log makes of the mission. */
    fun replayed(): RecoveredMission = checkNotNull(replay(lines).recovered())

    /** Root mean square error of [map] over the cells that have readings, mg/L. */
    fun error(map: FieldMap): Double {
        var squares = 0.0
        var cells = 0
        for (cell in 0 until grid.size) {
            if (map.readings(cell) == 0) continue
            val error = map.value(cell) - field.truth(grid.centerX(cell), grid.centerY(cell), boat.time)
            squares += error * error
            cells++
        }
        return sqrt(squares / cells)
    }

    companion object {
        /** Firmware v4.2.0 with the shorter watchdog that the bar of 0.6 s asks for. */
        val QUICK = BoardSpec(oxygenPeriod = 1.0, watchdog = 0.5, batteryPeriod = 1.0)

        fun replay(lines: List<String>) = MissionRecovery().apply { lines.forEach(::line) }

        /** A probe with a lag of 6 s and little noise. */
        private val PROBE = SensorSpec.fromJson(
            """{"name":"probe","stages":[{"type":"first-order-lag","time_constant_s":6.0},""" +
                """{"type":"noise","standard_deviation":0.02}]}""",
        )

        /** Six by six cells of 10 m in a rectangle 15 m larger all round. */
        const val SMALL = """{"name":"pond","origin":{"lat_deg":45.5,"lon_deg":-73.6},
            "area":{"south_west":{"x_m":-20,"y_m":-20},"north_east":{"x_m":80,"y_m":80}},
            "grid":{"south_west":{"x_m":0,"y_m":0},"columns":6,"rows":6,"cell_m":10},
            "probe":{"quantity":"dissolved-oxygen","port":1,"lowest":0,"highest":15},
            "estimator":"self-calibrating","planner":"lawnmower","budget":{"seconds":900},
            "home":{"x_m":5,"y_m":5}}"""

        fun small() = MissionSpec.fromJson(SMALL)

        private fun field(random: Random): Field {
            val phase = random.nextDouble(6.28)
            val slope = random.nextDouble(-0.04, 0.04)
            return Field { x, y, _ -> 7.5 + slope * y + 1.5 * sin(phase + x / 15) * cos(phase + y / 20) }
        }
    }
}
