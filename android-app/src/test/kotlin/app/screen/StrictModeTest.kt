package stillwater.app.screen

import android.app.Application
import android.os.StrictMode
import org.junit.After
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.RobolectricTestRunner
import org.robolectric.RuntimeEnvironment
import org.robolectric.annotation.Config
import stillwater.app.mission.FileOutput
import stillwater.app.mission.LogFolder
import stillwater.app.service.BoatService
import java.io.File
import kotlin.test.assertEquals

/** What StrictMode sees in a test: what [DemoTest] and [ColdStartTest] would fall over. */
@RunWith(RobolectricTestRunner::class)
@Config(sdk = [26, 35])
class StrictModeTest {
    private val context: Application = RuntimeEnvironment.getApplication()
    private val folder = File(context.filesDir, "logs").apply { mkdirs() }

    @After
    fun lax() = StrictMode.setThreadPolicy(StrictMode.ThreadPolicy.LAX)

    @Test
    fun whatTheAppDoesWithTheDiskIsSeenOnTheMainThread() {
        assertEquals(true, isSeen { BoatService.logOf(context, "a.log") })
        assertEquals(true, isSeen { FileOutput(File(folder, "a.log")) })
        val open = FileOutput(File(folder, "b.log"))
        assertEquals(true, isSeen { open.append("line\n".toByteArray()) })
        open.close()
        assertEquals(true, isSeen { LogFolder({ folder }).past() })
        assertEquals(true, isSeen { LogFolder({ folder }).recover("a.log.incomplete") })
        assertEquals(false, isSeen { context.getString(stillwater.app.R.string.stop) })
    }

    /** Where this fails Robolectric has learned it, and the app's own words for it, `mayWait`, may go. */
    @Test
    fun filesOfJavaAloneAreNotSeen() {
        assertEquals(false, isSeen { File(folder, "c").writeText("nobody looks") })
    }

    private fun isSeen(work: () -> Unit): Boolean {
        StrictMode.setThreadPolicy(STRICT)
        val seen = runCatching(work).exceptionOrNull()
        StrictMode.setThreadPolicy(StrictMode.ThreadPolicy.LAX)
        // Android 8 has a class of its own for it.
        check(seen == null || "StrictMode" in "$seen") { "$seen" }
        return seen != null
    }
}
