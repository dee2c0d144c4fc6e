package stillwater.io

import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import stillwater.field.Field
import stillwater.mission.LogStart
import stillwater.mission.Mission
import stillwater.mission.MissionLog
import stillwater.mission.MissionSpec
import stillwater.model.LatLon
import stillwater.model.LocalFrame
import stillwater.model.Position
import stillwater.model.Reading
import stillwater.sensor.SensorSpec
import stillwater.virtual.BoardSpec
import stillwater.virtual.VirtualBoat
import stillwater.virtual.VirtualBoatSpec
import java.nio.file.Path
import kotlin.io.path.writeLines
import kotlin.math.hypot
import kotlin.math.roundToInt
import kotlin.math.sqrt
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** What a mission writes down is a Platypus log to whoever reads those. */
class MissionLogTest {
    @TempDir
    private lateinit var directory: Path

    private val lines = ArrayList<String>()

    /** Where the boat really was after each tenth of a second. */
    private val way = ArrayList<Position>()
    private val spec = MissionSpec.fromJson(
        """{"name":"pond","origin":{"lat_deg":45.5,"lon_deg":-73.6},
            "area":{"south_west":{"x_m":-20,"y_m":-20},"north_east":{"x_m":80,"y_m":80}},
            "grid":{"south_west":{"x_m":0,"y_m":0},"columns":6,"rows":6,"cell_m":10},
            "probe":{"quantity":"dissolved-oxygen","port":1,"lowest":0,"highest":15},
            "planner":"lawnmower","budget":{"seconds":900},"home":{"x_m":5,"y_m":5}}""",
    )

    /** Two minutes of a mission; answers the values that its map took, and where. */
    private fun sail(): List<Pair<Position, Double>> {
        val frame = LocalFrame(LatLon(45.5, -73.6))
        val water = Field { x, _, _ -> 7 + x / 40 }
        val boat = VirtualBoat(
            VirtualBoatSpec(
                SensorSpec("perfect", emptyList()),
                start = Position(5.0, 5.0),
                board = BoardSpec(oxygenPeriod = 0.5),
            ),
            water,
            frame,
            seed = 11,
        )
        val mission = Mission(spec, boat.phone, MissionLog(lines::add, LogStart(1_700_000_000_000, "2023-11-14"), spec))
        repeat(1200) { tick ->
            boat.advance(0.1)
            boat.takeFix()?.let { mission.fix(it.time, it.place) }
            mission.compass(boat.time, boat.heading(), boat.yawRate)
            if (tick == 30) mission.start()
            mission.step(boat.time)
            way += Position(boat.dynamics.x, boat.dynamics.y)
        }
        // Readings that waited for a later one are taken with it.
        val taken = Regex(""""taken":\[((?:\[[^]]*],?)+)]""")
        val one = Regex("""\[([^]]*)]""")
        return lines.mapNotNull { taken.find(it) }.flatMap { one.findAll(it.groupValues[1]) }.map { match ->
            val reading = match.groupValues[1].split(',').map { it.toDouble() }
            Position(reading[1], reading[2]) to reading[3]
        }
    }

    @Test
    fun aMissionsLogIsReadAsAPlatypusLog() {
        val taken = sail()
        assertTrue(taken.size > 200, "${taken.size} readings")
        val file = directory.resolve("mission.txt.incomplete").apply { writeLines(lines + lines.last().take(20)) }
        val log = SurveyLog.open(file, LogChoice(value = "ATLAS_DO"))
        val pass = log.read { _, _, _, _, _ -> }
        val found = log.readings()
        assertEquals("Platypus log 4.2.0", log.format)
        assertEquals(mapOf("truncated last line" to 1L), pass.skipped)
        assertEquals(taken.map { it.second }, found.map { it.value })
        assertEquals(1_700_000_000.0, found[0].time.seconds, 10.0)
        // The mission knew the fixes until then alone, the log's reader knows all.
        val missions = error(found, taken.map { it.first })
        val readers = error(found, placesOf(found, log))
        assertTrue(readers < 0.7 * missions, "off by $readers m, where the mission was by $missions m")
    }

    @Test
    fun withoutFixesAMissionsReadingsAreWhereItsPosesAre() {
        val taken = sail()
        val file = directory.resolve("mission.txt")
        file.writeLines(lines.map { it.replace(Regex(""""fix":\[\[[^]]*]],?"""), "") })
        val log = SurveyLog.open(file)
        val found = log.readings()
        // A line's stamp may be some ms after its step, at 1.6 m/s at most.
        val places = placesOf(found, log)
        for (i in taken.indices) {
            val off = hypot(places[i].x - taken[i].first.x, places[i].y - taken[i].first.y)
            assertTrue(off < 0.02, "reading $i is $off m off")
        }
    }

    @Test
    fun fixesThatAreWildAreToldAndLeftOut() {
        sail()
        val file = directory.resolve("mission.txt")
        val wild = lines.indexOfFirst { it.startsWith("59") && "\"fix\":[[" in it }
        lines[wild] = lines[wild].replace(Regex("""(?<="fix":\[\[[0-9.]{1,20},)45\.5"""), "45.6")
        file.writeLines(lines)
        val pass = SurveyLog.open(file).read { _, _, _, _, _ -> }
        assertEquals(listOf("1 of 120 fixes: too far off the others, left out"), pass.warnings)
    }

    /** The places of [readings] in the mission's frame, m: the log's begins at its first pose. */
    private fun placesOf(readings: List<Reading>, log: SurveyLog): List<Position> {
        val frame = LocalFrame(LatLon(45.5, -73.6))
        val own = checkNotNull(log.frame)
        return readings.map { frame.toLocal(own.toLatLon(it.position)) }
    }

    /** Root mean square of how far [places] are from where the boat was when the [readings] came, m. */
    private fun error(readings: List<Reading>, places: List<Position>) = sqrt(
        readings.indices.sumOf { i ->
            val (x, y) = way[((readings[i].time.seconds - 1_700_000_000) * 10).roundToInt()]
            (places[i].x - x) * (places[i].x - x) + (places[i].y - y) * (places[i].y - y)
        } / readings.size,
    )
}
