package stillwater.app.screen

import android.content.Context
import android.content.res.Configuration
import android.util.TypedValue
import android.view.Gravity
import android.view.View
import android.view.ViewGroup
import android.widget.FrameLayout
import android.widget.LinearLayout
import stillwater.app.R
import stillwater.app.service.BoatSnapshot

/**
 * What is around every screen: the way to the others, the boat's state, and STOP. Above and below the screen, or beside
 * it on a phone that lies.
 */
internal class WindowFrame(private val context: Context, onMenu: () -> Unit, onStop: () -> Unit) {
    private val menu = context.largeButton("", onMenu).apply { id = R.id.menu }
    private val state =
        context.liveLine().apply {
            id = R.id.state
            setTextSize(TypedValue.COMPLEX_UNIT_PX, resources.getDimension(R.dimen.state_text))
        }
    private val screens = FrameLayout(context)

    val view: View =
        if (context.resources.configuration.orientation == Configuration.ORIENTATION_LANDSCAPE) {
            lying(context.stopButton(onStop))
        } else {
            standing(context.stopButton(onStop))
        }.apply { fitsSystemWindows = true }

    /** Adds [screen], out of sight. */
    fun add(screen: View) {
        screen.visibility = View.GONE
        screens.addView(screen)
    }

    /** Brings [screen] into sight, under [title]. */
    fun present(title: String, screen: View) {
        menu.say(context.getString(R.string.menu_button, title))
        menu.contentDescription = context.getString(R.string.menu_said, title)
        for (index in 0 until screens.childCount) screens.getChildAt(index).let { it.show(it === screen) }
    }

    /** Says [words] where the state stands, until the state is another. */
    fun tell(words: String) = state.say(words)

    /** Shows the state of the boat. */
    fun show(snapshot: BoatSnapshot) {
        val now = context.stateWords(snapshot)
        if (now == shown) return
        shown = now
        state.say(now)
        state.setTextColor(context.getColor(if (isBad(snapshot)) R.color.bad else R.color.text))
    }

    private var shown: String? = null

    private fun standing(stop: View): LinearLayout {
        // Beside each other both would break their words where the type is large and the phone narrow.
        val isNarrow = context.letters < LEAST_BESIDE
        val head = if (isNarrow) context.column().apply { onTop() } else beside()
        return context.column().apply {
            below(head)
            below(screens, weight = 1f)
            below(stop)
        }
    }

    private fun LinearLayout.onTop() {
        below(menu)
        below(padded(state))
    }

    private fun beside(): LinearLayout =
        LinearLayout(context).apply {
            val wrap = ViewGroup.LayoutParams.WRAP_CONTENT
            isBaselineAligned = false
            gravity = Gravity.CENTER_VERTICAL
            addView(menu, LinearLayout.LayoutParams(0, wrap, MENU_SHARE))
            addView(padded(state), LinearLayout.LayoutParams(0, wrap, STATE_SHARE))
        }

    private fun lying(stop: View): LinearLayout {
        val side =
            context.column().apply {
                below(menu)
                below(padded(state), weight = 1f)
                below(stop)
            }
        return LinearLayout(context).apply {
            val all = ViewGroup.LayoutParams.MATCH_PARENT
            addView(side, LinearLayout.LayoutParams(0, all, SIDE_SHARE))
            addView(screens, LinearLayout.LayoutParams(0, all, SCREEN_SHARE))
        }
    }

    private fun padded(view: View): View =
        view.apply {
            val gap = resources.getDimensionPixelSize(R.dimen.gap)
            setPadding(gap / 2, gap / 2, gap, gap / 2)
        }

    private companion object {
        /** Width for the menu's button with the state beside it, dp at the usual type. */
        const val LEAST_BESIDE = 200
        const val MENU_SHARE = 2f
        const val STATE_SHARE = 3f
        const val SIDE_SHARE = 3f
        const val SCREEN_SHARE = 7f
    }
}
