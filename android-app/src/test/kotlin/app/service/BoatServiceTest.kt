package stillwater.app.service

import android.app.Application
import android.app.Notification
import android.app.NotificationManager
import android.content.Context
import android.content.Intent
import android.content.pm.ServiceInfo
import android.os.Looper
import org.junit.After
import org.junit.Before
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.Robolectric
import org.robolectric.RobolectricTestRunner
import org.robolectric.RuntimeEnvironment
import org.robolectric.Shadows.shadowOf
import org.robolectric.android.controller.ServiceController
import org.robolectric.annotation.Config
import org.robolectric.shadows.ShadowPowerManager
import stillwater.app.link.BoardLink
import stillwater.app.link.LinkChoice
import stillwater.app.link.LinkHealth
import stillwater.app.link.LinkMaker
import stillwater.app.link.LinkState
import stillwater.wire.BoardState
import java.time.Duration
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertNotNull
import kotlin.test.assertNull
import kotlin.test.assertTrue

@RunWith(RobolectricTestRunner::class)
@Config(sdk = [26, 29, 34, 35])
class BoatServiceTest {
    private val context: Application = RuntimeEnvironment.getApplication()
    private val made = mutableListOf<FakeLink>()

    /** Whether boards are heard. */
    private var answers = true
    private val services = mutableListOf<ServiceController<BoatService>>()

    @Before
    fun fakeLinks() {
        BoatService.links = LinkMaker { _, choice -> FakeLink(choice, answers).also { made += it } }
    }

    @After
    fun endServices() {
        services.forEach { it.destroy() }
        BoatService.links = LinkMaker.REAL
    }

    @Test
    fun startedItHoldsTheLinkInTheForegroundWithTheProcessorAwake() {
        val service = started(BoatService.startIntent(context, board))
        assertEquals(listOf<LinkChoice>(board), made.map { it.choice })
        assertTrue(made.single().open)
        val shown = assertNotNull(shadowOf(service).lastForegroundNotification)
        assertEquals("Standing by, disarmed", shadowOf(shown).contentTitle)
        assertEquals(Notification.VISIBILITY_PUBLIC, shown.visibility, "STOP is there on a locked phone")
        assertTrue(assertNotNull(ShadowPowerManager.getLatestWakeLock()).isHeld)
        assertEquals(BoatActivity.STANDING_BY, service.snapshot.activity)
        assertEquals("Boat 3", service.snapshot.linkName)
    }

    @Test
    @Config(sdk = [29, 34, 35])
    fun itRunsAsWhatItIs() {
        val service = started(BoatService.startIntent(context, board))
        val both = ServiceInfo.FOREGROUND_SERVICE_TYPE_CONNECTED_DEVICE or ServiceInfo.FOREGROUND_SERVICE_TYPE_LOCATION
        assertEquals(both, service.foregroundServiceType)
    }

    @Test
    fun theNotificationStopsIt() {
        val service = started(BoatService.startIntent(context, board))
        val notification = assertNotNull(shadowOf(service).lastForegroundNotification)
        val stop = notification.actions.single { it.title == context.getString(stillwater.app.R.string.stop) }
        val sent = shadowOf(stop.actionIntent).savedIntent
        service.onStartCommand(sent, 0, 2)
        settle()
        assertEquals(standStill + standStill, made.single().sent, "when it connected and when it ended")
        assertFalse(made.single().open)
        assertFalse(assertNotNull(ShadowPowerManager.getLatestWakeLock()).isHeld)
        assertTrue(shadowOf(service).isStoppedBySelf)
        assertEquals(BoatActivity.IDLE, service.snapshot.activity)
    }

    @Test
    fun theNotificationFollowsTheLink() {
        val service = started(BoatService.startIntent(context, board))
        made.single().state = LinkState.WAITING
        settle()
        val manager = context.getSystemService(NotificationManager::class.java)!!
        val text = shadowOf(shadowOf(manager).getNotification(BoatNotification.ID)).contentText
        assertEquals("Boat 3: LINK LOST, trying again", text)
        assertEquals(LinkState.WAITING, service.snapshot.link.state)
    }

    @Test
    fun whatTheBoardSaysIsShownUntilItIsGone() {
        val service = started(BoatService.startIntent(context, board))
        val link = made.single()
        val said = "{\"s4\":{\"type\":\"battery\",\"data\":\"15.263 0.0 0.0\"}}\r\n{\"m0\":\r\n" +
            "{\"s1\":{\"type\":\"atlas_do\",\"data\":\"10.15\"}}\r\n{\"s1\":{\"ty"
        // Cut where no line ends: the pieces are the radio's.
        said.chunked(7).forEach { link.arriving += it.toByteArray() }
        settle()
        val heard = service.snapshot.board
        assertEquals(15.263, heard.batteryVolts)
        assertEquals(10.15, heard.oxygen)
        assertEquals(1L, heard.malformed)
        link.state = LinkState.WAITING
        settle()
        assertNull(service.snapshot.board.batteryVolts)
        // The half line before the loss is not joined with what comes after it.
        link.state = LinkState.CONNECTED
        link.arriving += "{\"e\":{\"type\":\"state\",\"data\":\"standby\"}}\r\n".toByteArray()
        settle()
        assertEquals(BoardState.STANDBY, service.snapshot.board.state)
        assertEquals(1L, service.snapshot.board.malformed)
    }

