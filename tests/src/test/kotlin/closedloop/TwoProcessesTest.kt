package stillwater.closedloop

import org.junit.jupiter.api.Assumptions.assumeFalse
import org.junit.jupiter.api.Assumptions.assumeTrue
import org.junit.jupiter.api.Test
import org.junit.jupiter.api.io.TempDir
import org.junit.jupiter.api.parallel.Isolated
import stillwater.mission.LogStart
import stillwater.mission.Mission
import stillwater.mission.MissionLog
import stillwater.mission.MissionSpec
import stillwater.mission.MissionState
import stillwater.virtual.BoardSpec
import stillwater.world.VirtualWorld
import stillwater.world.WorldSettings
import stillwater.world.WorldSite
import java.io.File
import kotlin.math.abs
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/**
 * A mission in one process, the boat in another, bytes between them. The long runs are docs/closed-loop.md's.
 *
 * With no test beside it: both keep time by the clock.
 */
@Isolated
class TwoProcessesTest {
    @TempDir
    private lateinit var directory: File

    private val text = """{"name":"pond","origin":{"lat_deg":45.5,"lon_deg":-73.6},
        "area":{"south_west":{"x_m":-20,"y_m":-20},"north_east":{"x_m":60,"y_m":60}},
        "grid":{"south_west":{"x_m":0,"y_m":0},"columns":4,"rows":4,"cell_m":10},
        "probe":{"quantity":"dissolved-oxygen","port":1,"lowest":0,"highest":15},
        "estimator":"interval","planner":"lawnmower","budget":{"seconds":250},"home":{"x_m":5,"y_m":5}}"""
    private val spec = MissionSpec.fromJson(text)

    private fun boat(vararg arguments: String): Pair<Program, List<String>> {
        directory.resolve("pond.json").writeText(text)
        val boat = Program(directory, "virtual-boat", "pond.json", "--probe-period", "1", "--seed", "$SEED", *arguments)
        val board = boat.await { it.startsWith("board ") }.removePrefix("board ")
        val phone = boat.await { it.startsWith("phone ") }.removePrefix("phone ")
        return boat to listOf("--port", board, "--phone", phone)
    }

    private fun drive(to: List<String>, vararg more: String) =
        Program(directory, "drive", "pond.json", *to.toTypedArray(), "--out", "out", "--yes", "--numbers-only", *more)

    /** The cells' values that a run in one process gives. */
    private fun inOneProcess(): Pair<VirtualWorld, List<Double>> {
        val world = VirtualWorld(WorldSettings(seed = SEED, board = BoardSpec(oxygenPeriod = 1.0)), WorldSite.of(spec))
        val mission = Mission(spec, world.boat.phone, MissionLog({}, LogStart(0, ""), spec))
        while (mission.state !is MissionState.Stopped) {
            world.advance(0.1)
            world.boat.takeFix()?.let { mission.fix(it.time, it.place) }
            mission.compass(world.time, world.boat.heading(), world.boat.yawRate)
            // `drive` lets a board that was just opened boot for 3 s.
            if (world.time.seconds >= 3.0 && mission.state == MissionState.Idle) mission.start()
            mission.step(world.time)
            assertTrue(world.time.seconds < 600, "it ends within its budget")
        }
        return world to (0 until mission.map.grid.size).map { mission.map.value(it) }
    }

    private fun cells(file: String, column: String): List<Double> {
        val lines = directory.resolve(file).readLines()
        val at = lines[0].split(',').indexOf(column)
        return lines.drop(1).map { it.split(',')[at].toDouble() }
    }

    private fun sailsAsInOneProcess(wire: List<String>) {
        val (boat, ports) = boat(*wire.toTypedArray(), "--speed", "500", "--once", "--out", "truth")
        boat.use {
            drive(ports).use { drive ->
                assertEquals(0, drive.end(), "$drive")
                assertEquals(0, boat.end(), "$boat")
                assertContains("$drive", "completed")
                assertFalse("holding" in "$drive", "$drive")
            }
        }
        val truth = cells("truth/truth.csv", "mean")
        fun error(values: List<Double>) = values.indices.sumOf { abs(values[it] - truth[it]) } / values.size
        val (world, expected) = inOneProcess()
        assertEquals(truth, truth.indices.map(world::meanTruth), "it is the same water")
        val own = error(cells("out/cells.csv", "value"))
        val best = error(expected)
        // The bar.
        assertTrue(abs(own - best) < 0.1 * best, "mean error $own over $wire, $best in one process")
        // The log is whole and gives the same map again.
        assertFalse(directory.resolve("out/mission.txt.incomplete").exists())
        Program(directory, "replay", "out/mission.txt", "--numbers-only", "--out", "again").use { replay ->
            assertEquals(0, replay.end(), "$replay")
            assertContains("$replay", SAME)
        }
        for (name in listOf("cells.csv", "mission.txt")) {
            val recorded = directory.resolve("out/$name").readText()
            assertEquals(recorded, directory.resolve("again/$name").readText(), name)
        }
    }

