package stillwater.app.service

import android.app.Application
import android.app.NotificationManager
import android.app.Service
import android.content.ComponentName
import android.content.Intent
import android.content.pm.ServiceInfo
import android.os.Looper
import android.widget.TextView
import org.junit.Rule
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.Robolectric
import org.robolectric.RobolectricTestRunner
import org.robolectric.RuntimeEnvironment
import org.robolectric.Shadows.shadowOf
import org.robolectric.annotation.Config
import org.robolectric.shadows.ShadowNotification
import org.robolectric.shadows.ShadowPowerManager
import org.robolectric.shadows.ShadowSystemClock
import stillwater.app.R
import stillwater.app.link.BoardLink
import stillwater.app.link.LinkChoice
import stillwater.app.link.LinkMaker
import stillwater.app.mission.FileOutput
import stillwater.app.mission.LogFolder
import stillwater.app.mission.LogOpener
import stillwater.app.mission.LogOutput
import stillwater.app.screen.MainActivity
import stillwater.app.screen.preflightWords
import stillwater.app.screen.stateWords
import stillwater.app.screen.view
import stillwater.control.Danger
import stillwater.mission.MissionState
import stillwater.mission.StopReason
import stillwater.model.LatLon
import java.io.IOException
import java.time.Duration
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertNotNull
import kotlin.test.assertNull
import kotlin.test.assertTrue

/** What a person and bad luck do to a mission; the phone's side of it. */
@RunWith(RobolectricTestRunner::class)
@Config(sdk = [34])
class MissionServiceTest {
    private val context: Application = RuntimeEnvironment.getApplication()

    @get:Rule
    internal val pond = Pond()
    private val wire get() = pond.wire
    private val desk get() = pond.desk

    @Test
    fun aPersonHoldsItSendsItOnAndCallsItHome() {
        pond.survey()
        desk.ask { hold() }
        assertTrue(desk.until(1.0) { it.mission?.state == MissionState.Holding(Danger.OPERATOR_HOLD) })
        desk.ask { start() }
        assertTrue(desk.until(1.0) { it.mission?.state == MissionState.Surveying })
        desk.ask { load(ServiceDesk.POND) }
        assertEquals(Answer(Answer.Reason.UNDER_WAY), desk.snapshot.answer)
        desk.ask { newMission() }
        assertEquals(Answer(Answer.Reason.UNDER_WAY), desk.snapshot.answer)
        desk.pass(20.0)
        desk.ask { goHome() }
        assertTrue(desk.until(1.0) { it.mission?.state == MissionState.Returning(Danger.OPERATOR_RETURN) })
        assertNull(desk.snapshot.answer)
        assertTrue(desk.until(120.0) { it.mission?.state == MissionState.Stopped(StopReason.OPERATOR) })
        desk.ask { start() }
        assertTrue(desk.until(10.0) { it.mission?.isOver == true })
        desk.ask { start() }
        assertEquals(Answer(Answer.Reason.OVER), desk.snapshot.answer)
        desk.ask { newMission() }
        assertNull(desk.snapshot.mission)
        desk.ask { hold() }
        assertEquals(Answer(Answer.Reason.NOT_UNDER_WAY), desk.snapshot.answer)
        desk.ask { start() }
        assertEquals(Answer(Answer.Reason.NO_MISSION), desk.snapshot.answer)
    }

    @Test
    fun whenTheBudgetIsSpentItGoesHomeAndSaysSo() {
        desk.ask { load(ServiceDesk.POND.replace("\"seconds\":200", "\"seconds\":60")) }
        pond.survey()
        val returning = MissionState.Returning(Danger.BUDGET_SPENT)
        assertTrue(desk.until(70.0) { it.mission?.state == returning }, "${desk.state}")
        val words = "Going home: budget spent but for the way home"
        assertEquals(words, context.stateWords(desk.snapshot).lines().first())
        assertEquals(words, notification().contentTitle)
        assertTrue(desk.until(60.0) { it.mission?.state == MissionState.Stopped(StopReason.COMPLETED) })
        assertEquals("Stopped: done", context.stateWords(desk.snapshot).lines().first())
        assertTrue(desk.until(10.0) { it.mission?.isOver == true })
        desk.pass(1.0)
        assertTrue(desk.report.used <= desk.report.budget, "${desk.report.used} s of ${desk.report.budget} s")
        assertEquals("connected", desk.snapshot.board.state?.word)
    }

