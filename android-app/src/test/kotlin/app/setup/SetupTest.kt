package stillwater.app.setup

import android.os.Bundle
import android.os.Looper
import android.view.MotionEvent
import android.view.View
import android.widget.Button
import android.widget.EditText
import android.widget.TextView
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.Robolectric
import org.robolectric.RobolectricTestRunner
import org.robolectric.Shadows.shadowOf
import stillwater.app.R
import stillwater.app.screen.MainActivity
import stillwater.app.screen.Scenes
import stillwater.app.screen.ScreenName
import stillwater.app.screen.Window
import stillwater.app.screen.button
import stillwater.app.screen.go
import stillwater.app.screen.shown
import stillwater.app.screen.view
import stillwater.app.screen.views
import stillwater.app.screen.wordsShown
import stillwater.mission.DraftField
import stillwater.mission.MissionDraft
import stillwater.mission.MissionSpec
import stillwater.mission.PlannerName
import stillwater.model.LatLon
import stillwater.model.Position
import java.time.Duration
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertNotNull
import kotlin.test.assertTrue

@RunWith(RobolectricTestRunner::class)
class SetupTest {
    private val window = Window()
    private val activity get() = window.activity

    /** A receiver that stands at a place; the frame begins at the first. */
    private fun standAt(latitude: Double, longitude: Double, ageSeconds: Double = 0.4) {
        val fix = checkNotNull(Scenes.standingBy.fix).copy(place = LatLon(latitude, longitude))
        activity.show(Scenes.standingBy.copy(fix = fix, fixAgeSeconds = ageSeconds))
        window.settle()
    }

    private fun press(id: Int) {
        activity.view<View>(id).performClick()
        window.settle()
    }

    private fun openArea() {
        activity.go(ScreenName.MISSION)
        press(R.id.draw_area)
    }

    private fun touch(x: Double, y: Double) {
        activity.view<AreaView>(R.id.area).touched(Position(x, y), REACH)
        window.settle()
    }

    @Test
    fun aShoreThatWasWalkedBecomesTheMissionThatTheBoatGets() {
        openArea()
        for ((north, east) in listOf(0.0 to 0.0, 0.0 to 0.0010, 0.0005 to 0.0010, 0.0005 to 0.0)) {
            standAt(45.33 + north, -73.15 + east)
            press(R.id.drop_corner)
        }
        press(R.id.draw_home)
        standAt(45.3302, -73.1495)
        press(R.id.drop_corner)
        press(R.id.area_done)
        type(R.id.mission_name, "Walked")
        // Nobody but a person knows which battery it is, and no mission begins before one has said.
        assertEquals(setOf(DraftField.LOWEST_VOLTS), activity.desk.check?.problems?.keys)
        assertFalse(activity.view<View>(R.id.use_mission).isEnabled)
        sayVolts()
        press(R.id.use_mission)
        val spec = MissionSpec.fromJson(window.boat.told.single { it.startsWith("load") }.removePrefix("load "))
        assertEquals("Walked", spec.name)
        assertEquals(4, spec.area.corners().size)
        // A thousandth of a degree east at 45.33 degrees north is 78.4 m, half a one north 55.6 m.
        assertEquals(78.4, spec.area.corners().maxOf { it.x }, 0.1)
        assertEquals(55.6, spec.area.corners().maxOf { it.y }, 0.1)
        assertEquals(PlannerName.POLYGON_RRT to 13.2, spec.planner to spec.failsafe.lowestVolts)
        assertEquals(15.0, spec.failsafe.lowestPhonePercent)
        assertTrue(activity.view<View>(R.id.loaded_mission).isShown, "on to the checklist")
    }

