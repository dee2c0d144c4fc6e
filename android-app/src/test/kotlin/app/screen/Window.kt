package stillwater.app.screen

import android.content.ComponentName
import android.os.Looper
import org.robolectric.Robolectric
import org.robolectric.RuntimeEnvironment
import org.robolectric.Shadows.shadowOf
import org.robolectric.android.controller.ActivityController
import stillwater.app.service.BoatService

/** The app's window with a boat that notes what it is told; everything in the background is done at once. */
internal class Window {
    val boat: NotingBoat = Robolectric.buildService(NotingBoat::class.java).get()
    val controller: ActivityController<MainActivity>

    init {
        Background.executor = java.util.concurrent.Executor { it.run() }
        val context = RuntimeEnvironment.getApplication()
        shadowOf(context).setComponentNameAndServiceForBindService(
            ComponentName(context, BoatService::class.java),
            boat.onBind(android.content.Intent()),
        )
        controller = Robolectric.buildActivity(MainActivity::class.java).setup()
        settle()
    }

    val activity: MainActivity get() = controller.get()

    /** Lets what waits for the main thread happen. */
    fun settle() = shadowOf(Looper.getMainLooper()).idle()
}

/** Does nothing but note what it was told. */
internal class NotingBoat : BoatService() {
    val told = mutableListOf<String>()

    override fun load(json: String) {
        told += "load $json"
    }

    override fun arm() {
        told += "arm"
    }

    override fun start() {
        told += "start"
    }

    override fun hold() {
        told += "hold"
    }

    override fun goHome() {
        told += "home"
    }

    override fun stop() {
        told += "stop"
    }

    override fun newMission() {
        told += "new"
    }

    override fun lookForPast() {
        told += "look"
    }
}