    @Test
    fun everyConnectionBeginsWithTheMotorsOffAndDisarmed() {
        started(BoatService.startIntent(context, board))
        val link = made.single()
        settle()
        assertEquals(standStill, link.sent, "once a connection, not once a look")
        link.connects++
        settle()
        assertEquals(standStill + standStill, link.sent)
    }

    @Test
    fun aLinkThatIsIdleIsAskedEverySecond() {
        started(BoatService.startIntent(context, board))
        val link = made.single()
        val before = link.asked
        repeat(10) { settle() }
        assertEquals(before + 5, link.asked, "in five seconds")
    }

    /** A question keeps the watchdog quiet of a board that runs and is not heard. */
    @Test
    fun aBoardThatIsNotHeardIsToldToRestWithEachQuestion() {
        answers = false
        started(BoatService.startIntent(context, board))
        val link = made.single()
        // The first question leaves time for its answer.
        repeat(2) { settle() }
        val asked = link.asked
        val before = link.sent.count { "disarm" in it }
        repeat(6) { settle() }
        assertEquals(link.asked - asked, link.sent.count { "disarm" in it } - before)
    }

    @Test
    fun aStartRightAfterAStopIsNotUndone() {
        val service = started(BoatService.startIntent(context, board))
        service.onStartCommand(BoatService.stopIntent(context), 0, 2)
        service.onStartCommand(BoatService.startIntent(context, board), 0, 3)
        settle()
        assertTrue(made.last().open)
        assertFalse(shadowOf(service).isStoppedBySelf)
        assertTrue(assertNotNull(ShadowPowerManager.getLatestWakeLock()).isHeld)
    }

    @Test
    fun afterTheProcessDiedItTakesTheLinkUpAgainAndSaysSo() {
        started(BoatService.startIntent(context, board))
        services.removeAt(0).destroy()
        made.clear()
        val again = started(null)
        assertEquals(listOf<LinkChoice>(board), made.map { it.choice })
        assertEquals(BoatActivity.RECOVERED, again.snapshot.activity)
        val shown = assertNotNull(shadowOf(again).lastForegroundNotification)
        assertEquals("Restarted after an interruption, disarmed", shadowOf(shown).contentTitle)
    }

    @Test
    fun startedAgainWithNothingToTakeUpItEnds() {
        val service = started(null)
        assertTrue(made.isEmpty())
        assertTrue(shadowOf(service).isStoppedBySelf)
    }

    @Test
    fun whatWasStoppedIsNotTakenUpAgain() {
        val service = started(BoatService.startIntent(context, board))
        service.onStartCommand(BoatService.stopIntent(context), 0, 2)
        settle()
        made.clear()
        started(null)
        assertTrue(made.isEmpty())
    }

    @Test
    fun anotherLinkReplacesTheFirstOnTheWater() {
        val service = started(BoatService.startIntent(context, board))
        service.onStartCommand(BoatService.startIntent(context, LinkChoice.Usb), 0, 2)
        settle()
        assertEquals(listOf(board, LinkChoice.Usb), made.map { it.choice })
        assertEquals(listOf(false, true), made.map { it.open })
    }

    @Test
    fun aChoiceSurvivesItsKeeping() {
        val kept = context.getSharedPreferences("test", Context.MODE_PRIVATE)
        assertNull(LinkChoice.kept(kept))
        for (choice in listOf(board, LinkChoice.Usb)) {
            LinkChoice.keep(kept, choice)
            assertEquals(choice, LinkChoice.kept(kept))
            assertEquals(choice, LinkChoice.of(LinkChoice.put(Intent(), choice)))
        }
        LinkChoice.keep(kept, null)
        assertNull(LinkChoice.kept(kept))
    }

    @Test
    fun aRefusalOfTheForegroundIsShownAndNoCrash() {
        val refusals =
            listOf(SecurityException("location type not permitted"), IllegalStateException("not allowed now"))
        for (refusal in refusals) {
            val service = Robolectric.buildService(RefusedService::class.java).also {
                it.get().refusal = refusal
            }.create()
            service.get().onStartCommand(BoatService.startIntent(context, board), 0, 1)
            settle(service.get())
            assertEquals(BoatActivity.REFUSED, service.get().snapshot.activity)
            assertEquals(refusal.message, service.get().snapshot.refusal)
            assertTrue(shadowOf(service.get()).isStoppedBySelf)
            assertTrue(made.isEmpty())
            val manager = context.getSystemService(NotificationManager::class.java)!!
            val shown = assertNotNull(shadowOf(manager).getNotification(BoatNotification.REFUSED_ID))
            assertEquals("Android did not let Stillwater run. Open the app.", shadowOf(shown).contentText)
            service.destroy()
        }
    }