    @Test
    fun withoutAFreshPositionNoCornerIsDropped() {
        openArea()
        val drop = activity.view<Button>(R.id.drop_corner)
        assertFalse(drop.isEnabled)
        standAt(45.33, -73.15, ageSeconds = 9.0)
        assertFalse(drop.isEnabled)
        assertEquals("Drop here: no position", drop.text.toString())
        standAt(45.33, -73.15)
        assertEquals("Drop here ±3 m", drop.text.toString())
    }

    @Test
    fun whatIsTouchedBecomesACornerAndACornerThatIsTouchedCanBeRemoved() {
        openArea()
        standAt(45.33, -73.15)
        listOf(0.0 to 0.0, 40.0 to 0.0, 40.0 to 30.0, 0.0 to 30.0).forEach { (x, y) -> touch(x, y) }
        press(R.id.draw_keep_out)
        listOf(10.0 to 10.0, 20.0 to 10.0, 15.0 to 20.0).forEach { (x, y) -> touch(x, y) }
        press(R.id.draw_home)
        touch(35.0, 5.0)
        val draft = activity.desk.draft
        assertEquals(listOf(4, 3), listOf(draft.shore.size, draft.keepOuts.single().size))
        assertEquals(null, activity.desk.check?.problems?.get(DraftField.AREA))
        touch(40.2, 30.1) // m; a finger is never exact
        assertEquals("Remove", activity.view<Button>(R.id.undo_corner).text.toString())
        press(R.id.undo_corner)
        assertEquals(listOf(0.0, 40.0, 0.0), activity.desk.draft.shore.map { it.x })
        press(R.id.undo_corner)
        assertEquals(2, activity.desk.draft.shore.size)
        assertTrue("✗ the shore has 2 different corners; it needs 3" in activity.wordsShown())
    }

    /** By the events that a finger makes, one corner more than wanted, and Undo pressed once too often. */
    @Test
    fun aFingerDrawsAndUndoTakesBack() {
        openArea()
        standAt(45.33, -73.15)
        val water = activity.view<AreaView>(R.id.area)
        assertTrue(water.width > 0 && water.height > 0)
        val wanted = listOf(0.0 to 0.0, 40.0 to 0.0, 40.0 to 30.0, 0.0 to 30.0)
        for ((x, y) in wanted + (20.0 to 50.0)) finger(water, Position(x, y))
        press(R.id.undo_corner)
        val pixel = 1 / assertNotNull(water.projection()).scale.toDouble()
        assertEquals(wanted.size, activity.desk.draft.shore.size)
        wanted.zip(activity.desk.draft.shore).forEach { (meant, drawn) ->
            assertEquals(meant.first, drawn.x, 2 * pixel)
            assertEquals(meant.second, drawn.y, 2 * pixel)
        }
        repeat(wanted.size + 1) { press(R.id.undo_corner) }
        assertTrue(activity.desk.draft.shore.isEmpty())
        assertTrue("✗ no corner is set" in activity.wordsShown())
    }

    private fun finger(water: AreaView, at: Position) {
        val projection = assertNotNull(water.projection())
        for (action in listOf(MotionEvent.ACTION_DOWN, MotionEvent.ACTION_UP)) {
            val event = MotionEvent.obtain(0, 50, action, projection.x(at), projection.y(at), 0)
            water.dispatchTouchEvent(event)
            event.recycle()
        }
        // A second touch within a moment would be half of a double one.
        shadowOf(Looper.getMainLooper()).idleFor(Duration.ofSeconds(1))
        window.settle()
    }

    @Test
    fun aKeepOutThatIsNoneIsRefusedByItsNumber() {
        openArea()
        standAt(45.33, -73.15)
        listOf(0.0 to 0.0, 40.0 to 0.0, 40.0 to 30.0, 0.0 to 30.0).forEach { (x, y) -> touch(x, y) }
        press(R.id.draw_keep_out)
        listOf(10.0 to 10.0, 20.0 to 20.0, 20.0 to 10.0, 10.0 to 20.0).forEach { (x, y) -> touch(x, y) }
        assertTrue(problem().startsWith("✗ keep-out 1 crosses or touches itself"), problem())
        repeat(4) { press(R.id.undo_corner) }
        assertTrue(activity.desk.draft.keepOuts.isEmpty())
        listOf(60.0 to 10.0, 70.0 to 10.0, 65.0 to 20.0).forEach { (x, y) -> touch(x, y) }
        assertTrue(Regex("✗ keep-out 1, which starts at .*, lies outside the shore").matches(problem()), problem())
    }

