package stillwater.app.screen

import android.content.Intent
import android.provider.Settings
import android.view.View
import android.widget.Button
import android.widget.TextView
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.RobolectricTestRunner
import org.robolectric.Shadows.shadowOf
import stillwater.app.R
import stillwater.app.service.Answer
import stillwater.app.service.BoatSnapshot
import stillwater.app.service.PreflightCheck
import stillwater.app.service.PreflightItem
import stillwater.app.service.PreflightNote
import stillwater.app.service.PreflightReason
import stillwater.control.Danger
import stillwater.mission.MissionState
import stillwater.mission.StopReason
import stillwater.mission.Wish
import kotlin.test.assertEquals
import kotlin.test.assertTrue

@RunWith(RobolectricTestRunner::class)
class StartScreenTest {
    private val window = Window().also { it.activity.go(ScreenName.START) }
    private val activity = window.activity

    @Test
    fun whatMayBePressedFollowsFromTheState() {
        val red = Scenes.loaded.preflight.mapIndexed { index, item -> item.copy(ready = index > 0) }
        val cases =
            listOf(
                BoatSnapshot() to "",
                Scenes.loaded to "arm start",
                Scenes.loaded.copy(preflight = red) to "",
                Scenes.loaded.copy(preflight = emptyList()) to "",
                under(MissionState.Preflight(null), Wish.WAIT) to "start hold home",
                under(MissionState.Arming, Wish.GO_ON) to "hold home",
                under(MissionState.Surveying, Wish.GO_ON) to "hold home",
                under(MissionState.Holding(Danger.OPERATOR_HOLD), Wish.HOLD) to "start home",
                under(MissionState.Holding(Danger.LINK_LOST), Wish.GO_ON) to "hold home",
                under(MissionState.Returning(Danger.OPERATOR_RETURN), Wish.RETURN) to "start hold",
                under(MissionState.Stopped(StopReason.OPERATOR), Wish.GO_ON, isOver = true) to "",
            )
        for ((snapshot, expected) in cases) {
            activity.show(snapshot)
            val may = buttons.filterKeys { activity.view<Button>(it).run { isShown && isEnabled } }.values
            assertEquals(expected, may.joinToString(" "), "${snapshot.mission?.state}")
            assertTrue(activity.view<View>(R.id.stop).run { isShown && isEnabled })
        }
    }

    @Test
    fun aBoatThatRestsUntilItTriesAgainSaysWhen() {
        val report = Scenes.report(MissionState.Holding(Danger.HELD_UP), restsFor = 125.0)
        activity.show(Scenes.surveying.copy(mission = report))
        val said = "Holding: held up on every way home, motors at rest; tries again in 2 min 5 s"
        assertTrue(activity.wordsShown().any { it.startsWith(said) }, activity.wordsShown().toString())
    }

    @Test
    fun eachButtonTellsTheBoat() {
        activity.show(Scenes.loaded)
        window.boat.told.clear()
        activity.view<View>(R.id.arm).performClick()
        activity.view<View>(R.id.start).performClick()
        activity.show(Scenes.surveying)
        activity.view<View>(R.id.hold).performClick()
        activity.view<View>(R.id.go_home).performClick()
        assertEquals(listOf("arm", "start", "hold", "home"), window.boat.told)
    }

    @Test
    fun anOverMissionMakesRoomForAnother() {
        activity.show(under(MissionState.Stopped(StopReason.COMPLETED), Wish.GO_ON, isOver = true))
        activity.view<View>(R.id.another).performClick()
        assertEquals("new", window.boat.told.last())
        assertTrue(activity.view<View>(R.id.setup).isShown)
    }

    @Test
    fun aRedLineSaysWhyAndWhatMendsItIsBesideIt() {
        activity.show(Scenes.recovered)
        assertTrue("3 things are not in order" in activity.wordsShown())
        assertTrue("✗ Link to the board: not connected" in activity.wordsShown(), "${activity.wordsShown()}")
        activity.button("Let it run while the screen is off").performClick()
        val asked = shadowOf(activity).nextStartedActivity
        assertEquals(Settings.ACTION_REQUEST_IGNORE_BATTERY_OPTIMIZATIONS, asked.action)
        activity.button("Choose the link").performClick()
        assertTrue("Connect to" in activity.wordsShown())
    }

