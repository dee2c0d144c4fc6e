package stillwater.app.screen

import android.content.Context
import android.content.res.ColorStateList
import android.graphics.Typeface
import android.os.Build
import android.text.SpannableString
import android.text.Spanned
import android.text.style.AbsoluteSizeSpan
import android.util.TypedValue
import android.view.View
import android.view.ViewGroup
import android.widget.Button
import android.widget.LinearLayout
import android.widget.ScrollView
import android.widget.TextView
import stillwater.app.AboveMinSdk
import stillwater.app.R
import kotlin.math.roundToInt

/** A line of text in the app's large type. */
internal fun Context.line(text: CharSequence, colour: Int = R.color.text): TextView =
    TextView(this).apply {
        this.text = text
        setTextColor(context.getColor(colour))
        setTextSize(TypedValue.COMPLEX_UNIT_PX, resources.getDimension(R.dimen.text))
    }

/** A line that talk-back says whenever it changes. */
internal fun Context.liveLine(text: CharSequence = ""): TextView =
    line(text).apply {
        accessibilityLiveRegion = View.ACCESSIBILITY_LIVE_REGION_POLITE
        show(text.isNotEmpty())
    }

/** [title], and below it in smaller type what it is [about]. */
internal fun Context.titled(title: String, about: String): CharSequence =
    SpannableString("$title\n$about").apply {
        val size = resources.getDimensionPixelSize(R.dimen.map_text)
        setSpan(AbsoluteSizeSpan(size), title.length, length, Spanned.SPAN_EXCLUSIVE_EXCLUSIVE)
    }

/** A line that begins a part of a screen; talk-back can jump to it where the platform knows headings. */
internal fun Context.heading(text: CharSequence): TextView =
    line(text).apply {
        typeface = Typeface.DEFAULT_BOLD
        setPadding(0, resources.getDimensionPixelSize(R.dimen.gap), 0, 0)
        if (Build.VERSION.SDK_INT >= Build.VERSION_CODES.P) asHeading(this)
    }

@AboveMinSdk
private fun asHeading(view: View) {
    view.isAccessibilityHeading = true
}

/** A button large enough for a wet glove. */
internal fun Context.largeButton(text: CharSequence, action: () -> Unit): Button =
    Button(this).apply {
        this.text = text
        isAllCaps = false
        minimumHeight = resources.getDimensionPixelSize(R.dimen.button_height)
        setTextSize(TypedValue.COMPLEX_UNIT_PX, resources.getDimension(R.dimen.text))
        backgroundTintList =
            ColorStateList(
                arrayOf(intArrayOf(android.R.attr.state_selected), intArrayOf()),
                intArrayOf(context.getColor(R.color.text), context.getColor(R.color.button)),
            )
        // What cannot be pressed now stays readable, and is seen by its grey.
        setTextColor(
            ColorStateList(
                arrayOf(
                    intArrayOf(-android.R.attr.state_enabled),
                    intArrayOf(android.R.attr.state_selected),
                    intArrayOf(),
                ),
                intArrayOf(
                    context.getColor(R.color.disabled_text),
                    context.getColor(R.color.ground),
                    context.getColor(R.color.text),
                ),
            ),
        )
        setOnClickListener { action() }
    }

/** A button beside several others on every width: its few letters grow with the type, but for what finds no room. */
internal fun Context.narrowButton(text: CharSequence, action: () -> Unit): Button =
    largeButton(text, action).apply {
        val most = MOST_NARROW * resources.displayMetrics.density
        setTextSize(TypedValue.COMPLEX_UNIT_PX, minOf(resources.getDimension(R.dimen.text), most))
        setPadding(0, paddingTop, 0, paddingBottom)
    }