    private fun problem() = activity.wordsShown().first { it.startsWith("✗") }

    /** A slip of the sign, or a draft of last week's water: told, not drawn, and the way out is told as well. */
    @Test
    fun aPlaceOfAnotherWaterIsRefusedAndClearAllBeginsThere() {
        openArea()
        standAt(45.33, -73.15)
        touch(0.0, 0.0)
        val (latitude, longitude) = activity.shown().filterIsInstance<EditText>()
        latitude.setText("45.33")
        longitude.setText("73.15")
        press(R.id.add_coordinates)
        assertTrue(Regex("✗ this place is \\d+ km from where the drawing began; .*").matches(problem()), problem())
        assertEquals("73.15", longitude.text.toString(), "to be mended")
        assertEquals(1, activity.desk.draft.shore.size)
        longitude.setText("-73.151")
        press(R.id.add_coordinates)
        assertEquals(2, activity.desk.draft.shore.size)
        assertTrue("this place" !in problem(), problem())

        standAt(47.33, -73.15)
        press(R.id.drop_corner)
        assertTrue("✗ this place is 222 km" in problem(), problem())
        press(R.id.clear_area)
        press(R.id.drop_corner)
        assertEquals(47.33, activity.desk.draft.origin?.latitude)
        assertEquals(1, activity.desk.draft.shore.size)
    }

    @Test
    fun aShoreThatCrossesItselfSaysWhere() {
        openArea()
        standAt(45.33, -73.15)
        listOf(0.0 to 0.0, 40.0 to 30.0, 40.0 to 0.0, 0.0 to 20.0).forEach { (x, y) -> touch(x, y) }
        val said = activity.wordsShown().single { it.startsWith("✗") }
        assertTrue("crosses or touches itself: edge 1 (0.0 m, 0.0 m) to (40.0 m, 30.0 m)" in said, said)
        press(R.id.area_done)
        assertTrue(activity.wordsShown().any { it == said }, "the form says it as well")
        assertFalse(activity.view<View>(R.id.use_mission).isEnabled)
    }

    @Test
    fun aPlaceCanBeTypedAndNonsenseIsRefused() {
        openArea()
        val (latitude, longitude) = activity.shown().filterIsInstance<EditText>()
        latitude.setText("91")
        longitude.setText("east")
        press(R.id.add_coordinates)
        assertTrue("✗ '91' is not a latitude between -90 and 90" in activity.wordsShown(), "${activity.wordsShown()}")
        assertTrue("✗ 'east' is not a longitude between -180 and 360" in activity.wordsShown())
        assertTrue(activity.desk.draft.shore.isEmpty())
        // As keys do it: some keyboards have a comma only, and what they send is filtered.
        latitude.text.clear()
        latitude.append("45,33")
        longitude.setText("-73.15")
        press(R.id.add_coordinates)
        assertEquals(45.33, activity.desk.draft.origin?.latitude)
        assertEquals(1, activity.desk.draft.shore.size)
        assertEquals("", latitude.text.toString())
    }

    @Test
    fun aRectangleNeedsTwoCornersAndAnyPlannerMayUseIt() {
        openArea()
        standAt(45.33, -73.15)
        press(R.id.rectangle)
        touch(0.0, 30.0)
        touch(40.0, 10.0)
        touch(40.0, 0.0) // a better second one
        press(R.id.draw_home)
        touch(35.0, 5.0)
        press(R.id.area_done)
        type(R.id.mission_name, "Box")
        pick("Planner: ", "lawnmower")
        sayVolts()
        val spec = assertNotNull(activity.desk.check?.spec, "${activity.desk.check?.problems}")
        assertEquals(PlannerName.LAWNMOWER to 8 * 6, spec.planner to spec.grid.grid().size)
    }

