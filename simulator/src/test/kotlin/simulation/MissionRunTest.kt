package stillwater.simulation

import com.github.ajalt.mordant.rendering.Size
import com.github.ajalt.mordant.terminal.Terminal
import com.github.ajalt.mordant.terminal.TerminalInterface
import com.github.ajalt.mordant.terminal.TerminalRecorder
import org.junit.jupiter.api.Test
import stillwater.mission.EstimatorName
import stillwater.mission.MissionState
import stillwater.mission.StopReason
import stillwater.run.label
import stillwater.virtual.BoardSpec
import stillwater.virtual.LinkSpec
import stillwater.virtual.PoseSpec
import stillwater.world.WaterKind
import stillwater.world.WorldSettings
import kotlin.test.assertEquals
import kotlin.test.assertNotNull
import kotlin.test.assertTrue

/** Seeds fixed before the first run. */
class MissionRunTest {
    private val older = BoardSpec(oxygenPeriod = 1.0)

    @Test
    fun mapsOfTheWholeStackAreAsGoodAsTheSameReadingsInProcess() {
        for (estimator in EstimatorName.entries) {
            val planner = when (estimator) {
                EstimatorName.SELF_CALIBRATING -> "lawnmower"
                EstimatorName.BAYESIAN -> "information"
                else -> "bounded-extended"
            }
            val spec = SmallMission.tenByTen(estimator.label, planner)
            val results = (511L..512L).map { SmallMission.sail(spec, WorldSettings(seed = it, board = older)) }
            for (result in results) {
                assertEquals(MissionState.Stopped(StopReason.COMPLETED), result.run.mission.state)
                // A planner that gets no bounds leaves some cells out.
                assertTrue(result.comparedError.cells >= 70, "${result.comparedError.cells} cells")
            }
            val ratio = results.sumOf { it.comparedError.mean } / results.sumOf { it.inProcessError.mean }
            // The issue's bar: equal within 10 %. Those that learn the sensor may be better: the mission tells them how well
            // its places are known.
            val least = if (results[0].run.mission.unplaced > 0) 0.0 else 0.9
            assertTrue(ratio in least..1.1, "$estimator: the mission's error is $ratio times that in process")
        }
    }

    @Test
    fun withPerfectFixesTheMapInProcessIsTheMissions() {
        // With fixes at every step and no delay the believed place is the true one to some centimetres: only readings at
        // a border can fall into another cell.
        val settings = WorldSettings(
            seed = 521,
            board = older,
            link = LinkSpec(delay = 0.0),
            pose = PoseSpec(fixPeriod = 0.1, fixDeviation = 0.0, compassDeviation = 0.0),
        )
        val result = SmallMission.sail(SmallMission.pond("averaging"), settings)
        val off = (0 until 36).count { result.map.readings(it) != result.inProcess.readings(it) }
        assertTrue(off <= 8, "$off of 36 cells have other readings")
        assertTrue(result.run.track.poseError < 0.3, "${result.run.track.poseError} m")
    }

    @Test
    fun readingsAtPlacesThatTheMissionDoesNotSailByAreTold() {
        val settings = WorldSettings(seed = 523, board = older, pose = PoseSpec(fixDeviation = 30.0))
        val result = SmallMission.sail(SmallMission.pond("averaging"), settings)
        val mission = result.run.mission
        assertTrue(mission.doubtedReadings > mission.readings.passed / 2, "${mission.doubtedReadings}")
        assertTrue(SimulationSummary(result, "mg/L").warnings.any { "place was in doubt" in it })
        val usual = SmallMission.sail(SmallMission.pond("averaging"), WorldSettings(seed = 523, board = older))
        assertTrue(usual.run.mission.doubtedReadings > 0, "until fixes have agreed")
        assertTrue(SimulationSummary(usual, "mg/L").warnings.none { "place was in doubt" in it })
    }

    @Test
    fun everyReadingIsAccountedForOnABadLink() {
        val settings = WorldSettings(seed = 522, board = older, link = LinkSpec(loss = 1e-3, corruption = 1e-3))
        val result = SmallMission.sail(SmallMission.pond("bounded-extended"), settings)
        val account = result.readings
        assertTrue(account.isComplete, "$account")
        assertEquals(account.received, account.logged)
        assertTrue(account.lost > 10, "$account")
        assertTrue(account.sent > 250, "$account")
        assertTrue(result.unreadable.values.sum() == result.run.mission.board.unreadable)
        assertTrue(SimulationSummary(result, "mg/L").warnings.none { "add up" in it })
    }

