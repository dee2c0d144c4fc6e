package stillwater.app.service

import android.app.Application
import android.content.pm.ServiceInfo
import android.location.LocationManager
import android.os.Build
import android.os.Looper
import org.junit.After
import org.junit.Rule
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.RobolectricTestRunner
import org.robolectric.RuntimeEnvironment
import org.robolectric.Shadows.shadowOf
import org.robolectric.annotation.Config
import org.robolectric.util.ReflectionHelpers
import stillwater.mission.MissionState
import java.time.Duration
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertNotNull
import kotlin.test.assertTrue

/**
 * Android starts the service again in the background after the process died, lets it into the foreground and keeps
 * positions back without a word, as Androids 11 to 13 do. Robolectric keeps nothing back by itself: the receiver's
 * silence is the test's.
 */
@RunWith(RobolectricTestRunner::class)
@Config(sdk = [34])
class BackgroundPlaceTest {
    private val context: Application = RuntimeEnvironment.getApplication()
    private val real = Build.VERSION.SDK_INT

    @get:Rule
    internal val pond = Pond()
    private val desk get() = pond.desk

    @After
    fun back() = version(real)

    @Test
    fun positionsThatAreKeptBackInSilenceAreToldAndAskedForAgainFromTheWindow() {
        pond.survey()
        desk.pass(10.0)
        desk.end()
        version(Build.VERSION_CODES.TIRAMISU)
        desk.start(intent = null)
        settle()
        val service = desk.service
        assertEquals(BoatActivity.RECOVERED, desk.snapshot.activity)
        assertTrue(desk.snapshot.isWithoutPlace)
        val shown = assertNotNull(shadowOf(service).lastForegroundNotification)
        val said = shadowOf(shown).contentText.toString()
        assertTrue(said.startsWith("Open the app: until then Android gives it no position"), said)
        // No fix: nothing can be begun, and nothing moves.
        desk.ask { start() }
        assertEquals(Answer(Answer.Reason.NOT_READY), desk.snapshot.answer)
        assertEquals(MissionState.Idle, desk.state)

        val first = listeners().single()
        generateSequence { shadowOf(context).nextStartedService }.count()
        service.onBind(null)
        val sent = assertNotNull(shadowOf(context).nextStartedService, "a start from an app in sight")
        assertEquals(android.app.Service.START_STICKY, service.onStartCommand(sent, 0, 2))
        settle()
        assertTrue(desk.snapshot.isWithoutPlace, "nobody knows whether the window was in sight already")
        shadowOf(Looper.getMainLooper()).idleFor(Duration.ofSeconds(1))
        settle()
        assertNotNull(shadowOf(context).nextStartedService)
        assertFalse(desk.snapshot.isWithoutPlace)
        val both = ServiceInfo.FOREGROUND_SERVICE_TYPE_CONNECTED_DEVICE or ServiceInfo.FOREGROUND_SERVICE_TYPE_LOCATION
        assertEquals(both, service.foregroundServiceType)
        assertEquals(listOf(first), listeners(), "asked for afresh, and heard once")
        pond.green()
        pond.survey()
    }

    @Test
    fun elsewhereNothingIsKeptBackInSilence() {
        for ((sdk, isKeptBack) in mapOf(29 to false, 30 to true, 31 to true, 33 to true, 34 to false, 35 to false)) {
            version(sdk)
            assertEquals(isKeptBack, BackgroundPlace.isKeptBackInSilence, "API $sdk")
        }
    }

    private fun listeners() =
        shadowOf(assertNotNull(context.getSystemService(LocationManager::class.java)))
            .getLocationUpdateListeners(LocationManager.GPS_PROVIDER)

    private fun settle() {
        shadowOf(desk.service.boatLooper).idleFor(Duration.ofMillis(1_000))
        desk.settle()
    }

    private fun version(sdk: Int) = ReflectionHelpers.setStaticField(Build.VERSION::class.java, "SDK_INT", sdk)
}
