package stillwater.app.screen

import android.graphics.Color
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.RobolectricTestRunner
import org.robolectric.RuntimeEnvironment
import org.robolectric.annotation.Config
import stillwater.app.R
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

    private fun check() {
        check(pairs, ENHANCED)
        // What cannot be pressed now is asked for less by the same paper, and is still to be read.
        check(listOf(R.color.disabled_text to R.color.button), LEAST)
    }

    private fun check(pairs: List<Pair<Int, Int>>, least: Float) {
        val context = RuntimeEnvironment.getApplication()
        for ((text, ground) in pairs) {
            val (a, b) = listOf(text, ground).map { Color.luminance(context.getColor(it)) + GLARE }
            val contrast = maxOf(a, b) / minOf(a, b)
            assertTrue(contrast >= least, "${context.resources.getResourceEntryName(text)}: $contrast to 1")
        }
    }

    private companion object {
        /** What the definition adds for light that the screen reflects. */
        const val GLARE = 0.05f
        const val ENHANCED = 7f
        const val LEAST = 4.5f
    }
}
