package stillwater.app.screen

import android.app.Activity
import android.view.View

/** The view that the screen must have. */
internal fun <T : View> Activity.view(id: Int): T = checkNotNull(findViewById<T>(id)) { "no view $id" }
