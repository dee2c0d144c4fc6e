package stillwater.app.screen

import android.content.ComponentName
import android.os.Looper
import org.robolectric.Robolectric
import org.robolectric.RuntimeEnvironment
import org.robolectric.Shadows.shadowOf
import org.robolectric.android.controller.ActivityController
import stillwater.app.service.BoatBinder
import stillwater.app.service.BoatCommands
import stillwater.app.service.BoatService
import stillwater.app.service.BoatSnapshot
import java.util.concurrent.Executor

/** The app's window with a boat that notes what it is told; everything in the background is done at once. */
internal class Window {
    val boat = NotingBoat()
    val controller: ActivityController<MainActivity>

    init {
        Background.executor = Executor { it.run() }
        val context = RuntimeEnvironment.getApplication()
        shadowOf(context).setComponentNameAndServiceForBindService(
            ComponentName(context, BoatService::class.java),
            BoatBinder(boat),
        )
        controller = Robolectric.buildActivity(MainActivity::class.java).setup()
        settle()
    }

    val activity: MainActivity get() = controller.get()

    /** Lets what waits for the main thread happen. */
    fun settle() = shadowOf(Looper.getMainLooper()).idle()
}

/** Does nothing but note what it was told. */
internal class NotingBoat : BoatCommands {
    val told = mutableListOf<String>()

    override var snapshot = BoatSnapshot()

    override fun load(json: String) = note("load $json")

    override fun arm() = note("arm")

    override fun start() = note("start")

    override fun hold() = note("hold")

    override fun goHome() = note("home")

    override fun stop() = note("stop")

    override fun goOnWith(name: String) = note("go on with $name")

    override fun newMission() = note("new")

    override fun lookForPast() = note("look")

    private fun note(words: String) {
        told += words
    }
}
