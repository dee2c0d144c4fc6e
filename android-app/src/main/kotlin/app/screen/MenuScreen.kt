package stillwater.app.screen

import android.content.Context
import android.view.View
import stillwater.app.service.BoatSnapshot

/** The way to the other screens. */
internal class MenuScreen(context: Context, onOpen: (ScreenName) -> Unit) : Screen {
    override val view: View =
        context.scrolling {
            for (name in ScreenName.entries) {
                val about = name.about ?: continue
                val words = context.titled(context.getString(name.title), context.getString(about))
                below(context.largeButton(words) { onOpen(name) }.apply { tag = name })
            }
        }

    override fun show(snapshot: BoatSnapshot) = Unit
}
