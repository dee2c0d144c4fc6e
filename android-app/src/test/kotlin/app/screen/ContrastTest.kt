package stillwater.app.screen

import android.graphics.Color
import android.widget.Button
import android.widget.TextView
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.RobolectricTestRunner
import org.robolectric.RuntimeEnvironment
import org.robolectric.annotation.Config
import stillwater.app.R
import stillwater.app.service.BoatSnapshot
import kotlin.test.assertTrue

/** Text, and lines on the map, that are read in the sun: 7 to 1, the "enhanced" contrast of WCAG 2.1, section 1.4.6. */
@RunWith(RobolectricTestRunner::class)
class ContrastTest {
    private val pairs =
        listOf(R.color.text, R.color.quiet_text, R.color.good, R.color.bad).map { it to R.color.ground } +
            listOf(R.color.plan, R.color.fence, R.color.track, R.color.boat).map { it to R.color.ground } +
            listOf(R.color.stop_text to R.color.stop, R.color.text to R.color.button) +
            listOf(R.color.ground to R.color.text, R.color.text to R.color.band)

    @Test
    fun byDay() = check()

    @Test
    @Config(qualifiers = "night")
    fun atNight() = check()

    /** What is really on the screens, whether or not its colours are in the lists above. */
    @Test
    fun everyWordOnEveryScreenByDay() = readEveryScreen()

    @Test
    @Config(qualifiers = "night")
    fun everyWordOnEveryScreenAtNight() = readEveryScreen()

    private fun readEveryScreen() {
        val activity = Window().activity
        val ground = activity.getColor(R.color.ground)
        var read = 0
        for (name in ScreenName.entries) {
            activity.open(name)
            for (snapshot in listOf(BoatSnapshot(), Scenes.loaded, Scenes.recovered, Scenes.surveying)) {
                activity.show(snapshot)
                for (view in activity.shown().filterIsInstance<TextView>().filter { it.text.isNotBlank() }) {
                    val tint = view.backgroundTintList.takeIf { view is Button }
                    val behind = tint?.getColorForState(view.drawableState, ground) ?: ground
                    val least = if (view.isEnabled) ENHANCED else LEAST
                    val contrast = contrast(view.currentTextColor, behind)
                    assertTrue(contrast >= least, "$name, ${view.text}: $contrast to 1")
                    read++
                }
            }
        }
        assertTrue(read > 200, "$read words")
    }

    private fun check() {
        check(pairs, ENHANCED)
        // What cannot be pressed now is asked for less by the same paper, and is still to be read.
        check(listOf(R.color.disabled_text to R.color.button), LEAST)
        // Grids and curves, section 1.4.11.
        check(listOf(R.color.line to R.color.ground, R.color.plan to R.color.band), LEAST_OF_LINES)
    }

    private fun check(pairs: List<Pair<Int, Int>>, least: Float) {
        val context = RuntimeEnvironment.getApplication()
        for ((text, ground) in pairs) {
            val contrast = contrast(context.getColor(text), context.getColor(ground))
            assertTrue(contrast >= least, "${context.resources.getResourceEntryName(text)}: $contrast to 1")
        }
    }

    private fun contrast(text: Int, ground: Int): Float {
        val (a, b) = listOf(text, ground).map { Color.luminance(it) + GLARE }
        return maxOf(a, b) / minOf(a, b)
    }

    private companion object {
        /** What the definition adds for light that the screen reflects. */
        const val GLARE = 0.05f
        const val ENHANCED = 7f
        const val LEAST = 4.5f
        const val LEAST_OF_LINES = 3f
    }
}
