package stillwater.app.service

import android.app.Application
import android.app.NotificationManager
import android.content.ComponentName
import android.content.Intent
import android.os.BatteryManager
import android.os.PowerManager
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
import stillwater.app.screen.MainActivity
import stillwater.app.screen.stateWords
import stillwater.control.Danger
import stillwater.mission.MissionState
import stillwater.mission.StopReason
import java.time.Duration
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertNotNull
import kotlin.test.assertNull
import kotlin.test.assertTrue

/** What happens to phone, probe and person while a mission is under way. */
@RunWith(RobolectricTestRunner::class)
@Config(sdk = [35])
class UnderWayTest {
    private val context: Application = RuntimeEnvironment.getApplication()

    @get:Rule
    internal val pond = Pond()
    private val desk get() = pond.desk

    @Test
    fun aPhoneThatRunsLowComesHomeAndSaysSo() {
        pond.survey()
        charge(14)
        assertTrue(desk.until(12.0) { it.mission?.state == MissionState.Returning(Danger.PHONE_LOW) }, "${desk.state}")
        val words = "Going home: phone battery low"
        assertEquals(words, context.stateWords(desk.snapshot).lines().first())
        assertEquals(words, title())
        assertTrue(desk.until(120.0) { it.mission?.isOver == true }, "${desk.state}")
        assertEquals(MissionState.Stopped(StopReason.PHONE), desk.state)
        desk.pass(1.0)
        val log = pond.logs().single().readText()
        assertTrue("\"phone\":[80.0]" in log && "\"phone\":[14.0]" in log, "for a replay")
    }

    @Test
    fun aBoatWhoseBatteryIsLowComesHome() {
        pond.survey()
        desk.boat.board.volts = 13.0
        val low = MissionState.Returning(Danger.BATTERY_LOW)
        assertTrue(desk.until(20.0) { it.mission?.state == low }, "${desk.state}")
    }

    @Test
    fun aProbeThatIsNotHeardIsToldOnTheScreenAndInTheNotification() {
        // The board's only probe is on port 1.
        desk.ask { load(ServiceDesk.POND.replace("\"port\":1", "\"port\":2")) }
        desk.pass(1.0)
        pond.survey()
        assertNull(desk.report.probeSilence)
        assertTrue(desk.until(40.0) { it.mission?.probeSilence != null })
        desk.pass(0.5)
        val said = "Boat 3: PROBE SILENT for 30 s"
        assertEquals(said, context.stateWords(desk.snapshot).lines().last())
        assertEquals(said, text())
        assertEquals(MissionState.Surveying, desk.state, "what to do about it a person knows")
    }

    /** Dark, then idle: only what Android leaves to a service in the foreground with a wake lock goes on. */
    @Test
    @Config(sdk = [26, 29, 34, 35])
    fun withTheScreenOffAndInDozeItSurveysOn() {
        pond.survey()
        val name = ComponentName(context, BoatService::class.java)
        shadowOf(context).setComponentNameAndServiceForBindService(name, desk.service.onBind(null))
        val window = Robolectric.buildActivity(MainActivity::class.java).setup()
        val power = shadowOf(assertNotNull(context.getSystemService(PowerManager::class.java)))
        window.pause().stop()
        desk.service.onUnbind(Intent(context, BoatService::class.java))
        power.turnScreenOn(false)
        power.setIsDeviceIdleMode(true)
        context.sendBroadcast(Intent(PowerManager.ACTION_DEVICE_IDLE_MODE_CHANGED))
        val before = assertNotNull(desk.report.log).lines
        val taken = desk.report.counts.taken
        repeat(3) {
            desk.pass(10.0)
            assertTrue(assertNotNull(ShadowPowerManager.getLatestWakeLock()).isHeld)
        }
        assertEquals(MissionState.Surveying, desk.state)
        assertTrue(assertNotNull(desk.report.log).lines - before >= 295, "ten steps a second are written down")
        assertTrue(desk.report.counts.taken - taken >= 28)
        assertEquals(Gaps(), desk.snapshot.gaps)
        // The window comes back and shows where the boat is now.
        power.turnScreenOn(true)
        power.setIsDeviceIdleMode(false)
        window.start().resume()
        desk.pass(1.0)
        assertEquals(MissionState.Surveying, desk.state)
        window.pause().stop().destroy()
    }

