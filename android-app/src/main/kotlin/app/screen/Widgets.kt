package stillwater.app.screen

import android.content.Context
import android.content.res.ColorStateList
import android.graphics.Typeface
import android.util.TypedValue
import android.view.View
import android.view.ViewGroup
import android.widget.Button
import android.widget.LinearLayout
import android.widget.TextView
import stillwater.app.R

/** A line of text in the app's large type. */
internal fun Context.line(text: CharSequence, colour: Int = R.color.text): TextView =
    TextView(this).apply {
        this.text = text
        setTextColor(context.getColor(colour))
        setTextSize(TypedValue.COMPLEX_UNIT_PX, resources.getDimension(R.dimen.text))
    }

/** A line that begins a part of a screen; talk-back can jump to it where the platform knows headings. */
internal fun Context.heading(text: CharSequence): TextView =
    line(text).apply {
        typeface = Typeface.DEFAULT_BOLD
        setPadding(0, resources.getDimensionPixelSize(R.dimen.gap), 0, 0)
    }

/** A button large enough for a wet glove. */
internal fun Context.largeButton(text: CharSequence, action: () -> Unit): Button =
    Button(this).apply {
        this.text = text
        isAllCaps = false
        minimumHeight = resources.getDimensionPixelSize(R.dimen.button_height)
        setTextSize(TypedValue.COMPLEX_UNIT_PX, resources.getDimension(R.dimen.text))
        setTextColor(context.getColor(R.color.text))
        backgroundTintList = ColorStateList.valueOf(context.getColor(R.color.button))
        setOnClickListener { action() }
    }

/** The button that is on every screen. */
internal fun Context.stopButton(action: () -> Unit): Button =
    largeButton(getString(R.string.stop), action).apply {
        id = R.id.stop
        contentDescription = context.getString(R.string.stop_said)
        minimumHeight = resources.getDimensionPixelSize(R.dimen.stop_height)
        typeface = Typeface.DEFAULT_BOLD
        setTextSize(TypedValue.COMPLEX_UNIT_PX, resources.getDimension(R.dimen.stop_text))
        setTextColor(context.getColor(R.color.stop_text))
        backgroundTintList = ColorStateList.valueOf(context.getColor(R.color.stop))
    }

/** Adds [view] below what is there, as wide as it can be. */
internal fun LinearLayout.below(view: View, weight: Float = 0f) {
    val height = if (weight > 0) 0 else ViewGroup.LayoutParams.WRAP_CONTENT
    addView(view, LinearLayout.LayoutParams(ViewGroup.LayoutParams.MATCH_PARENT, height, weight))
}
