package stillwater.app.screen

import android.graphics.Color
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.RobolectricTestRunner
import org.robolectric.RuntimeEnvironment
import org.robolectric.annotation.Config
import stillwater.app.R
import kotlin.test.assertTrue

/** Text that is read in the sun: 7 to 1, the "enhanced" contrast of WCAG 2.1, section 1.4.6. */
@RunWith(RobolectricTestRunner::class)
class ContrastTest {
    private val pairs =
        listOf(R.color.text, R.color.quiet_text, R.color.good, R.color.bad).map { it to R.color.ground } +
            listOf(R.color.stop_text to R.color.stop, R.color.text to R.color.button)

    @Test
    fun byDay() = check()

    @Test
    @Config(qualifiers = "night")
    fun atNight() = check()

    private fun check() {
        val context = RuntimeEnvironment.getApplication()
        for ((text, ground) in pairs) {
            val (a, b) = listOf(text, ground).map { Color.luminance(context.getColor(it)) + GLARE }
            val contrast = maxOf(a, b) / minOf(a, b)
            assertTrue(contrast >= 7f, "${context.resources.getResourceEntryName(text)}: $contrast to 1")
        }
    }

    private companion object {
        /** What the definition adds for light that the screen reflects. */
        const val GLARE = 0.05f
    }
}