    @Test
    fun aMissionOverTcpIsAsGoodAsInOneProcess() = sailsAsInOneProcess(listOf("--tcp", "0"))

    @Test
    fun aMissionOverAPseudoTerminalIsAsGoodAsInOneProcess() {
        assumeTrue("linux" in System.getProperty("os.name").lowercase(), "pseudo-terminals are made on Linux only")
        sailsAsInOneProcess(listOf("--pty"))
    }

    /** The library for serial ports has the system ignore the signal of a terminal that was closed. */
    @Test
    fun aTerminalThatIsClosedStopsABoatOnASerialPort() {
        assumeTrue("linux" in System.getProperty("os.name").lowercase(), "pseudo-terminals are made on Linux only")
        assumeFalse(isHangUpIgnored(), "run under nohup, whose programs are to survive their terminal")
        val (boat, ports) = boat("--pty", "--speed", "20", "--once")
        boat.use {
            drive(ports).use { drive ->
                drive.await { "arming" in it }
                drive.hangUp()
                assertEquals(1, drive.end(), "$drive")
                assertContains("$drive", "operator")
                assertTrue(directory.resolve("out/mission.txt").exists())
                assertEquals(0, boat.end(), "$boat")
            }
        }
    }

    /** Programs inherit which signals are ignored; SIGHUP is the lowest bit of a hexadecimal number. */
    private fun isHangUpIgnored(): Boolean =
        File("/proc/self/status").readLines().first { it.startsWith("SigIgn:") }.last().digitToInt(16) % 2 == 1

    @Test
    fun aMissionWhoseProgramWasKilledGoesOnDisarmedAndLosesASecondAtMost() {
        val speed = 50
        val (boat, ports) = boat("--tcp", "0", "--speed", "$speed")
        boat.use {
            val seen = drive(ports).use { drive ->
                val line = drive.await { "surveying" in it && it.trim().substringBefore('.').toInt() > 60 }
                drive.kill()
                line.trim().substringBefore(' ').toDouble()
            }
            val log = directory.resolve("out/mission.txt.incomplete")
            val last = log.readLines().mapNotNull { TIME.find(it) }.last().groupValues[1].toDouble()
            assertTrue(last > seen - speed, "the log ends at $last s, the boat was seen at $seen s")
            // Cut in the middle of a line, as on a disk that was full or a battery that was flat.
            log.writeText(log.readText().dropLast(40))
            drive(ports).use { fresh ->
                assertEquals(2, fresh.end(), "$fresh")
                assertContains("$fresh", "--resume goes on with it")
            }
            drive(ports, "--resume").use { drive ->
                drive.await { "recovered" in it && "bytes of a cut line taken off" in it }
                drive.await { "surveying" in it }
                drive.interrupt()
                assertEquals(1, drive.end(), "$drive")
                assertContains("$drive", "operator")
                assertContains("$drive", "before it was taken up again")
            }
            // The wall's clock went on by a fraction of what the boat's did.
            Program(directory, "map", "out/mission.txt", "--quiet", "--out", "mapped").use { map ->
                assertEquals(0, map.end(), "$map")
            }
            Program(directory, "replay", "out/mission.txt", "--numbers-only", "--out", "again").use { replay ->
                assertEquals(0, replay.end(), "$replay")
                assertContains("$replay", "2 beginnings")
                assertContains("$replay", SAME)
            }
        }
    }

    private companion object {
        const val SEED = 20_261_121L
        const val SAME = "every step as recorded; the map is that of the recorded readings, bit for bit"
        val TIME = Regex(""""mission":\{"t_s":([0-9.]+)""")
    }
}