    /** From Android 14 on, started again after the process died: no position while no window is in sight. */
    @Test
    fun wherePositionsAreRefusedInTheBackgroundItGoesOnForTheLinkAndAsksAgainWhenLookedAt() {
        started(BoatService.startIntent(context, board))
        services.removeAt(0).destroy()
        made.clear()
        val controller = Robolectric.buildService(UnseenService::class.java).create()
        val service = controller.get()
        service.onStartCommand(null, 0, 1)
        settle(service)
        val place = ServiceInfo.FOREGROUND_SERVICE_TYPE_LOCATION
        assertEquals(listOf(place, 0), service.asked)
        assertEquals(BoatActivity.RECOVERED, service.snapshot.activity)
        assertTrue(service.snapshot.isWithoutPlace && made.single().open)
        assertFalse(shadowOf(service).isStoppedBySelf)
        val shown = assertNotNull(shadowOf(service).lastForegroundNotification)
        val text = shadowOf(shown).contentText.toString()
        assertTrue(text.startsWith("Open the app: until then Android gives it no position"), text)
        // The window is not yet what Android takes for one in sight.
        service.onBind(null)
        assertEquals(listOf(place, 0, place), service.asked)
        service.isSeen = true
        shadowOf(Looper.getMainLooper()).idleFor(Duration.ofSeconds(1))
        settle(service)
        assertEquals(listOf(place, 0, place, place), service.asked)
        shadowOf(Looper.getMainLooper()).idleFor(Duration.ofSeconds(5))
        assertEquals(4, service.asked.size, "and no more")
        assertFalse(service.snapshot.isWithoutPlace)
        val manager = context.getSystemService(NotificationManager::class.java)!!
        val now = shadowOf(shadowOf(manager).getNotification(BoatNotification.ID)).contentText
        assertEquals("Boat 3: connected", now)
        controller.destroy()
    }

    private fun started(intent: Intent?): BoatService {
        val controller = Robolectric.buildService(BoatService::class.java).create()
        services += controller
        controller.get().onStartCommand(intent, 0, 1)
        settle()
        return controller.get()
    }

    /** Runs what waits on the boat thread, and half a second of its clock: one look at the link. */
    private fun settle(service: BoatService = services.last().get()) {
        val boat = shadowOf(service.boatLooper)
        boat.idle()
        boat.idleFor(Duration.ofMillis(500))
    }

    /** Android's answer to a service that it does not let into the foreground. */
    class RefusedService : BoatService() {
        lateinit var refusal: RuntimeException

        override fun foreground(shown: Notification, more: Int): Unit = throw refusal
    }

    /** Android's answer to one that asks for positions while nobody looks. */
    class UnseenService : BoatService() {
        val asked = mutableListOf<Int>()
        var isSeen = false

        override fun foreground(shown: Notification, more: Int) {
            asked += more
            if (more != 0 && !isSeen) throw SecurityException("not from the background")
            super.foreground(shown, more)
        }
    }

    private class FakeLink(val choice: LinkChoice, private val answers: Boolean) : BoardLink {
        @Volatile var open = false

        @Volatile var state = LinkState.CONNECTED

        @Volatile var connects = 1L
        override val name: String = (choice as? LinkChoice.Bluetooth)?.name ?: "USB"
        override val health: LinkHealth get() = LinkHealth(if (open) state else LinkState.CLOSED, connects)

        override fun open() {
            open = true
        }

        override fun close() {
            open = false
        }

        val arriving = ArrayDeque<ByteArray>()
        val sent = mutableListOf<String>()

        override fun read(into: ByteArray): Int {
            if (state != LinkState.CONNECTED) return -1
            return arriving.removeFirstOrNull()?.also { it.copyInto(into) }?.size ?: 0
        }

        /** All but the questions. */
        override fun write(bytes: ByteArray): Boolean {
            val text = String(bytes)
            if ("state" in text) {
                asked++
                if (answers) arriving += "{\"e\":{\"type\":\"state\",\"data\":\"standby\"}}\r\n".toByteArray()
            } else {
                sent += text
            }
            return true
        }

        /** Questions so far. */
        @Volatile var asked = 0
    }

    private companion object {
        val standStill =
            listOf("{\"m0\":{\"v\":0},\"m1\":{\"v\":0}}\n", "{\"e\":{\"cmd\":\"disarm\"}}\n")
        val board = LinkChoice.Bluetooth("00:11:22:33:AA:BB", "Boat 3")
    }
}
