package stillwater.app.screen

import android.content.Context
import android.view.View
import android.widget.ScrollView
import stillwater.app.R
import stillwater.app.service.BoatSnapshot

/** The way to the other screens. */
internal class MenuScreen(context: Context, onOpen: (ScreenName) -> Unit) : Screen {
    override val view: View =
        ScrollView(context).apply {
            val list = context.column()
            val gap = resources.getDimensionPixelSize(R.dimen.gap)
            list.setPadding(gap, gap, gap, gap)
            for (name in ScreenName.entries.filter { it.inMenu }) {
                list.below(context.largeButton(context.getString(name.title)) { onOpen(name) }.apply { tag = name })
            }
            addView(list)
        }

    override fun show(snapshot: BoatSnapshot) = Unit
}
