package stillwater.app.screen

import android.graphics.Bitmap
import android.graphics.Canvas
import android.view.View
import android.widget.ScrollView
import android.widget.TextView
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.RobolectricTestRunner
import org.robolectric.annotation.Config
import org.robolectric.annotation.GraphicsMode
import stillwater.app.R
import stillwater.app.service.BoatSnapshot
import stillwater.app.service.Gaps
import stillwater.mission.MissionDraft
import java.io.File
import kotlin.test.assertEquals

/**
 * With type of twice the size, the largest that Android offers: STOP is whole on every screen, and no word is cut off
 * or broken. The pictures are left in target/large-type, to be looked at.
 */
@RunWith(RobolectricTestRunner::class)
@GraphicsMode(GraphicsMode.Mode.NATIVE)
@Config(sdk = [35])
class LargeTypeTest {
    private val wrong = mutableListOf<String>()

    @Test
    @Config(qualifiers = "w411dp-h731dp-port-notnight-xhdpi", fontScale = 2f)
    fun twiceAsLarge() = everyScreen("twice")

    @Test
    @Config(qualifiers = "w731dp-h411dp-land-notnight-xhdpi", fontScale = 2f)
    fun twiceAsLargeLying() = everyScreen("lying")

    @Test
    @Config(qualifiers = "w320dp-h533dp-port-notnight-xhdpi", fontScale = 2f)
    fun twiceAsLargeOnANarrowPhone() = everyScreen("narrow")

    @Test
    @Config(qualifiers = "w320dp-h533dp-port-notnight-xhdpi", fontScale = 1.3f)
    fun largerOnANarrowPhone() = everyScreen("small")

    private fun everyScreen(name: String) {
        val window = Window()
        val shots =
            listOf(
                ScreenName.MAP to Scenes.surveying,
                ScreenName.TRACE to Scenes.surveying,
                ScreenName.START to Scenes.recovered,
                ScreenName.MISSION to Scenes.standingBy,
                ScreenName.AREA to Scenes.standingBy,
                ScreenName.LINK to Scenes.surveying.copy(gaps = Gaps(2, 31.0)),
                ScreenName.PAST to Scenes.standingBy.copy(past = Scenes.past),
                ScreenName.MENU to Scenes.recovered,
            )
        for ((screen, snapshot) in shots) look(window, "$name-${screen.name.lowercase()}", screen, snapshot)
        assertEquals(emptyList(), wrong)
    }

    private fun look(window: Window, name: String, screen: ScreenName, snapshot: BoatSnapshot) {
        val activity = window.activity
        if (screen == ScreenName.AREA) {
            activity.desk.change { MissionDraft.of(Scenes.spec) }
            activity.open(ScreenName.AREA)
        } else {
            activity.go(screen)
        }
        window.settle()
        activity.show(snapshot)
        val root = activity.window.decorView
        val size = root.resources.displayMetrics
        root.measure(exactly(size.widthPixels), exactly(size.heightPixels))
        root.layout(0, 0, size.widthPixels, size.heightPixels)
        draw(root, name)
        val stop = activity.view<TextView>(R.id.stop)
        val place = IntArray(2).also(stop::getLocationInWindow)
        if (place[1] + stop.height > size.heightPixels || place[0] + stop.width > size.widthPixels) {
            wrong += "$name: STOP ends at ${place[0] + stop.width}, ${place[1] + stop.height}"
        }
        for (view in activity.shown().filterIsInstance<TextView>()) {
            cut(view)?.let { wrong += "$name: '${view.text}' $it" }
        }
        for (drawn in activity.shown().filter { it is WaterView || it is TraceView }) {
            val height = drawn.height / size.density
            if (height < LEAST_DRAWN) wrong += "$name: ${drawn.javaClass.simpleName} is $height dp high"
        }
    }

    /** What is not to be seen of [view]'s words; null where all is. */
    private fun cut(view: TextView): String? {
        val layout = view.layout ?: return null
        val room = view.height - view.compoundPaddingTop - view.compoundPaddingBottom
        if (layout.height > room) return "needs ${layout.height} of $room"
        for (line in 0 until layout.lineCount) {
            if (layout.getEllipsisCount(line) > 0) return "ends with dots"
            val end = layout.getLineEnd(line)
            // A file's name is longer than any line.
            val isBroken = end in 1..<view.text.length && ".log" !in view.text &&
                view.text[end].isLetterOrDigit() && view.text[end - 1].isLetterOrDigit()
            if (isBroken) return "is broken after '${view.text.substring(layout.getLineStart(line), end)}'"
        }
        val parent = view.parent as? View ?: return null
        val isBeyond = parent !is ScrollView && (view.bottom > parent.height || view.right > parent.width)
        return if (isBeyond) "ends at ${view.right}, ${view.bottom} of ${parent.width}, ${parent.height}" else null
    }

    private fun draw(root: View, name: String) {
        val drawn = Bitmap.createBitmap(root.width, root.height, Bitmap.Config.ARGB_8888)
        root.draw(Canvas(drawn))
        val file = File("target/large-type/$name.png")
        file.absoluteFile.parentFile.mkdirs()
        file.outputStream().use { drawn.compress(Bitmap.CompressFormat.PNG, 100, it) }
    }

    private fun exactly(size: Int) = View.MeasureSpec.makeMeasureSpec(size, View.MeasureSpec.EXACTLY)

    private companion object {
        /** A finger's breadth and a half, dp. */
        const val LEAST_DRAWN = 80
    }
}
