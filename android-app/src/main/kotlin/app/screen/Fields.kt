package stillwater.app.screen

import android.content.Context
import android.text.Editable
import android.text.InputType
import android.text.TextWatcher
import android.text.method.DigitsKeyListener
import android.util.TypedValue
import android.view.View
import android.view.inputmethod.EditorInfo
import android.widget.Button
import android.widget.EditText
import android.widget.LinearLayout
import stillwater.app.R

/** A column of a form: what is asked, then what was answered, then what is wrong with it. */
internal open class FieldColumn(context: Context, protected val name: String) : LinearLayout(context) {
    private val wrong = context.liveLine().apply { setTextColor(context.getColor(R.color.bad)) }

    init {
        orientation = VERTICAL
        setPadding(0, 0, 0, resources.getDimensionPixelSize(R.dimen.gap))
    }

    /** The problem's line, for the end of the column. */
    protected fun addProblemLine() = below(wrong)

    /** Says what is wrong; null where nothing is. */
    fun problem(words: String?) = wrong.say(words?.let { context.getString(R.string.problem, it) })
}

/**
 * A text or a number to type.
 *
 * @param id of what is typed into.
 * @param onText called with every change that a person makes.
 */
internal class TextField(
    context: Context,
    name: String,
    isNumber: Boolean,
    id: Int = View.generateViewId(),
    private val onText: (String) -> Unit,
) : FieldColumn(context, name) {
    private var isFilling = false
    val edit =
        EditText(context).apply {
            this.id = id
            inputType = InputType.TYPE_CLASS_TEXT or InputType.TYPE_TEXT_FLAG_CAP_SENTENCES
            if (isNumber) {
                // Android's own listener for numbers takes no comma, and some keyboards have nothing else.
                keyListener = DigitsKeyListener.getInstance("0123456789.,-+")
                setRawInputType(NUMBER)
            }
            // A keyboard that took the whole screen would hide STOP.
            imeOptions = EditorInfo.IME_ACTION_DONE or EditorInfo.IME_FLAG_NO_EXTRACT_UI or
                EditorInfo.IME_FLAG_NO_FULLSCREEN
            minimumHeight = resources.getDimensionPixelSize(R.dimen.button_height)
            setTextSize(TypedValue.COMPLEX_UNIT_PX, resources.getDimension(R.dimen.text))
            // What was typed is the draft's to keep.
            isSaveEnabled = false
            addTextChangedListener(
                object : TextWatcher {
                    override fun beforeTextChanged(s: CharSequence?, start: Int, count: Int, after: Int) = Unit

                    override fun onTextChanged(s: CharSequence?, start: Int, before: Int, count: Int) = Unit

                    override fun afterTextChanged(s: Editable?) {
                        if (!isFilling) onText(s?.toString().orEmpty())
                    }
                },
            )
        }

    private val label = context.line(name).apply { labelFor = edit.id }

    init {
        below(label)
        below(edit)
        addProblemLine()
    }

    /** Asks for [name] from now on. */
    fun rename(name: String) = label.say(name)

    /** Fills in [text], which is not taken for typed. */
    fun fill(text: String) {
        if (edit.text.toString() == text) return
        isFilling = true
        edit.setText(text)
        isFilling = false
    }

    private companion object {
        const val NUMBER =
            InputType.TYPE_CLASS_NUMBER or InputType.TYPE_NUMBER_FLAG_DECIMAL or InputType.TYPE_NUMBER_FLAG_SIGNED
    }
}

/**
 * One of several to choose: a button that says what is chosen, and under it, once pressed, the others. No dialog, for
 * that would cover STOP.
 *
 * @param options each with its words.
 */
internal class ChoiceField<T>(
    context: Context,
    name: String,
    private val options: List<Pair<T, String>>,
    private val onChoice: (T) -> Unit,
) : FieldColumn(context, name) {
    private val button: Button = context.largeButton(name) { list.show(list.visibility != VISIBLE) }
    private val list = context.column().apply { visibility = GONE }

    init {
        below(button)
        for ((option, words) in options) {
            list.below(
                context.largeButton(words) {
                    list.show(false)
                    onChoice(option)
                },
            )
        }
        below(list)
        addProblemLine()
    }

    /** Shows that [option] is chosen. */
    fun fill(option: T) {
        val index = options.indexOfFirst { it.first == option }
        val words = options.getOrNull(index)?.second.orEmpty()
        button.say(context.getString(R.string.choice, name, words))
        button.contentDescription = context.getString(R.string.choice_said, name, words)
        for (each in 0 until list.childCount) list.getChildAt(each).isSelected = each == index
    }
}
