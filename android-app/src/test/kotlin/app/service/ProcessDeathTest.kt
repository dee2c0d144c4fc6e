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

    /** Two missions were cut off: the one written last comes back, the other is told of, and neither is lost. */
    @Test
    fun ofTwoThatWereCutOffEitherCanBeGoneOnWith() {
        survey()
        desk.pass(20.0)
        val first = pond.logs().single()
        desk.end()
        val kept = first.readText()
        first.delete()
        desk.start(intent = null)
        pond.load(ServiceDesk.POND.replace("\"pond\"", "\"bay\""))
        survey()
        desk.pass(5.0)
        val second = pond.logs().single()
        first.writeText(kept)
        first.setLastModified(second.lastModified() - 60_000)
        desk.end()
        desk.start(intent = null)
        desk.pass(5.0)
        assertEquals("bay", desk.report.spec.name)
        assertEquals(listOf(first.name), desk.snapshot.cutOff.map { it.name })

        desk.service.goOnWith(first.name)
        desk.settle()
        desk.pass(1.0)
        assertEquals("pond", desk.report.spec.name)
        assertTrue(desk.report.isRecovered)
        sameMap(read(first))
        assertEquals(listOf(second.name), desk.snapshot.cutOff.map { it.name }, "as it was, on the disk")
        pond.green()
        survey()
        desk.service.goOnWith(second.name)
        desk.pass(5.0)
        assertEquals(Answer(Answer.Reason.UNDER_WAY), desk.snapshot.answer)
        // The process dies again: the one that was under way comes back, though the other was begun later.
        second.setLastModified(first.lastModified() - 60_000)
        desk.end()
        desk.start(intent = null)
        desk.pass(5.0)
        assertEquals("pond", desk.report.spec.name)
        desk.service.goOnWith("no-such.log.incomplete")
        desk.settle()
        assertEquals(Answer(Answer.Reason.NOT_READABLE), desk.snapshot.answer)
        assertEquals(listOf(first.name, second.name).sorted(), pond.logs().map { it.name })
    }

    /**
     * "Another mission" is beside the controls, and gloves are wet: what was cut off can be gone on with all the same.
     */
    @Test
    fun whatWasCutOffIsNotClosedByLoadingAnother() {
        survey()
        desk.pass(5.0)
        val file = dieAndComeBack()
        desk.ask { newMission() }
        desk.pass(1.0)
        assertEquals(null, desk.snapshot.mission)
        assertEquals(listOf(file.name), desk.snapshot.cutOff.map { it.name })
        desk.ask { load(ServiceDesk.POND.replace("\"pond\"", "\"bay\"")) }
        desk.end()
        desk.start(intent = null)
        desk.pass(1.0)
        assertEquals("bay", desk.report.spec.name, "what was loaded last stays so")
        desk.service.goOnWith(file.name)
        desk.settle()
        desk.pass(1.0)
        sameMap(read(file))
        pond.green()
        survey()
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