    @Test
    fun whatIsWrongStandsUnderItsField() {
        activity.desk.change { MissionDraft.of(Scenes.spec) }
        activity.go(ScreenName.MISSION)
        window.settle()
        assertTrue(activity.view<View>(R.id.use_mission).isEnabled)
        pick("Planner: ", "lawnmower")
        assertTrue(activity.wordsShown().any { it.startsWith("✗ this planner goes") })
        type(R.id.mission_name, " ")
        assertTrue("✗ a mission needs a name" in activity.wordsShown())
        assertFalse(activity.view<View>(R.id.use_mission).isEnabled)
        pick("Measures: ", "Acidity (pH)")
        assertEquals("4", activity.desk.draft.text(DraftField.LOWEST))
    }

    @Test
    fun aTurnOfThePhoneKeepsAHalfDrawnAreaAndWhatWasTyped() {
        openArea()
        standAt(45.33, -73.15)
        touch(0.0, 0.0)
        touch(40.0, 0.0)
        press(R.id.draw_keep_out)
        touch(10.0, 10.0)
        activity.desk.change { it.with(DraftField.BUDGET, "12e") }
        val before = activity.desk.draft
        window.controller.recreate()
        window.settle()
        assertEquals(before, activity.desk.draft)
        assertTrue(activity.view<View>(R.id.area).isShown)
        touch(20.0, 10.0)
        assertEquals(2, activity.desk.draft.keepOuts.single().size, "the outline that was begun goes on")
    }

    @Test
    fun theDraftOutlivesTheAppItself() {
        openArea()
        standAt(45.33, -73.15)
        touch(0.0, 0.0)
        val before = activity.desk.draft
        window.controller.pause().stop().destroy()
        val again = Window()
        assertEquals(before, again.activity.desk.draft)
    }

    @Test
    fun aProcessThatDiedGetsItsScreensAndItsDraftBack() {
        openArea()
        standAt(45.33, -73.15)
        touch(0.0, 0.0)
        val before = activity.desk.draft
        val state = Bundle()
        window.controller.saveInstanceState(state).pause().stop().destroy()
        val again = Robolectric.buildActivity(MainActivity::class.java).setup(state)
        assertTrue(again.get().view<View>(R.id.area).isShown)
        assertEquals(before, again.get().desk.draft)
    }

    private fun type(id: Int, text: String) {
        activity.view<EditText>(id).setText(text)
        window.settle()
    }

    private fun sayVolts() = say("Low is below", "13.2")

    /** Types [text] into the field whose words have [label]. */
    private fun say(label: String, text: String) {
        val field =
            activity.shown().filterIsInstance<EditText>().single { edit ->
                views(edit.parent as View).any { it is TextView && label in it.text }
            }
        field.setText(text)
        window.settle()
    }

    @Test
    fun thePhonesOwnLimitIsAskedForAndKeptWithinItsCharge() {
        activity.desk.change { MissionDraft.of(Scenes.spec) }
        activity.go(ScreenName.MISSION)
        window.settle()
        say("The phone", "120")
        assertEquals(setOf(DraftField.LOWEST_PHONE), activity.desk.check?.problems?.keys)
        say("The phone", "30")
        assertEquals(30.0, activity.desk.check?.spec?.failsafe?.lowestPhonePercent)
    }

    private companion object {
        /** A fingertip on a pond that fills the screen, m. */
        const val REACH = 3.0
    }

    private fun pick(name: String, option: String) {
        activity.shown().filterIsInstance<Button>().single { it.text.startsWith(name) }.performClick()
        activity.button(option).performClick()
        window.settle()
    }
}
