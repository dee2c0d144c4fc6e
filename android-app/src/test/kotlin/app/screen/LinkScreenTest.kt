package stillwater.app.screen

import android.Manifest.permission.BLUETOOTH_CONNECT
import android.bluetooth.BluetoothManager
import android.view.View
import android.widget.TextView
import org.junit.After
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.RobolectricTestRunner
import org.robolectric.Shadows.shadowOf
import stillwater.app.R
import stillwater.app.link.LinkChoice
import stillwater.app.link.SerialDrivers
import stillwater.app.mission.LogProblem
import stillwater.app.service.BoatService
import stillwater.app.service.BoatSnapshot
import stillwater.app.service.Gaps
import kotlin.test.assertEquals
import kotlin.test.assertTrue

@RunWith(RobolectricTestRunner::class)
class LinkScreenTest {
    private val window = Window()
    private val activity = window.activity.apply { go(ScreenName.LINK) }

    @After
    fun withTheLibrary() {
        SerialDrivers.areBuiltIn = true
    }

    /** The one that Maven makes. */
    @Test
    fun aBuildWithoutUsbSaysSoWhereTheLinkIsChosen() {
        activity.show(BoatSnapshot())
        activity.button("Connect to USB serial")
        SerialDrivers.areBuiltIn = false
        activity.go(ScreenName.LINK)
        val words = activity.wordsShown()
        assertTrue("Connect to USB serial" !in words)
        assertTrue(words.any { it.startsWith("USB: not in this build of the app. Connect by Bluetooth") }, "$words")
    }

    /** "No paired device" would send a person to the wrong settings. */
    @Test
    fun whatStandsInBluetoothsWayIsSaidAndGoesWhenItIsMended() {
        val adapter = checkNotNull(activity.getSystemService(BluetoothManager::class.java)).adapter
        val shadow = shadowOf(activity.application)
        shadow.denyPermissions(BLUETOOTH_CONNECT)
        shadowOf(adapter).setEnabled(false)
        activity.show(BoatSnapshot())
        assertTrue("✗ Bluetooth is not permitted yet" in activity.wordsShown(), "${activity.wordsShown()}")
        activity.button(activity.getString(R.string.allow)).performClick()
        val asked = shadowOf(activity).lastRequestedPermission.requestedPermissions.toList()
        assertTrue(BLUETOOTH_CONNECT in asked, "$asked")
        shadow.grantPermissions(BLUETOOTH_CONNECT)
        activity.show(BoatSnapshot())
        assertTrue("✗ Bluetooth is off: switch it on in the phone's settings" in activity.wordsShown())
        shadowOf(adapter).setEnabled(true)
        activity.show(BoatSnapshot())
        assertTrue(activity.wordsShown().none { it.startsWith("✗") }, "${activity.wordsShown()}")
        assertTrue(activity.getString(R.string.no_paired) in activity.wordsShown())
    }

    @Test
    fun whatWasDroppedLostAndRefusedIsCountedOnTheScreen() {
        activity.show(Scenes.surveying.copy(gaps = Gaps(2, 31.0)))
        val words = activity.wordsShown()
        for (line in listOf(
            "Connections: 2; lost: 1; failed: 3",
            "0 bytes and 4 commands dropped",
            "Last error: read failed, socket might closed",
            "5210 lines, 3 not understood, 0 commands refused",
            "812 positions; 2 jumps, 1 too uncertain, 0 refused",
            "The phone slept 2 times, 31.0 s at most",
            "1412 received, 1400 taken, 0 waiting",
            "Of those taken, 41 too near to a border to count for a cell",
            "Refused: 2 out of range, 3 unconfirmed jumps, 7 without a place, 0 of a stuck probe",
            "9113 lines, 9110 on the disk, 0 lost",
        )) {
            assertTrue(line in words, "$line: $words")
        }
        val bad = activity.shown().filterIsInstance<TextView>().filter { "slept" in it.text }
        assertEquals(activity.getColor(R.color.bad), bad.single().currentTextColor)
    }

    @Test
    fun aConnectionThatWasGivenUpAndALogThatIsNotWrittenAreSaid() {
        val log = Scenes.report.log?.copy(problem = LogProblem(LogProblem.Reason.LITTLE_ROOM))
        val shot = Scenes.surveying
        activity.show(
            shot.copy(link = shot.link.copy(writesHung = 2), mission = Scenes.report.withLog(checkNotNull(log))),
        )
        for (line in listOf(
            "Given up because a command did not go out: 2 times",
            "Cannot be written: less than 10 MB are left",
        )) {
            val shown = activity.shown().filterIsInstance<TextView>().single { it.text.toString() == line }
            assertEquals(activity.getColor(R.color.bad), shown.currentTextColor)
        }
    }

    @Test
    fun anotherLinkIsOnePressAwayAndInSightWhereThereIsNone() {
        activity.show(BoatSnapshot())
        val demo = "Connect to Demo: virtual boat"
        activity.button(demo)
        activity.show(Scenes.surveying)
        assertTrue(demo !in activity.wordsShown(), "counters come first on the water")
        activity.button("Another link ▾").performClick()
        activity.show(Scenes.surveying)
        activity.button(demo).performClick()
        val sent = generateSequence { shadowOf(activity.application).nextStartedService }.last()
        assertEquals(LinkChoice.Demo, LinkChoice.of(sent))
        assertEquals(BoatService::class.java.name, sent.component?.className)
        assertTrue(activity.view<View>(R.id.stop).isShown)
    }
}
