package stillwater.app.screen

import android.graphics.Bitmap
import android.graphics.BitmapFactory
import android.graphics.Canvas
import android.graphics.Color
import android.view.View
import android.widget.Button
import org.junit.Assert.assertTrue
import org.junit.Before
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.RobolectricTestRunner
import org.robolectric.annotation.Config
import org.robolectric.annotation.GraphicsMode
import stillwater.app.R
import stillwater.app.service.BoatSnapshot
import stillwater.mission.MissionDraft
import java.io.File
import java.util.TimeZone
import kotlin.math.abs

/**
 * The pictures in docs/screenshots are what the app draws. A difference fails and leaves the new picture in
 * target/screenshots, for a person to look at and copy.
 */
@RunWith(RobolectricTestRunner::class)
@GraphicsMode(GraphicsMode.Mode.NATIVE)
@Config(sdk = [35], qualifiers = "w411dp-h731dp-port-notnight-xhdpi")
class ScreenshotTest {
    /** Dates are the reader's own; in the pictures they are Greenwich's. */
    @Before
    fun atGreenwich() = TimeZone.setDefault(TimeZone.getTimeZone("UTC"))

    @Test
    fun map() = compare("map", mapScreen())

    @Test
    @Config(qualifiers = "+night")
    fun mapAtNight() = compare("map-night", mapScreen())

    @Test
    @Config(qualifiers = "w731dp-h411dp-land")
    fun mapLying() = compare("map-lying", mapScreen())

    @Test
    fun emptyMap() = compare("map-empty", screen(ScreenName.MAP, BoatSnapshot()))

    @Test
    fun trace() = compare("trace", screen(ScreenName.TRACE, Scenes.surveying))

    @Test
    @Config(qualifiers = "+night")
    fun traceAtNight() = compare("trace-night", screen(ScreenName.TRACE, Scenes.surveying))

    @Test
    fun start() = compare("start", screen(ScreenName.START, Scenes.loaded))

    @Test
    @Config(qualifiers = "+night")
    fun startAfterAnInterruption() = compare("start-recovered-night", screen(ScreenName.START, Scenes.recovered))

    @Test
    fun mission() = compare("mission", screen(ScreenName.MISSION, Scenes.standingBy))

    @Test
    fun area() = compare("area", areaScreen())

    @Test
    fun link() = compare("link", screen(ScreenName.LINK, Scenes.surveying))

    @Test
    @Config(qualifiers = "+night")
    fun lostLinkAtNight() = compare("link-lost-night", screen(ScreenName.LINK, Scenes.recovered))

    @Test
    fun past() = compare("past", pastScreen())

    @Test
    fun menu() = compare("menu", screen(ScreenName.MENU, Scenes.surveying))

    // The smallest phone that is still sold, with the type of people who forget their glasses.

    @Test
    @Config(qualifiers = SMALL, fontScale = LARGE)
    fun smallMap() = compare("small-map", mapScreen())

    @Test
    @Config(qualifiers = SMALL, fontScale = LARGE)
    fun smallStart() = compare("small-start", screen(ScreenName.START, Scenes.recovered))

    @Test
    @Config(qualifiers = SMALL, fontScale = LARGE)
    fun smallMission() = compare("small-mission", screen(ScreenName.MISSION, Scenes.standingBy))

    @Test
    @Config(qualifiers = SMALL, fontScale = LARGE)
    fun smallArea() = compare("small-area", areaScreen())

    @Test
    @Config(qualifiers = SMALL, fontScale = LARGE)
    fun smallTrace() = compare("small-trace", screen(ScreenName.TRACE, Scenes.surveying))

    @Test
    @Config(qualifiers = SMALL, fontScale = LARGE)
    fun smallPast() = compare("small-past", pastScreen())

    /** [name], opened by the menu and filled by [before], with [snapshot] to show. */
    private fun screen(name: ScreenName, snapshot: BoatSnapshot, before: Window.() -> Unit = {}): Window =
        Window().apply {
            if (name != ScreenName.MAP) activity.go(name)
            before()
            settle()
            activity.show(snapshot)
        }

    private fun mapScreen() =
        screen(ScreenName.MAP, Scenes.surveying).apply {
            activity.view<MapView>(R.id.map).tap(Scenes.spec.grid.grid().center(TAPPED))
        }

    private fun areaScreen() =
        screen(ScreenName.MISSION, Scenes.standingBy) {
            activity.desk.change { MissionDraft.of(Scenes.spec) }
            activity.view<View>(R.id.draw_area).performClick()
        }

    private fun pastScreen() =
        screen(ScreenName.PAST, Scenes.standingBy.copy(past = Scenes.past)).apply {
            activity.shown().filterIsInstance<Button>().first { "CUT\u00A0OFF" in it.text }.performClick()
        }

    private fun compare(name: String, window: Window) {
        val view = window.activity.window.decorView
        val size = view.context.resources.displayMetrics
        view.measure(exactly(size.widthPixels), exactly(size.heightPixels))
        view.layout(0, 0, size.widthPixels, size.heightPixels)
        val drawn = Bitmap.createBitmap(view.width, view.height, Bitmap.Config.ARGB_8888)
        view.draw(Canvas(drawn))
        val kept = File("../docs/screenshots/$name.png")
        val fresh = File("target/screenshots/$name.png")
        write(drawn, fresh)
        assertTrue("$kept is missing; $fresh is what it would be", kept.isFile)
        // By its bytes: Robolectric reads a file through a field of Java's that the module system closes.
        val before = kept.readBytes().let { BitmapFactory.decodeByteArray(it, 0, it.size) }
        assertTrue(
            "$kept is ${before.width} x ${before.height}, $fresh ${drawn.width} x ${drawn.height}",
            before.width == drawn.width && before.height == drawn.height,
        )
        val share = differing(before, drawn)
        assertTrue("$fresh differs from $kept in ${PERCENT * share} % of its pixels", share <= MOST_DIFFERING)
    }

    private fun differing(a: Bitmap, b: Bitmap): Double {
        val (ofA, ofB) = pixels(a) to pixels(b)
        return ofA.indices.count { distance(ofA[it], ofB[it]) > NOT_SEEN } / ofA.size.toDouble()
    }

    private fun pixels(bitmap: Bitmap) =
        IntArray(bitmap.width * bitmap.height).also {
            bitmap.getPixels(it, 0, bitmap.width, 0, 0, bitmap.width, bitmap.height)
        }

    private fun distance(a: Int, b: Int) =
        maxOf(
            abs(Color.red(a) - Color.red(b)),
            abs(Color.green(a) - Color.green(b)),
            abs(Color.blue(a) - Color.blue(b)),
        )

    private fun write(bitmap: Bitmap, file: File) {
        file.absoluteFile.parentFile.mkdirs()
        file.outputStream().use { bitmap.compress(Bitmap.CompressFormat.PNG, PERCENT, it) }
    }

    private fun exactly(size: Int) = View.MeasureSpec.makeMeasureSpec(size, View.MeasureSpec.EXACTLY)

    private companion object {
        const val SMALL = "w320dp-h533dp-port-notnight-xhdpi"
        const val LARGE = 1.3f
        const val TAPPED = 70
        const val PERCENT = 100

        /** Steps of 256: rounding of edges and blending, which other machines do otherwise. */
        const val NOT_SEEN = 24

        /** A letter of the large type is about as much of the picture: a changed word is found. */
        const val MOST_DIFFERING = 5e-4
    }
}
