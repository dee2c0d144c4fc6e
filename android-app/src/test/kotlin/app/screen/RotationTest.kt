package stillwater.app.screen

import android.content.pm.PackageManager
import android.view.View
import android.view.ViewGroup
import android.widget.Button
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.RobolectricTestRunner
import org.robolectric.annotation.Config
import stillwater.app.R
import stillwater.app.service.Preflight
import stillwater.app.service.PreflightCheck
import stillwater.app.service.PreflightItem
import stillwater.app.service.PreflightReason
import stillwater.mission.MissionDraft
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

/** The phone is turned while something was asked: by Android, by a list that is unfolded, before a deletion. */
@RunWith(RobolectricTestRunner::class)
@Config(sdk = [35])
class RotationTest {
    private val window = Window()
    private val activity get() = window.activity

    @Test
    fun androidsQuestionForPermissionsIsAnsweredToTheNewWindow() {
        val red = PreflightItem(PreflightCheck.PERMISSIONS, ready = false, PreflightReason.NOT_PERMITTED)
        val snapshot = Scenes.loaded.copy(preflight = listOf(red))
        activity.go(ScreenName.START)
        activity.show(snapshot)
        activity.button(activity.getString(R.string.allow)).performClick()
        window.controller.recreate()
        val asked = Preflight.neededPermissions().toTypedArray()
        activity.onRequestPermissionsResult(1, asked, IntArray(asked.size) { PackageManager.PERMISSION_DENIED })
        activity.show(snapshot)
        activity.button(activity.getString(R.string.allow_in_settings))
        // And what Android has said once it need not say again.
        window.controller.recreate()
        activity.show(snapshot)
        activity.button(activity.getString(R.string.allow_in_settings))
        assertTrue(activity.view<View>(R.id.stop).isShown)
    }

    @Test
    fun aListThatIsUnfoldedFoldsAndWhatWasChosenStays() {
        activity.desk.change { MissionDraft.of(Scenes.spec) }
        activity.go(ScreenName.MISSION)
        window.settle()
        fun planner() = activity.shown().filterIsInstance<Button>().single { it.text.startsWith("Planner: ") }
        planner().performClick()
        activity.button("lawnmower")
        val draft = activity.desk.draft
        window.controller.recreate()
        window.settle()
        assertEquals(draft, activity.desk.draft)
        assertEquals("Planner: for water of any shape ▾", planner().text.toString())
        assertTrue(activity.wordsShown().none { it == "lawnmower" })
    }

    @Test
    fun aQuestionBeforeADeletionIsForgottenAndNothingIsDeleted() {
        askToDelete()
        window.controller.recreate()
        activity.show(window.boat.snapshot)
        assertTrue(activity.wordsShown().none { it == "Yes, delete" })
        assertEquals(3, activity.shown().filterIsInstance<Button>().count { "pond" in it.text || "bay" in it.text })
    }

    /** The second tap of a hand in a glove comes where the first one was. */
    @Test
    fun deletePressedTwiceDeletesNothing() {
        val (column, index) = askToDelete()
        val there = column.getChildAt(index)
        assertEquals(R.id.delete_no, there.id)
        there.performClick()
        assertTrue(activity.view<View>(R.id.delete).isShown)
        assertFalse("Deleted" in activity.wordsShown())
    }

    /** Where the button stood: its column, and the how manieth in it. */
    private fun askToDelete(): Pair<ViewGroup, Int> {
        window.boat.snapshot = Scenes.standingBy.copy(past = Scenes.past)
        activity.go(ScreenName.PAST)
        activity.show(window.boat.snapshot)
        fun opened(): View {
            activity.shown().filterIsInstance<Button>().first { "North-pond" in it.text }.performClick()
            return activity.view(R.id.delete)
        }
        val delete = opened()
        val index = (delete.parent as ViewGroup).indexOfChild(delete)
        delete.performClick()
        return activity.view<View>(R.id.delete_yes).parent as ViewGroup to index
    }
}
