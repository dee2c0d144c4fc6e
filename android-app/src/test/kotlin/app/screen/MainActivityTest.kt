package stillwater.app.screen

import android.Manifest
import android.app.Application
import android.content.pm.PackageManager
import android.content.res.Configuration
import android.provider.Settings
import android.view.View
import android.widget.Button
import android.widget.TextView
import org.junit.Before
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.RobolectricTestRunner
import org.robolectric.RuntimeEnvironment
import org.robolectric.Shadows.shadowOf
import org.robolectric.annotation.Config
import stillwater.app.R
import stillwater.app.service.BoatService
import stillwater.app.service.BoatSnapshot
import stillwater.app.service.Preflight
import stillwater.app.service.PreflightCheck
import stillwater.app.service.PreflightItem
import stillwater.app.service.PreflightReason
import stillwater.mission.CellsText
import stillwater.mission.DraftField
import stillwater.mission.MissionDraft
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertSame
import kotlin.test.assertTrue

@RunWith(RobolectricTestRunner::class)
@Config(sdk = [26, 29, 34, 35])
class MainActivityTest {
    private val context: Application = RuntimeEnvironment.getApplication()

    @Before
    fun refuseEverything() {
        shadowOf(context).denyPermissions(*Preflight.neededPermissions().toTypedArray())
    }

    @Test
    fun everyScreenHasStopAndWhatCanBePressedIsLargeAndHasAName() {
        val activity = Window().activity
        for (name in ScreenName.entries) {
            activity.open(name)
            activity.show(Scenes.recovered)
            checkPressable(activity, name)
            val stop = activity.view<View>(R.id.stop)
            assertTrue(stop.isShown, "$name")
            assertTrue(stop.isEnabled)
            stop.performClick()
            // Looking at the service is recorded like starting it, and comes before.
            val sent = generateSequence { shadowOf(context).nextStartedService }.last()
            assertEquals(BoatService.stopIntent(context).action, sent.action)
            assertEquals(BoatService::class.java.name, sent.component?.className)
        }
    }

    @Test
    fun aTurnOfThePhoneKeepsTheScreenAndTheWayBack() {
        val window = Window()
        window.activity.go(ScreenName.TRACE)
        window.activity.go(ScreenName.LINK)
        val before = window.activity
        window.controller.recreate()
        assertTrue(before !== window.activity && before.isDestroyed)
        assertEquals("Link", window.activity.view<TextView>(R.id.menu).text.toString().drop(2))
        @Suppress("DEPRECATION")
        window.activity.onBackPressed()
        assertTrue(window.activity.view<View>(R.id.trace).isShown)
    }

    @Test
    @Config(sdk = [35])
    fun theWayThroughTheScreensOutlivesATurnOfThePhoneAndBackLeadsAlongIt() {
        val window = Window()
        window.activity.go(ScreenName.MISSION)
        window.activity.view<View>(R.id.draw_area).performClick()
        window.activity.go(ScreenName.LINK)
        window.controller.recreate()
        val seen = ArrayList<String>()
        repeat(4) {
            seen += window.activity.view<TextView>(R.id.menu).text.toString().drop(2)
            @Suppress("DEPRECATION")
            window.activity.onBackPressed()
        }
        assertEquals(listOf("Link", "Area", "Mission", "Map"), seen)
        assertTrue(window.activity.isFinishing, "back from the first screen leaves the app")
    }

    @Test
    @Config(sdk = [35])
    fun theMenuClosesAsItOpens() {
        val activity = Window().activity
        activity.go(ScreenName.TRACE)
        activity.go(ScreenName.MENU)
        activity.view<View>(R.id.menu).performClick()
        assertTrue(activity.view<View>(R.id.trace).isShown)
    }

    @Test
    fun aRefusalForGoodLeadsToTheSettings() {
        val activity = Window().activity
        val red = PreflightItem(PreflightCheck.PERMISSIONS, ready = false, PreflightReason.NOT_PERMITTED)
        val snapshot = Scenes.loaded.copy(preflight = listOf(red))
        activity.go(ScreenName.START)
        activity.show(snapshot)
        activity.button(context.getString(R.string.allow)).performClick()
        val all = Preflight.neededPermissions()
        val request = shadowOf(activity).lastRequestedPermission.requestedPermissions.toList()
        assertEquals(all + Manifest.permission.ACCESS_COARSE_LOCATION, request, "all at once")
        val asked = all.toTypedArray()
        // Refused once: Android would still say why it asks, so the app asks again.
        asked.forEach { shadowOf(context.packageManager).setShouldShowRequestPermissionRationale(it, true) }
        activity.onRequestPermissionsResult(1, asked, IntArray(asked.size) { PackageManager.PERMISSION_DENIED })
        activity.show(snapshot)
        activity.button(context.getString(R.string.allow))
        // Refused for good.
        asked.forEach { shadowOf(context.packageManager).setShouldShowRequestPermissionRationale(it, false) }
        activity.onRequestPermissionsResult(1, asked, IntArray(asked.size) { PackageManager.PERMISSION_DENIED })
        activity.show(snapshot)
        activity.button(context.getString(R.string.allow_in_settings)).performClick()
        val opened = shadowOf(activity).nextStartedActivity
        assertEquals(Settings.ACTION_APPLICATION_DETAILS_SETTINGS, opened.action)
        assertEquals("package:stillwater.app", opened.data.toString())
        // Given after all.
        shadowOf(context).grantPermissions(*asked)
        activity.onRequestPermissionsResult(1, asked, IntArray(asked.size) { PackageManager.PERMISSION_GRANTED })
        assertFalse(activity.isRefusedForGood)
        assertEquals(emptyList(), Preflight.missingPermissions(context))
        activity.show(Scenes.loaded)
        assertTrue("All in order" in activity.wordsShown())
        // Pressed once more while the line was still red: Android throws where nothing is asked for.
        val before = shadowOf(activity).lastRequestedPermission
        activity.allow()
        assertSame(before, shadowOf(activity).lastRequestedPermission)
    }

