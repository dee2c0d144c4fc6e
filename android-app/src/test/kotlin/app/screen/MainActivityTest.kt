package stillwater.app.screen

import android.app.Application
import android.content.pm.PackageManager
import android.content.res.Configuration
import android.provider.Settings
import android.view.View
import android.view.ViewGroup
import android.widget.Button
import android.widget.TextView
import org.junit.Before
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.Robolectric
import org.robolectric.RobolectricTestRunner
import org.robolectric.RuntimeEnvironment
import org.robolectric.Shadows.shadowOf
import org.robolectric.annotation.Config
import stillwater.app.R
import stillwater.app.service.BoatService
import stillwater.app.service.Preflight
import kotlin.test.assertEquals
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
    fun stopIsOnEveryScreenAndStops() {
        val activity = Robolectric.buildActivity(MainActivity::class.java).setup().get()
        for (tab in listOf(R.id.tab_map, R.id.tab_link)) {
            activity.view<View>(tab).performClick()
            val stop = activity.view<View>(R.id.stop)
            assertTrue(stop.isShown)
            assertTrue(stop.isEnabled)
            stop.performClick()
            // Looking at the service is recorded like starting it, and comes before.
            val sent = generateSequence { shadowOf(context).nextStartedService }.last()
            assertEquals(BoatService.stopIntent(context).action, sent.action)
            assertEquals(BoatService::class.java.name, sent.component?.className)
        }
    }

    @Test
    fun aTurnOfThePhoneKeepsTheScreen() {
        val controller = Robolectric.buildActivity(MainActivity::class.java).setup()
        controller.get().view<View>(R.id.tab_link).performClick()
        controller.recreate()
        assertTrue(controller.get().view<View>(R.id.state).isShown)
    }

    @Test
    fun permissionsAreAskedForTogether() {
        val activity = Robolectric.buildActivity(MainActivity::class.java).setup().get()
        activity.view<View>(R.id.tab_link).performClick()
        activity.view<View>(R.id.allow).performClick()
        val asked = shadowOf(activity).lastRequestedPermission.requestedPermissions
        assertEquals(Preflight.neededPermissions(), asked.toList())
    }

    @Test
    fun aRefusalForGoodLeadsToTheSettings() {
        val activity = Robolectric.buildActivity(MainActivity::class.java).setup().get()
        activity.view<View>(R.id.tab_link).performClick()
        val asked = Preflight.neededPermissions().toTypedArray()
        // Refused once: Android would still say why it asks, so the app asks again.
        asked.forEach { shadowOf(context.packageManager).setShouldShowRequestPermissionRationale(it, true) }
        activity.onRequestPermissionsResult(1, asked, IntArray(asked.size) { PackageManager.PERMISSION_DENIED })
        val allow = activity.view<Button>(R.id.allow)
        assertEquals(context.getString(R.string.allow), allow.text)
        // Refused for good.
        asked.forEach { shadowOf(context.packageManager).setShouldShowRequestPermissionRationale(it, false) }
        activity.onRequestPermissionsResult(1, asked, IntArray(asked.size) { PackageManager.PERMISSION_DENIED })
        assertEquals(context.getString(R.string.allow_in_settings), allow.text)
        allow.performClick()
        val opened = shadowOf(activity).nextStartedActivity
        assertEquals(Settings.ACTION_APPLICATION_DETAILS_SETTINGS, opened.action)
        assertEquals("package:stillwater.app", opened.data.toString())
    }

    @Test
    fun whatCanBePressedIsLargeAndHasAName() {
        val activity = Robolectric.buildActivity(MainActivity::class.java).setup().get()
        val pressed = views(activity.window.decorView).filterIsInstance<Button>().toList()
        assertTrue(pressed.size >= 4, "buttons ${pressed.map { it.text }}")
        val least = activity.resources.getDimensionPixelSize(R.dimen.button_height)
        for (button in pressed) {
            assertTrue(button.minimumHeight >= least, "${button.text}")
            assertTrue((button.contentDescription ?: button.text).isNotEmpty())
        }
        val map = activity.view<View>(R.id.map)
        assertTrue(map.contentDescription.isNotEmpty())
    }

    @Test
    @Config(qualifiers = "+night")
    fun atNightTheGroundIsBlack() {
        val activity = Robolectric.buildActivity(MainActivity::class.java).setup().get()
        val mode = activity.resources.configuration.uiMode and Configuration.UI_MODE_NIGHT_MASK
        assertEquals(Configuration.UI_MODE_NIGHT_YES, mode)
        assertEquals(0xFF000000.toInt(), activity.getColor(R.color.ground))
        assertEquals(0xFFFFFFFF.toInt(), activity.view<TextView>(R.id.state).currentTextColor)
    }

    @Test
    @Config(qualifiers = "+de-rDE")
    fun anotherLanguageOfThePhoneLeavesTheWordsEnglish() {
        val activity = Robolectric.buildActivity(MainActivity::class.java).setup().get()
        assertEquals("STOP", activity.view<Button>(R.id.stop).text)
    }

    private fun views(root: View): Sequence<View> =
        sequence {
            yield(root)
            if (root is ViewGroup) for (index in 0 until root.childCount) yieldAll(views(root.getChildAt(index)))
        }
}
