package stillwater.app.screen

import android.content.Intent
import android.view.View
import stillwater.app.link.LinkChoice
import stillwater.app.service.BoatCommands
import stillwater.app.service.BoatSnapshot
import stillwater.app.setup.DraftDesk

/** One screen of the window. */
internal interface Screen {
    /** What is drawn. */
    val view: View

    /** Shows [snapshot]; called twice a second while it is in sight, and once when it comes into sight. */
    fun show(snapshot: BoatSnapshot)

    /** Comes into sight. */
    fun opened() = Unit
}

/** What the window does for its screens. */
internal interface ScreenHost {
    /** The service; null while Android has not yet handed it over. */
    val boat: BoatCommands?

    /** The mission that is being filled in. */
    val desk: DraftDesk

    /** Whether Android asks for permissions no more, so that only its settings help. */
    val isRefusedForGood: Boolean

    /** Opens [name]; back leads to the screen before it. */
    fun open(name: ScreenName)

    /** To the screen before. */
    fun back()

    /** Takes up the link that was chosen. */
    fun connect(choice: LinkChoice)

    /** Has Android ask for what it has to be asked for. */
    fun allow()

    /** Has Android ask whether the app may run while the screen is off. */
    fun exempt()

    /** Has the person choose a document by [intent]; what is chosen goes to [purpose]. */
    fun choose(intent: Intent, purpose: DocumentPurpose)

    /** Opens a screen of Android's own; tells in words where there is none. */
    fun leave(intent: Intent)
}