    @Test
    fun waterThatChangesWithinACellIsSaidWhereNoSensorModelExplainsIt() {
        val settings = WorldSettings(seed = 523, water = WaterKind.SMOOTH, board = older)
        val result = SmallMission.sail(SmallMission.tenByTen("self-calibrating", "lawnmower"), settings)
        val belief = assertNotNull(result.belief)
        assertEquals(listOf(false, false), listOf(belief.isExplained, belief.areCellsEven))
        val warnings = SimulationSummary(result, "mg/L").warnings
        assertTrue(warnings.any { "changes at their borders and not within them" in it }, "$warnings")
    }

    @Test
    fun aWeakBatteryBringsTheBoatHomeAndTheHistorySaysSo() {
        val spec = SmallMission.pond("averaging", """"failsafe":{"lowest_volts":14.9},""")
        val settings = WorldSettings(seed = 524).let { it.copy(battery = it.battery.copy(capacity = 20.0)) }
        val result = SmallMission.sail(spec, settings)
        val states = result.run.history.spans
        assertEquals("stopped (battery)", states.last().label)
        assertTrue(states.any { it.label == "returning (battery-low)" }, "$states")
        for ((before, after) in states.zipWithNext()) assertEquals(before.until, after.from)
    }

    /** Nobody watches the battery, or below a voltage that it has only when it is empty. */
    @Test
    fun aBoatWhoseBatteryIsEmptyGoesNoFartherAndThatIsSaid() {
        for ((more, isSeen) in listOf("" to false, """"failsafe":{"lowest_volts":12.0},""" to true)) {
            val settings = WorldSettings(seed = 527).let { it.copy(battery = it.battery.copy(capacity = 3.0)) }
            val result = SmallMission.sail(SmallMission.pond("averaging", more), settings)
            val run = result.run
            val empty = assertNotNull(run.world.emptySince).seconds
            // From then on the electronics' 8 W alone are used, and the boat loses its way.
            assertEquals(3.0 + 8 * (run.time.seconds - empty) / 3600, run.world.battery.used, 0.01)
            val labels = run.history.spans.filter { it.until > empty }.map { it.label }
            assertEquals(isSeen, labels.any { "battery-low" in it }, "$labels")
            assertEquals(0.0, run.world.boat.dynamics.surge, 1e-5)
            val warnings = SimulationSummary(result, "mg/L").warnings
            assertTrue(warnings.any { "the battery was empty after" in it }, "$warnings")
        }
    }

    @Test
    fun aMissionThatIsNotOverInItsTimeIsSaid() {
        val result = SmallMission.sail(SmallMission.pond("averaging"), WorldSettings(seed = 525), longest = 60.0)
        assertEquals(false, result.isOver)
        val warnings = SimulationSummary(result, "mg/L").warnings
        assertTrue(warnings.any { "not over after 1:00 min" in it }, "$warnings")
    }

    @Test
    fun thePictureInATerminalFitsIntoIt() {
        val run = MissionRun(SmallMission.pond("bounded-extended"), WorldSettings(seed = 526, board = older)) {}
        val picture = LivePicture(run)
        repeat(1200) {
            run.step()
            picture.listen()
        }
        for ((width, height) in listOf(100 to 40, 40 to 24, 12 to 5, 1 to 1, 0 to 0)) {
            val lines = picture.draw(width, height).lines()
            assertTrue(lines.size <= maxOf(height, 20), "${lines.size} lines in $height")
            assertTrue(lines.any { "@" in it }, "the boat is shown")
        }
        assertTrue("surveying" in picture.draw(100, 40))
    }

    /** A person may draw a terminal's window to nothing and back. */
    @Test
    fun aTerminalThatChangesItsSizeEndsNoRun() {
        val run = MissionRun(SmallMission.pond("averaging"), WorldSettings(seed = 526, board = older)) {}
        var size = Size(80, 24)
        val recorder = object : TerminalInterface by TerminalRecorder() {
            override fun getTerminalSize() = size
        }
        val view = LiveView(Terminal(terminalInterface = recorder), run, speed = 1e6)
        for (next in listOf(Size(0, 0), Size(1, 24), Size(2, 0), Size(80, 1), Size(100, 40))) {
            size = next
            repeat(300) {
                run.step()
                view.watch()
            }
            view.end()
        }
        assertTrue(run.readings.taken.size > 50, "${run.readings.taken.size} readings")
    }
}