    /** Eleven kilometres from here. */
    @Test
    fun aMissionOfAnotherWaterIsNotBegun() {
        desk.ask { load(ServiceDesk.POND.replace("45.5", "45.6")) }
        desk.ask { start() }
        desk.pass(1.0)
        assertEquals(Answer(Answer.Reason.NOT_READY), desk.snapshot.answer)
        val red = desk.snapshot.preflight.single { !it.ready }
        assertEquals(PreflightCheck.PLACE to PreflightReason.OTHER_WATER, red.check to red.reason)
        assertEquals("11.1 km from here; is it the right mission?", context.preflightWords(red))
        assertEquals(MissionState.Idle, desk.state)
        assertFalse("\"arm\"" in desk.told)
    }

    /** The boat is still on its trailer: the checklist lets it, and the mission waits. */
    @Test
    fun aBoatBesideTheWaterIsNotArmedBeforeItIsOnIt() {
        desk.ask { load(ServiceDesk.POND.replace("45.5", "45.503")) }
        desk.pass(1.0)
        val line = desk.snapshot.preflight.single { it.check == PreflightCheck.PLACE }
        assertEquals(PreflightNote.ON_THE_WAY, line.note)
        assertTrue(line.ready && assertNotNull(line.metres) in 250.0..350.0, "$line")
        desk.ask { start() }
        desk.pass(25.0)
        assertEquals(MissionState.Preflight(Danger.FENCE), desk.state)
        assertEquals("Waiting: outside the area", context.stateWords(desk.snapshot).lines().first())
        assertFalse("\"arm\"" in desk.told)
    }

    @Test
    fun theWrongProbeIsNotedBeforeTheStart() {
        fun note() = desk.snapshot.preflight.single { it.check == PreflightCheck.PROBE }.note
        desk.pass(8.0)
        assertNull(note())
        for (other in listOf("\"quantity\":\"acidity\",\"port\":1", "\"quantity\":\"dissolved-oxygen\",\"port\":3")) {
            val spec = ServiceDesk.POND.replace("\"quantity\":\"dissolved-oxygen\",\"port\":1", other)
            pond.load(spec)
            assertEquals(PreflightNote.PROBE_SILENT, note(), other)
        }
    }

    @Test
    fun whatIsNoMissionIsToldAndTheOneBeforeStays() {
        desk.ask { load("""{"name":"pond"}""") }
        val answer = assertNotNull(desk.snapshot.answer)
        assertEquals(Answer.Reason.NOT_A_MISSION, answer.reason)
        assertTrue("origin" in answer.words.orEmpty(), answer.words)
        assertEquals("pond", desk.report.spec.name)
    }

    @Test
    fun theStopActionEndsAMissionFirstAndTheServiceOnlyAfterwards() {
        pond.survey()
        desk.ask { onStartCommand(BoatService.stopIntent(context), 0, 2) }
        assertEquals(MissionState.Stopped(StopReason.OPERATOR), stateSoon())
        assertTrue(desk.boat.board.actuation.isAtRest)
        assertTrue(desk.until(10.0) { it.mission?.isOver == true })
        assertFalse(shadowOf(desk.service).isStoppedBySelf, "the link stays, for the board to be told again")
        desk.pass(2.0)
        desk.ask { onStartCommand(BoatService.stopIntent(context), 0, 3) }
        desk.pass(0.5)
        assertTrue(shadowOf(desk.service).isStoppedBySelf)
        assertTrue(pond.logs().single().name.endsWith(LogFolder.LOG))
    }

    @Test
    @Config(sdk = [26, 29, 34, 35])
    fun aFullDiskSendsItHomeAndLosesNothingThatWasWritten() {
        desk.end()
        val disk = SmallDisk()
        BoatService.logs = LogOpener { file -> disk.over(FileOutput(file)) }
        desk.start()
        pond.load()
        pond.survey()
        desk.pass(30.0)
        disk.isFull = true
        val before = pond.logs().single().readText()
        assertTrue(desk.until(3.0) { it.mission?.state == MissionState.Returning(Danger.LOG_LOST) }, "${desk.state}")
        desk.pass(0.5)
        assertEquals("No space left on device", desk.report.log?.problem?.words)
        assertEquals("Boat 3: connected. LOG NOT WRITTEN: No space left on device", notification().contentText)
        assertTrue(desk.until(120.0) { it.mission?.state == MissionState.Stopped(StopReason.LOG_LOST) })
        desk.pass(6.0)
        assertEquals(before, pond.logs().single().readText(), "what was written is as it was")
        assertTrue(assertNotNull(desk.report.log).let { !it.isClosed && it.written < it.lines })
        // Somebody makes room: all of it is written after all.
        disk.isFull = false
        desk.pass(2.0)
        val log = assertNotNull(desk.report.log)
        assertTrue(log.isClosed && log.lost == 0L && log.written == log.lines, "$log")
        assertEquals(desk.report.counts.taken, pond.read(pond.logs().single()).readings)
    }

