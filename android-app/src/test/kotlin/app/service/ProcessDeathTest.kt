package stillwater.app.service

import android.app.Application
import org.junit.Rule
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.RobolectricTestRunner
import org.robolectric.RuntimeEnvironment
import org.robolectric.annotation.Config
import stillwater.app.link.LinkChoice
import stillwater.app.mission.LogFolder
import stillwater.app.mission.MissionReport
import stillwater.control.Danger
import stillwater.mission.MissionState
import stillwater.mission.RecoveredMission
import java.io.File
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** The process ends without a word, whatever the mission is about: it comes back disarmed, with its map and its log. */
@RunWith(RobolectricTestRunner::class)
@Config(sdk = [34])
class ProcessDeathTest {
    private val context: Application = RuntimeEnvironment.getApplication()

    @get:Rule
    internal val pond = Pond()
    private val desk get() = pond.desk

    @Test
    fun whileItWaitsForFixesThatAgree() {
        desk.ask { start() }
        desk.pass(3.0)
        assertEquals(MissionState.Preflight(Danger.FIX_STALE), desk.state)
        sameMap(read(dieAndComeBack()))
        survey()
    }

    @Test
    fun whileItsBoardArms() {
        desk.ask { start() }
        assertTrue(desk.until(20.0) { it.mission?.state == MissionState.Arming }, "${desk.state}")
        desk.pass(1.0)
        dieAndComeBack()
        survey()
    }

    @Test
    fun whileItSurveysAndItGoesOnInTheSameLog() {
        survey()
        desk.pass(40.0)
        val before = desk.report
        val file = dieAndComeBack()
        val logged = read(file)
        assertTrue(logged.readings > 30)
        sameMap(logged)
        sameWay(before, desk.report)
        val recovered = desk.report

        survey()
        desk.pass(20.0)
        assertEquals(listOf(file.name), logs().map { it.name }, "the same log goes on")
        assertEquals(recovered.trace, desk.report.trace.take(recovered.trace.size))
        assertEquals(recovered.track, desk.report.track.take(recovered.track.size))
        assertTrue(desk.report.trace.size > recovered.trace.size && desk.report.track.size > recovered.track.size)
        desk.ask { stop() }
        assertTrue(desk.until(10.0) { it.mission?.isOver == true })
        desk.pass(1.0)
        val whole = read(logs().single())
        assertEquals(1L, whole.unreadable, "the line that was cut")
        sameMap(whole)
    }

    @Test
    fun whileItHolds() {
        survey()
        desk.pass(10.0)
        desk.ask { hold() }
        assertTrue(desk.until(1.0) { it.mission?.state == MissionState.Holding(Danger.OPERATOR_HOLD) })
        desk.pass(3.0)
        sameMap(read(dieAndComeBack()))
    }

    @Test
    fun whileItReturns() {
        survey()
        desk.pass(20.0)
        desk.ask { goHome() }
        assertTrue(desk.until(1.0) { it.mission?.state == MissionState.Returning(Danger.OPERATOR_RETURN) })
        desk.pass(2.0)
        sameMap(read(dieAndComeBack()))
    }

    /** STOP was pressed, and the process ended before the board had said that it is disarmed. */
    @Test
    fun whileItStops() {
        survey()
        desk.pass(5.0)
        desk.ask { stop() }
        assertFalse(desk.report.isOver)
        dieAndComeBack()
    }

    @Test
    fun whatARealBoatBeganTheDemoDoesNotGoOnWith() {
        survey()
        desk.pass(5.0)
        val file = dieAndComeBack()
        val name = desk.snapshot.linkName
        desk.ask { onStartCommand(BoatService.startIntent(context, LinkChoice.Demo), 0, 2) }
        desk.pass(5.0)
        assertTrue(desk.snapshot.isDemo)
        val before = file.readText()
        desk.ask { start() }
        desk.pass(1.0)
        assertEquals(Answer(Answer.Reason.OF_A_REAL_BOAT), desk.snapshot.answer)
        assertEquals(MissionState.Idle, desk.state)
        assertEquals(before, file.readText())
        // Its own boat is taken up again, and goes on.
        desk.ask { onStartCommand(BoatService.startIntent(context, ServiceDesk.BOARD), 0, 3) }
        pond.green()
        assertEquals(name, desk.snapshot.linkName)
        survey()
        val whole = read(file)
        assertEquals(name to false, whole.boat to whole.isVirtual)
    }

    @Test
    fun whatTheDemoBeganARealBoatDoesNotGoOnWith() {
        survey()
        desk.pass(5.0)
        dieAndComeBack { it.replace("\"virtual\":false", "\"virtual\":true") }
        pond.green()
        desk.ask { start() }
        desk.pass(1.0)
        assertEquals(Answer(Answer.Reason.OF_THE_VIRTUAL_BOAT), desk.snapshot.answer)
        assertEquals(MissionState.Idle, desk.state)
    }

    private fun survey() = pond.survey()

    private fun logs() = pond.logs()

    private fun read(file: File) = pond.read(file)

    /** Kills the process and has Android start it anew; answers the log as it was left: a line cut, then [made]. */
    private fun dieAndComeBack(made: (String) -> String = { it }): File {
        val file = logs().single()
        assertTrue(file.name.endsWith(LogFolder.INCOMPLETE))
        val left = made(file.readText().dropLast(20))
        desk.end()
        // As it was on the disk, and at the board: nobody closed anything, nor rested the motors.
        pond.wire.fromPhone()
        file.writeText(left)
        val told = desk.told.length
        desk.start(intent = null)
        desk.pass(5.0)
        assertEquals(BoatActivity.RECOVERED, desk.snapshot.activity)
        assertEquals(MissionState.Idle, desk.state)
        assertTrue(desk.report.isRecovered)
        assertTrue(DISARM in desk.told.substring(told), "disarmed")
        assertFalse("arm\"" in desk.told.substring(told).replace(DISARM, ""), "and not armed")
        assertTrue(desk.boat.board.actuation.isAtRest)
        assertEquals("connected", desk.snapshot.board.state?.word)
        assertEquals(listOf(file.name), logs().map { it.name })
        return file
    }

    /** What was shown before the process died is shown after it, but for what was not on the disk yet: a second. */
    private fun sameWay(before: MissionReport, after: MissionReport) {
        assertEquals(before.trace.take(after.trace.size), after.trace)
        assertTrue(after.trace.size >= before.trace.size - 2, "${after.trace.size} of ${before.trace.size}")
        assertTrue(after.track.size > 10 && after.track.size >= before.track.size - 4)
        val off = before.track.zip(after.track).maxOf { (a, b) -> a.distanceTo(b) }
        assertEquals(0.0, off, 1e-3) // m; the log has places as the boats' tools know them, by UTM
    }

    private fun sameMap(logged: RecoveredMission) {
        val (ours, read) = desk.report.map to logged.estimator.map
        for (cell in 0 until ours.grid.size) {
            assertEquals(read.value(cell), ours.value(cell), 0.0)
            assertEquals(read.upper(cell), ours.upper(cell), 0.0)
            assertEquals(read.readings(cell), ours.readings(cell))
        }
    }

    private companion object {
        const val DISARM = "{\"e\":{\"cmd\":\"disarm\"}}"
    }
}
