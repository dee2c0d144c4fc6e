package stillwater.app.screen

import android.app.Activity
import android.view.View
import android.view.ViewGroup
import android.widget.Button
import android.widget.TextView

/** The view that the screen must have. */
internal fun <T : View> Activity.view(id: Int): T = checkNotNull(findViewById<T>(id)) { "no view $id" }

/** [root] and all below it. */
internal fun views(root: View): Sequence<View> =
    sequence {
        yield(root)
        if (root is ViewGroup) for (index in 0 until root.childCount) yieldAll(views(root.getChildAt(index)))
    }

/** What is in sight of the window. */
internal fun Activity.shown(): List<View> = views(window.decorView).filter { it.isShown }.toList()

/** The words in sight. */
internal fun Activity.wordsShown(): List<String> = shown().filterIsInstance<TextView>().map { it.text.toString() }

/** The button in sight that says [words]. */
internal fun Activity.button(words: String): Button =
    checkNotNull(shown().filterIsInstance<Button>().find { it.text.toString() == words }) {
        "no '$words' among ${shown().filterIsInstance<Button>().map { it.text }}"
    }

/** Opens [name] by the menu, as a person does. */
internal fun MainActivity.go(name: ScreenName) {
    view<View>(stillwater.app.R.id.menu).performClick()
    if (name != ScreenName.MENU) shown().single { it.tag == name }.performClick()
}