    @Test
    fun aBoatThreadThatHangsHasItsMotorsRested() {
        pond.survey()
        assertTrue(desk.until(10.0) { !desk.boat.board.actuation.isAtRest })
        wire.fromPhone()
        val boat = shadowOf(desk.service.boatLooper)
        boat.pause()
        shadowOf(desk.service.watchdogLooper).idleFor(Duration.ofMillis(300))
        assertEquals("", String(wire.fromPhone()), "not at once")
        shadowOf(desk.service.watchdogLooper).idleFor(Duration.ofMillis(200))
        assertTrue(String(wire.fromPhone()).startsWith("{\"m0\":{\"v\":0},\"m1\":{\"v\":0}}"))
        boat.unPause()
    }

    @Test
    fun aBoardThatIsArmedWithoutAMissionIsDisarmed() {
        val told = desk.told.length
        desk.boat.phone.write("{\"e\":{\"cmd\":\"arm\"}}\n".toByteArray())
        assertTrue(desk.until(5.0) { DISARM in desk.told.substring(told) })
        assertTrue(desk.until(2.0) { it.board.state?.word == "connected" })
    }

    @Test
    fun aPhoneThatSleptIsNoticed() {
        pond.survey()
        assertEquals(Gaps(), desk.snapshot.gaps)
        ShadowSystemClock.simulateDeepSleep(Duration.ofSeconds(20))
        desk.step()
        desk.pass(0.5)
        assertEquals(1L, desk.snapshot.gaps.count)
        assertEquals(20.1, desk.snapshot.gaps.longestSeconds, 0.05)
        assertTrue(desk.state is MissionState.Holding || desk.state == MissionState.Surveying, "${desk.state}")
    }

    @Test
    fun fixesThatAreWideOrJumpAreCountedAndOnlyTheWideOnesKeptBack() {
        pond.survey()
        val spec = desk.report.spec.origin
        desk.fix(LatLon(spec.latitude, spec.longitude), accuracy = 80f)
        desk.pass(0.5)
        assertEquals(1L, desk.snapshot.fixes.wide)
        // Not in the step in which the boat's own next fix comes: the newest one counts.
        desk.until(2.0) { (it.fixAgeSeconds ?: 9.0) in 0.2..0.6 }
        desk.fix(LatLon(spec.latitude + 0.01, spec.longitude))
        desk.pass(0.5)
        assertEquals(1L, desk.snapshot.fixes.jumps)
        assertEquals(1L, desk.snapshot.fixes.refused, "by the mission itself")
    }

    @Test
    fun anotherLinkOnTheWaterDoesNotEndTheMission() {
        pond.survey()
        desk.ask { onStartCommand(BoatService.startIntent(context, LinkChoice.Usb), 0, 2) }
        assertTrue(desk.until(5.0) { it.mission?.state == MissionState.Surveying })
        assertEquals(1, pond.logs().size)
    }

    @Test
    fun theTraceHasWhatTheMapMadeOfEachReading() {
        pond.survey()
        desk.pass(20.0)
        val trace = desk.report.trace
        assertEquals(desk.report.counts.taken, trace.size.toLong())
        assertTrue(trace.zipWithNext().all { (a, b) -> b.seconds > a.seconds })
        assertEquals(4, trace.count { it.gradient == null }, "a slope wants five readings")
        val last = trace.last()
        val (lower, upper) = assertNotNull(last.lower) to assertNotNull(last.upper)
        assertTrue(assertNotNull(last.corrected) in lower..upper)
        assertTrue((0 until desk.report.map.grid.size).any { (desk.report.ageOf(it) ?: 99.0) < 2.0 })
    }