    /** A maker's phone that sleeps all the same: the board's watchdog rests the motors, and it goes on by itself. */
    @Test
    fun aPhoneThatSleepsDespiteItsWakeLockGoesOnWhenItWakes() {
        pond.survey()
        assertTrue(desk.until(10.0) { !desk.boat.board.actuation.isAtRest })
        ShadowSystemClock.simulateDeepSleep(Duration.ofSeconds(4))
        repeat(40) { desk.boat.advance(0.1) }
        assertTrue(desk.boat.board.actuation.isAtRest, "nobody has spoken to it")
        val isOn = desk.until(30.0) { it.gaps.count == 1L && it.mission?.state == MissionState.Surveying }
        assertTrue(isOn, "${desk.state}")
    }

    @Test
    fun whatIsPressedAfterStopMovesNothing() {
        pond.survey()
        desk.service.stop()
        desk.service.arm()
        desk.step()
        assertEquals(MissionState.Stopped(StopReason.OPERATOR), soon())
        assertEquals(Answer(Answer.Reason.OVER), desk.snapshot.answer)
        val told = desk.told.length
        for (press in listOf(BoatService::start, BoatService::hold, BoatService::goHome)) desk.ask { press(this) }
        desk.pass(5.0)
        assertFalse("\"arm\"" in desk.told.substring(told))
        assertTrue(desk.boat.board.actuation.isAtRest)
    }

    /** The second tap comes when the board has said already that it is disarmed. */
    @Test
    fun stopPressedTwiceEndsTheMissionAndKeepsTheLink() {
        pond.survey()
        press()
        assertTrue(desk.until(1.8) { it.mission?.isOver == true }, "it is asked once a second")
        press()
        desk.pass(2.0)
        assertFalse(shadowOf(desk.service).isStoppedBySelf)
        assertEquals("Boat 3", desk.snapshot.linkName)
        // Later it is meant.
        press()
        desk.pass(1.0)
        assertTrue(shadowOf(desk.service).isStoppedBySelf)
    }

    @Test
    fun armPressedRightAfterStopIsRefusedAndTheLinkIsGivenUp() {
        press()
        desk.service.arm()
        desk.step()
        desk.pass(1.0)
        assertEquals(Answer(Answer.Reason.GIVEN_UP), desk.snapshot.answer)
        assertEquals(MissionState.Idle, desk.state, "loaded, for the next connection")
        assertFalse("\"arm\"" in desk.told)
        assertTrue(pond.logs().isEmpty(), "no mission was begun and ended")
    }

    @Test
    fun whatIsPressedTwiceIsDoneOnce() {
        for (press in listOf(BoatService::arm, BoatService::start)) {
            repeat(2) { press(desk.service) }
            desk.pass(1.0)
        }
        assertTrue(desk.until(25.0) { it.mission?.state == MissionState.Surveying }, "${desk.state}")
        assertEquals(1, pond.logs().size)
        assertEquals(1, Regex("\"cmd\":\"arm\"").findAll(desk.told).count())
        repeat(2) { desk.service.hold() }
        desk.pass(1.0)
        assertEquals(MissionState.Holding(Danger.OPERATOR_HOLD), desk.state)
        assertNull(desk.snapshot.answer)
    }

    private fun press() = desk.ask { onStartCommand(BoatService.stopIntent(context), 0, 2) }

    private fun soon(): MissionState {
        desk.pass(1.0)
        return desk.state
    }

    private fun charge(percent: Int) =
        shadowOf(assertNotNull(context.getSystemService(BatteryManager::class.java)))
            .setIntProperty(BatteryManager.BATTERY_PROPERTY_CAPACITY, percent)

    private fun shown(): ShadowNotification {
        val manager = shadowOf(assertNotNull(context.getSystemService(NotificationManager::class.java)))
        return shadowOf(manager.getNotification(BoatNotification.ID))
    }

    private fun title() = shown().contentTitle

    private fun text() = shown().contentText
}