    /** Views are the same on all Androids: what comes and goes, and what unfolds, on one. */
    @Test
    @Config(sdk = [35])
    fun whatUnfoldsIsLargeAndHasAName() {
        val activity = Window().activity
        for (name in ScreenName.entries) {
            activity.open(name)
            for (snapshot in listOf(BoatSnapshot(), Scenes.recovered, Scenes.surveying, PAST)) {
                activity.show(snapshot)
                openAllThatFolds(activity)
                checkPressable(activity, name)
            }
        }
    }

    /** Lists of choices and missions, one after the other; what is in them is looked at, too. */
    private fun openAllThatFolds(activity: MainActivity) {
        val folded = activity.shown().filterIsInstance<Button>().filter { "▾" in it.text || "CUT\u00A0OFF" in it.text }
        folded.forEach { it.performClick() }
    }

    /** As laid out: 64 dp high and 48 dp wide at least, STOP higher still and across the window. */
    private fun checkPressable(activity: MainActivity, name: ScreenName) {
        val window = activity.window.decorView
        window.measure(exactly(window.width), exactly(window.height))
        window.layout(0, 0, window.width, window.height)
        val density = activity.resources.displayMetrics.density
        val shown = activity.shown()
        val labelled = shown.map { it.labelFor }.toSet() - View.NO_ID
        val pressed = shown.filter { it.isClickable || it.hasOnClickListeners() || it is WaterView }
        assertTrue(pressed.size >= 2, "$name")
        for (view in pressed) {
            val said = view.contentDescription ?: (view as? TextView)?.text
            assertTrue(view.id in labelled || !said.isNullOrBlank(), "$name: $view says nothing")
            val (high, wide) = view.height / density to view.width / density
            assertTrue(high >= LEAST_HEIGHT && wide >= LEAST_WIDTH, "$name: $said is $wide x $high dp")
        }
        val stop = activity.view<View>(R.id.stop)
        assertTrue(stop.height / density >= STOP_HEIGHT && stop.width > 0.9 * window.width, "$name")
    }

    private fun exactly(size: Int) = View.MeasureSpec.makeMeasureSpec(size, View.MeasureSpec.EXACTLY)

    @Test
    fun whatChangesByItselfIsSaid() {
        val activity = Window().activity
        activity.show(Scenes.surveying)
        val state = activity.view<TextView>(R.id.state)
        assertEquals("Surveying\nBoat 3: connected", state.text.toString())
        assertEquals(View.ACCESSIBILITY_LIVE_REGION_POLITE, state.accessibilityLiveRegion)
        activity.show(Scenes.recovered)
        assertEquals("Loaded, disarmed\nBoat 3: LINK LOST, trying again", state.text.toString())
        assertEquals(activity.getColor(R.color.bad), state.currentTextColor)
        activity.go(ScreenName.START)
        val readiness = activity.view<TextView>(R.id.readiness)
        assertEquals(View.ACCESSIBILITY_LIVE_REGION_POLITE, readiness.accessibilityLiveRegion)
    }

    @Test
    @Config(qualifiers = "+night")
    fun atNightTheGroundIsBlack() {
        val activity = Window().activity
        val mode = activity.resources.configuration.uiMode and Configuration.UI_MODE_NIGHT_MASK
        assertEquals(Configuration.UI_MODE_NIGHT_YES, mode)
        assertEquals(0xFF000000.toInt(), activity.getColor(R.color.ground))
        assertEquals(0xFFFFFFFF.toInt(), activity.view<TextView>(R.id.state).currentTextColor)
    }

    @Test
    @Config(qualifiers = "+de-rDE")
    fun anotherLanguageOfThePhoneLeavesTheWordsEnglish() {
        val window = Window()
        val activity = window.activity
        assertEquals("STOP", activity.view<Button>(R.id.stop).text)
        // Numbers are the reader's own, on the screen and as they are typed; in files they are everybody's.
        activity.show(Scenes.surveying)
        val said = activity.view<MapView>(R.id.map).tap(Scenes.spec.grid.grid().center(70)).orEmpty()
        assertTrue("6,982 mg/L" in said, said)
        activity.desk.change { MissionDraft.of(Scenes.spec).with(DraftField.CELL, "2,5") }
        window.settle()
        assertEquals(2.5, activity.desk.check?.spec?.grid?.cell)
        val table = StringBuilder().also { CellsText(Scenes.spec, Scenes.report.map).csv(it) }.lines()
        assertEquals(table[0].split(',').size, table[1].split(',').size)
    }

    private companion object {
        val PAST = Scenes.standingBy.copy(past = Scenes.past)

        /** dp; Android asks for 48 either way, a wet glove for more. */
        const val LEAST_HEIGHT = 64f
        const val LEAST_WIDTH = 48f
        const val STOP_HEIGHT = 88f
    }
}