    @Test
    fun nothingWaitsOnTheMainThread() {
        desk.end()
        val waited = mutableListOf<String>()
        val note = { what: String -> if (Looper.myLooper() == Looper.getMainLooper()) waited += what }
        BoatService.logs =
            LogOpener { file ->
                note("open")
                val real = FileOutput(file)
                object : LogOutput {
                    override fun append(bytes: ByteArray) {
                        note("write")
                        real.append(bytes)
                    }

                    override fun close() {
                        note("close")
                        real.close()
                    }
                }
            }
        val links =
            LinkMaker { _, _ ->
                object : BoardLink by wire.link {
                    override fun read(into: ByteArray): Int = wire.link.read(into).also { note("read") }

                    override fun write(bytes: ByteArray): Boolean = wire.link.write(bytes).also { note("send") }
                }
            }
        desk.start(links = links)
        pond.load()
        pond.survey()
        desk.pass(5.0)
        desk.ask { stop() }
        desk.until(10.0) { it.mission?.isOver == true }
        desk.pass(1.0)
        assertTrue(assertNotNull(desk.report.log).isClosed)
        assertEquals(emptyList(), waited)
    }

    @Test
    fun aBoatUnderWayIsNotLeftForAVirtualOne() {
        pond.survey()
        val board = desk.snapshot.linkName
        desk.service.onStartCommand(BoatService.startIntent(context, LinkChoice.Demo), 0, 2)
        desk.pass(1.0)
        assertEquals(board, desk.snapshot.linkName)
        assertFalse(desk.snapshot.isDemo)
        assertEquals(Answer(Answer.Reason.UNDER_WAY), desk.snapshot.answer)
        assertEquals(MissionState.Surveying, desk.state)
        assertTrue(desk.until(5.0) { !desk.boat.board.actuation.isAtRest }, "it sails on")
    }

    /** As Android does it: the window goes without a word, then the service hears that the app was swiped away. */
    @Test
    @Config(sdk = [26, 29, 34, 35])
    fun aSwipeOfTheAppEndsTheWindowAndNothingElse() {
        pond.survey()
        val name = ComponentName(context, BoatService::class.java)
        shadowOf(context).setComponentNameAndServiceForBindService(name, desk.service.onBind(null))
        val window = Robolectric.buildActivity(MainActivity::class.java).setup()
        desk.pass(2.0)
        assertTrue("Surveying" in window.get().view<TextView>(R.id.state).text)
        window.pause().stop().destroy()
        desk.service.onUnbind(Intent(context, BoatService::class.java))
        desk.service.onTaskRemoved(Intent(context, MainActivity::class.java))
        val asked = generateSequence { shadowOf(context).nextStartedService }.mapNotNull { it.action }.toList()
        assertEquals(emptyList(), asked, "the window asked for nothing on its way out")
        val lines = assertNotNull(desk.report.log).lines
        val told = desk.told.length
        desk.pass(10.0)
        assertEquals(MissionState.Surveying, desk.state)
        assertTrue(assertNotNull(desk.report.log).lines >= lines + 90, "it is still written down")
        assertTrue("{\"m0\"" in desk.told.substring(told), "and steered")
        assertFalse(shadowOf(desk.service).isStoppedBySelf)
        assertTrue(assertNotNull(ShadowPowerManager.getLatestWakeLock()).isHeld)
        val flags = context.packageManager.getServiceInfo(name, 0).flags
        assertEquals(0, flags and ServiceInfo.FLAG_STOP_WITH_TASK, "nor does Android end it with the app")
    }

    @Test
    fun afterStopTheServiceIsStillOneThatAndroidStartsAgain() {
        pond.survey()
        val answer = desk.service.onStartCommand(BoatService.stopIntent(context), 0, 2)
        assertEquals(Service.START_STICKY, answer)
        desk.pass(1.0)
        assertTrue(desk.snapshot.linkName != null, "the link stays, to tell the board to rest")
    }

    private fun stateSoon(): MissionState {
        desk.pass(1.0)
        return desk.state
    }

    private fun notification(): ShadowNotification {
        val manager = context.getSystemService(NotificationManager::class.java)!!
        return shadowOf(shadowOf(manager).getNotification(BoatNotification.ID))
    }

    /** A disk that somebody fills up. */
    private class SmallDisk {
        @Volatile var isFull = false

        fun over(real: LogOutput) =
            object : LogOutput {
                override fun append(bytes: ByteArray) {
                    if (isFull) throw IOException("No space left on device")
                    real.append(bytes)
                }

                override fun close() = real.close()
            }
    }

    private companion object {
        const val DISARM = "{\"e\":{\"cmd\":\"disarm\"}}"
    }
}
