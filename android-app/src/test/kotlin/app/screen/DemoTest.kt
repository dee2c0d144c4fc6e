package stillwater.app.screen

import android.app.Application
import android.content.ComponentName
import android.os.BatteryManager
import android.os.Looper
import android.os.PowerManager
import android.os.StrictMode
import android.view.View
import android.widget.TextView
import org.junit.After
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
import stillwater.app.service.ServiceDesk
import stillwater.mission.MissionDraft
import stillwater.mission.MissionSpec
import java.time.Duration
import kotlin.test.assertTrue

/** Someone without a boat tries the app: from the first look to the end of a mission, with the service that it has. */
@RunWith(RobolectricTestRunner::class)
@Config(sdk = [35])
class DemoTest {
    private val context: Application = RuntimeEnvironment.getApplication()
    private val service = Robolectric.buildService(BoatService::class.java)

    /** Whoever waits for the disk or the link on the main thread falls over; see StrictModeTest for what is seen. */
    @Before
    fun nothingWaitsOnTheMainThread() {
        Background.executor = AnotherThread
        StrictMode.setThreadPolicy(STRICT)
    }

    @After
    fun end() {
        StrictMode.setThreadPolicy(StrictMode.ThreadPolicy.LAX)
        val threads = listOf(service.get().boatLooper.thread, service.get().diskLooper.thread)
        service.destroy()
        threads.forEach { it.join() }
    }

    @Test
    fun theDemoGoesFromTheMenuToAMeasuredMap() {
        Preflight.neededPermissions().forEach { shadowOf(context).grantPermissions(it) }
        shadowOf(checkNotNull(context.getSystemService(PowerManager::class.java)))
            .setIgnoringBatteryOptimizations(context.packageName, true)
        shadowOf(checkNotNull(context.getSystemService(BatteryManager::class.java)))
            .setIntProperty(BatteryManager.BATTERY_PROPERTY_CAPACITY, 80)
        service.create()
        val binder = service.get().onBind(null)
        shadowOf(context).setComponentNameAndServiceForBindService(
            ComponentName(context, BoatService::class.java),
            binder,
        )
        val window = Robolectric.buildActivity(MainActivity::class.java).setup()
        var activity = window.get()
        pass(1.0)
        activity.go(ScreenName.LINK)
        activity.button("Connect to Demo: virtual boat").performClick()
        val sent = generateSequence { shadowOf(context).nextStartedService }.last { it.hasExtra("link") }
        service.get().onStartCommand(sent, 0, 1)
        activity.desk.change { MissionDraft.of(MissionSpec.fromJson(ServiceDesk.POND)) }
        activity.go(ScreenName.MISSION)
        pass(1.0)
        activity.view<View>(R.id.use_mission).performClick()
        pass(8.0)
        val words = activity.wordsShown()
        assertTrue("All in order" in words, "$words")
        activity.view<View>(R.id.start).performClick()
        pass(60.0)
        assertTrue("Surveying" in activity.view<TextView>(R.id.state).text, "${activity.wordsShown()}")
        // The phone is turned under way, and the window is another.
        window.recreate()
        activity = window.get()
        pass(1.0)
        assertTrue("Surveying" in activity.view<TextView>(R.id.state).text, "${activity.wordsShown()}")
        activity.go(ScreenName.MAP)
        pass(1.0)
        val said = activity.view<View>(R.id.map).contentDescription.toString()
        assertTrue(Regex("Map: [1-9]\\d* of 12 cells measured.*").matches(said), said)
        activity.go(ScreenName.START)
        activity.view<View>(R.id.hold).performClick()
        pass(2.0)
        assertTrue("Holding: you said hold" in activity.view<TextView>(R.id.state).text, "${activity.wordsShown()}")
        activity.view<View>(R.id.stop).performClick()
        // The new window's look at the service is recorded like a start, and comes before.
        service.get().onStartCommand(generateSequence { shadowOf(context).nextStartedService }.last(), 0, 2)
        pass(12.0)
        assertTrue("Stopped: you stopped it" in activity.view<TextView>(R.id.state).text, "${activity.wordsShown()}")
        activity.go(ScreenName.PAST)
        pass(2.0)
        val past = activity.wordsShown()
        assertTrue(past.any { it.startsWith("demo-pond") && it.endsWith("complete") }, "$past")
    }

    /** Lets [seconds] s go by for the boat, its disk and the screens. */
    private fun pass(seconds: Double) {
        repeat((seconds * 2).toInt()) {
            shadowOf(service.get().boatLooper).idleFor(Duration.ofMillis(500))
            shadowOf(service.get().diskLooper).idle()
            shadowOf(service.get().boatLooper).idle()
        }
        shadowOf(Looper.getMainLooper()).idle()
    }
}
