package stillwater.app.service

import android.app.Application
import android.app.NotificationManager
import android.os.Build
import org.junit.After
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.RobolectricTestRunner
import org.robolectric.RuntimeEnvironment
import org.robolectric.Shadows.shadowOf
import org.robolectric.annotation.Config
import stillwater.control.Danger
import stillwater.mission.MissionRecovery
import stillwater.mission.MissionState
import stillwater.mission.StopReason
import stillwater.model.Actuation
import java.io.File
import kotlin.math.hypot
import kotlin.test.assertEquals
import kotlin.test.assertTrue

/** A mission as a person runs it, over Bluetooth's sockets, from the checklist to the closed log. */
@RunWith(RobolectricTestRunner::class)
@Config(sdk = [26, 29, 34, 35])
class WholeMissionTest {
    private val context: Application = RuntimeEnvironment.getApplication()
    private val desk = ServiceDesk(SocketWire(context, ServiceDesk.BOARD.address))

    @After
    fun end() = desk.end()

    @Test
    fun fromTheChecklistToTheClosedLog() {
        desk.start()
        desk.ask { load(ServiceDesk.POND) }
        desk.ask { arm() }
        assertEquals(Answer(Answer.Reason.NOT_READY), desk.snapshot.answer)
        assertTrue(desk.until(10.0) { shot -> shot.preflight.all { it.ready } }, "${desk.snapshot.preflight}")

        val armed = desk.said.length
        desk.ask { arm() }
        // A place is believed after 15 s of fixes that agree.
        assertTrue(desk.until(30.0) { it.mission?.state == MissionState.Holding(Danger.OPERATOR_WAIT) })
        desk.pass(3.0)
        assertEquals(Actuation.Differential(0.0, 0.0), desk.boat.board.actuation, "armed, and waits")

        desk.ask { start() }
        assertTrue(desk.until(5.0) { it.mission?.state == MissionState.Surveying })
        assertTrue(desk.until(5.0) { !desk.boat.board.actuation.isAtRest }, "it goes")
        val ended = MissionState.Stopped(StopReason.COMPLETED)
        assertTrue(desk.until(400.0) { it.mission?.state == ended }, "${desk.state}")
        var before = desk.said.length
        assertTrue(
            desk.until(10.0) { state ->
                val isOver = state.mission?.isOver == true
                if (!isOver) before = desk.said.length
                isOver
            },
        )
        val over = desk.said.length
        desk.pass(1.0)

        val (dx, dy) = desk.boat.dynamics.x - 5.0 to desk.boat.dynamics.y - 5.0
        assertTrue(hypot(dx, dy) < 8.0, "home, but ($dx, $dy) m off")
        desk.pass(2.0)
        assertEquals("connected", desk.snapshot.board.state?.word, "disarmed")
        everyReadingIsAccountedFor(desk.said.substring(armed, before), desk.said.substring(before, over))
        theLogIsTheMission()
    }

    /** The board's own count of what it [said], and said [atLast] as the mission ended, against the app's and the log's. */
    private fun everyReadingIsAccountedFor(said: String, atLast: String) {
        val counts = desk.report.counts
        val sum = counts.run { taken + waiting + outOfRange + unconfirmed + stuck + withoutPlace }
        assertEquals(counts.received, sum)
        val log = BoatService.logOf(context, desk.report.log!!.name).readText()
        assertEquals(Regex("\"reading\":\\{").findAll(log).count().toLong(), counts.received)
        val sent = Regex("atlas_do").findAll(said).count()
        assertTrue(counts.received in sent..sent + Regex("atlas_do").findAll(atLast).count(), "$counts of $sent")
        assertTrue(counts.taken >= 150, "$counts")
        assertEquals(0L, counts.unreadable)
        assertEquals(0L, desk.snapshot.link.bytesOverrun)
    }

    private fun theLogIsTheMission() {
        val told = desk.report.log!!
        assertTrue(told.isClosed && told.name.endsWith("-pond.log"), "$told")
        assertEquals(told.lines, told.written)
        assertEquals(0L, told.lost)
        val file = BoatService.logOf(context, told.name)
        assertEquals(told.lines, file.readLines().size.toLong())
        val read = MissionRecovery().apply { file.forEachLine { line(it) } }.recovered()!!
        assertEquals(0L, read.unreadable)
        val (ours, logged) = desk.report.map to read.estimator.map
        for (cell in 0 until ours.grid.size) {
            assertEquals(ours.value(cell), logged.value(cell), 0.0)
            assertEquals(ours.lower(cell), logged.lower(cell), 0.0)
            assertEquals(ours.readings(cell), logged.readings(cell))
        }
        assertTrue((0 until ours.grid.size).count { ours.readings(it) > 0 } >= 8, "most of the pond was seen")
        assertEquals(listOf(told.name), desk.snapshot.past?.map { it.name })
        // For the simulator's own reader, which is no part of the app: PhoneLogTest in `tests`.
        file.copyTo(File("target/mission-logs/android-${Build.VERSION.SDK_INT}.log"), overwrite = true)
    }

    @Test
    fun bluetoothThatGoesAndComesBackInterruptsItOnly() {
        desk.start()
        desk.ask { load(ServiceDesk.POND) }
        assertTrue(desk.until(10.0) { shot -> shot.preflight.all { it.ready } }, "${desk.snapshot.preflight}")
        desk.ask { start() }
        assertTrue(desk.until(20.0) { it.mission?.state == MissionState.Surveying }, "${desk.state}")
        desk.wire.cut()
        assertTrue(desk.until(2.0) { it.mission?.state == MissionState.Holding(Danger.LINK_LOST) }, "${desk.state}")
        desk.pass(1.0)
        assertTrue(desk.boat.board.actuation.isAtRest, "the board's own watchdog")
        val manager = context.getSystemService(NotificationManager::class.java)!!
        val text = shadowOf(shadowOf(manager).getNotification(BoatNotification.ID)).contentText
        assertEquals("Boat 3: LINK LOST, trying again", text)
        desk.wire.mend()
        assertTrue(desk.until(5.0) { it.mission?.state == MissionState.Surveying }, "${desk.state}")
        assertEquals(1L, desk.snapshot.link.drops)
    }
}