/** [view], which scrolls where it is higher than [share] of the screen. */
internal fun Context.lowScroll(view: View, share: Float): ScrollView =
    object : ScrollView(this) {
        override fun onMeasure(widthMeasureSpec: Int, heightMeasureSpec: Int) {
            val most = (share * resources.displayMetrics.heightPixels).toInt()
            super.onMeasure(widthMeasureSpec, MeasureSpec.makeMeasureSpec(most, MeasureSpec.AT_MOST))
        }
    }.apply { addView(view) }

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

/** A column of what [fill] puts into it, that scrolls where it is longer than the screen. */
internal fun Context.scrolling(fill: LinearLayout.() -> Unit): ScrollView =
    ScrollView(this).apply {
        val gap = resources.getDimensionPixelSize(R.dimen.gap)
        addView(
            context.column().apply {
                setPadding(gap, 0, gap, gap)
                fill()
            },
        )
    }

/** An empty column. */
internal fun Context.column(): LinearLayout = LinearLayout(this).apply { orientation = LinearLayout.VERTICAL }

/** [views] beside each other, equally wide and equally high. */
internal fun Context.row(vararg views: View): LinearLayout =
    LinearLayout(this).apply {
        isBaselineAligned = false
        for (view in views) addView(view, LinearLayout.LayoutParams(0, ViewGroup.LayoutParams.MATCH_PARENT, 1f))
    }

/** Width of the screen in the size of the usual type, dp: half of it with type twice as large. */
internal val Context.letters: Float get() = resources.configuration.run { screenWidthDp / fontScale }

/**
 * [views] beside each other, or below each other where their words would break: on a narrow phone with large type.
 *
 * @param share of the screen's width that there is for them.
 */
internal fun Context.rowIfWide(vararg views: View, share: Float = 1f): LinearLayout {
    if (share * letters >= LEAST_FOR_ROWS) return row(*views)
    return column().apply { views.forEach { below(it) } }
}

/** Adds [view] below what is there, as wide as it can be. */
internal fun LinearLayout.below(view: View, weight: Float = 0f) {
    val height = if (weight > 0) 0 else ViewGroup.LayoutParams.WRAP_CONTENT
    addView(view, LinearLayout.LayoutParams(ViewGroup.LayoutParams.MATCH_PARENT, height, weight))
}

/** Shows [words], or nothing at all where there are none; a line that says what it said before is left alone. */
internal fun TextView.say(words: CharSequence?) {
    // In sight first: talk-back does not say what changes out of sight.
    show(!words.isNullOrEmpty())
    if (text.toString() != words?.toString().orEmpty()) text = words
}

/** Makes it seen, or takes no room. */
internal fun View.show(isShown: Boolean) {
    val wanted = if (isShown) View.VISIBLE else View.GONE
    if (visibility != wanted) visibility = wanted
}

/** A time of [seconds] in the two largest units that matter. */
internal fun Context.duration(seconds: Double): String {
    val whole = if (seconds.isFinite()) seconds.toLong() else 0
    return when {
        whole < MINUTE -> getString(R.string.seconds, whole)
        whole < HOUR -> getString(R.string.minutes_seconds, whole / MINUTE, whole % MINUTE)
        else -> getString(R.string.hours_minutes, whole / HOUR, whole % HOUR / MINUTE)
    }
}

/** A way of [metres] m: in whole metres up to a kilometre, in kilometres beyond. */
internal fun Context.distance(metres: Double): String =
    if (metres < KILOMETRE) {
        getString(R.string.metres, metres.roundToInt())
    } else {
        getString(R.string.kilometres, metres / KILOMETRE)
    }

/** The unit of a change of what is measured in [unit], which may be empty. */
internal fun Context.perSecond(unit: String): String =
    if (unit.isEmpty()) getString(R.string.per_second) else getString(R.string.unit_per_second, unit)

private const val MINUTE = 60
private const val HOUR = 3600
private const val KILOMETRE = 1000.0

/** Size of the type in a quarter of a narrow screen, dp: four letters find room. */
private const val MOST_NARROW = 27f

/** Width for three buttons beside each other, dp at the usual type. */
private const val LEAST_FOR_ROWS = 300