    @Test
    fun aLineSaysHowFarTheWaterIsAndWhatTheMissionDoesWithout() {
        fun show(vararg items: PreflightItem) =
            activity.show(
                Scenes.loaded.copy(
                    preflight = Scenes.loaded.preflight.map { old -> items.find { it.check == old.check } ?: old },
                ),
            )
        show(
            PreflightItem(PreflightCheck.PLACE, true, note = PreflightNote.ON_THE_WAY, metres = 40.4),
            PreflightItem(PreflightCheck.BOAT_BATTERY, true, note = PreflightNote.NOT_REPORTED),
        )
        val words = activity.wordsShown()
        assertTrue("! The mission's water: 40 m from here; armed, the boat waits until it is there" in words, "$words")
        assertTrue("! Boat battery: the board does not say, and the mission does not ask" in words, "$words")
        assertTrue("All in order; see 2 notes below" in words, "$words")
        show(
            PreflightItem(PreflightCheck.PLACE, false, PreflightReason.OTHER_WATER, metres = 11_119.0),
            PreflightItem(PreflightCheck.BOAT_BATTERY, false, PreflightReason.NOT_REPORTED),
        )
        val red = activity.wordsShown()
        assertTrue("✗ The mission's water: 11.1 km from here; is it the right mission?" in red, "$red")
        val battery = "the board does not say; where it never does, set \"Low is below\" to 0 V in the mission"
        assertTrue("✗ Boat battery: $battery" in red, "$red")
        activity.shown().filterIsInstance<Button>().first { it.text.toString() == "Open the mission" }.performClick()
        assertTrue(activity.view<View>(R.id.setup).isShown)
    }

    /** Nothing is green that nobody looks after. */
    @Test
    fun aBatteryThatNobodyWatchesIsNotGreen() {
        val unwatched = PreflightItem(PreflightCheck.BOAT_BATTERY, true, note = PreflightNote.NOT_WATCHED)
        val others = Scenes.loaded.preflight.filter { it.check != PreflightCheck.BOAT_BATTERY }
        activity.show(Scenes.loaded.copy(preflight = others + unwatched))
        val words = activity.wordsShown()
        assertTrue("All in order; see 1 note below" in words, "$words")
        val green = activity.getColor(R.color.good)
        val lines = activity.shown().filterIsInstance<TextView>().filter { it.currentTextColor == green }
        assertEquals(others.size, lines.size, "${lines.map { it.text }}")
        assertTrue(lines.none { "oat battery" in it.text || "in order" in it.text })
        val unsaid = PreflightItem(PreflightCheck.BOAT_BATTERY, false, PreflightReason.NOT_SAID)
        activity.show(Scenes.loaded.copy(preflight = others + unsaid))
        val red = activity.wordsShown()
        assertTrue("✗ Boat battery: the mission does not say below which voltage it is low" in red, "$red")
        activity.button("Open the mission").performClick()
        assertTrue(activity.view<View>(R.id.setup).isShown)
    }

    @Test
    fun otherMissionsThatWereCutOffAreToldAndCanBeGoneOnWith() {
        activity.show(Scenes.recovered.copy(past = Scenes.past))
        val words = activity.wordsShown()
        assertTrue("1 other mission was cut off: go on with it, or mark it as finished" in words, "$words")
        activity.view<View>(R.id.open_cut_off).performClick()
        window.boat.snapshot = Scenes.recovered.copy(past = Scenes.past)
        activity.show(window.boat.snapshot)
        activity.shown().filterIsInstance<Button>().first { "CUT" in it.text }.performClick()
        activity.view<View>(R.id.go_on_with).performClick()
        assertEquals("go on with 2026-07-13T15-02-05-Mill-bay.log.incomplete", window.boat.told.last { "look" != it })
        assertTrue(activity.view<View>(R.id.arm).isShown, "its state and an answer are there")
        // Under way there is something else to look at.
        activity.show(Scenes.surveying.copy(past = Scenes.past))
        assertTrue(activity.wordsShown().none { "cut off" in it })
    }

    @Test
    fun aMissionOfAnotherKindOfBoatIsRefusedInWords() {
        for ((reason, word) in mapOf(
            Answer.Reason.OF_A_REAL_BOAT to "a real boat",
            Answer.Reason.OF_THE_VIRTUAL_BOAT to "the demo's virtual boat",
        )) {
            activity.show(Scenes.loaded.copy(answer = Answer(reason)))
            assertTrue(activity.wordsShown().any { it.startsWith("This mission was begun by $word:") })
        }
    }

    @Test
    fun aSettingThatThePhoneDoesNotHaveIsSaidSo() {
        shadowOf(activity.application).checkActivities(true)
        activity.leave(Intent("no.such.screen"))
        assertTrue("This phone has no such screen" in activity.wordsShown())
    }

    @Test
    fun aCommandThatWasNotFollowedIsAnswered() {
        activity.show(Scenes.loaded.copy(answer = Answer(Answer.Reason.NOT_A_MISSION, "ENOSPC")))
        assertTrue("This is no mission: ENOSPC" in activity.wordsShown())
        activity.show(Scenes.loaded)
        assertTrue(activity.wordsShown().none { "ENOSPC" in it })
    }

    private fun under(state: MissionState, wish: Wish, isOver: Boolean = false) =
        Scenes.standingBy.copy(mission = Scenes.report(state, wish, isOver = isOver))

    private companion object {
        val buttons = mapOf(R.id.arm to "arm", R.id.start to "start", R.id.hold to "hold", R.id.go_home to "home")
    }
}
