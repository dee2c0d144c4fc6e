package stillwater.app.screen

import android.graphics.Bitmap
import android.graphics.BitmapFactory
import android.graphics.Canvas
import android.graphics.Color
import android.view.View
import org.junit.Assert.assertTrue
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.Robolectric
import org.robolectric.RobolectricTestRunner
import org.robolectric.annotation.Config
import org.robolectric.annotation.GraphicsMode
import stillwater.app.R
import stillwater.app.link.BoardReport
import stillwater.app.link.LinkHealth
import stillwater.app.link.LinkState
import stillwater.app.pose.PhoneFix
import stillwater.app.service.BoatActivity
import stillwater.app.service.BoatSnapshot
import stillwater.app.service.PreflightCheck
import stillwater.app.service.PreflightItem
import stillwater.model.LatLon
import stillwater.wire.BoardState
import java.io.File
import kotlin.math.abs

/**
 * The pictures in docs/screenshots are what the app draws. A difference fails and leaves the new picture in
 * target/screenshots, for a person to look at and copy.
 */
@RunWith(RobolectricTestRunner::class)
@GraphicsMode(GraphicsMode.Mode.NATIVE)
@Config(sdk = [35], qualifiers = "w411dp-h731dp-port-notnight-xhdpi")
class ScreenshotTest {
    @Test
    fun map() = compare("map", mapScreen())

    @Test
    @Config(qualifiers = "+night")
    fun mapAtNight() = compare("map-night", mapScreen())

    @Test
    fun emptyMap() = compare("map-empty", activity().window.decorView)

    @Test
    fun link() = compare("link", linkScreen(running))

    @Test
    @Config(qualifiers = "+night")
    fun lostLinkAtNight() = compare("link-lost-night", linkScreen(lost))

    private fun activity() = Robolectric.buildActivity(MainActivity::class.java).setup().get()

    private fun mapScreen(): View {
        val activity = activity()
        val map = activity.view<MapView>(R.id.map)
        val scene = Scenes.halfSurveyed()
        map.scene = scene
        val projection =
            MapProjection(scene.extent(), map.width.toFloat(), map.height.toFloat(), 28 * density(activity))
        val cell = checkNotNull(scene.map).grid.center(TAPPED)
        map.tap(projection.x(cell), projection.y(cell))
        return activity.window.decorView
    }

    private fun linkScreen(snapshot: BoatSnapshot): View {
        val activity = activity()
        activity.view<View>(R.id.tab_link).performClick()
        var screen: View = activity.view(R.id.state)
        while (screen !is LinkScreen) screen = screen.parent as View
        screen.show(snapshot, refusedForGood = false)
        return activity.window.decorView
    }

    private fun density(activity: MainActivity) = activity.resources.displayMetrics.density

    private fun compare(name: String, view: View) {
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
        const val TAPPED = 70
        const val PERCENT = 100

        /** Steps of 256: rounding of edges and blending, which other machines do otherwise. */
        const val NOT_SEEN = 24

        /** A letter of the large type is about as much of the picture: a changed word is found. */
        const val MOST_DIFFERING = 5e-4

        val running =
            BoatSnapshot(
                activity = BoatActivity.STANDING_BY,
                linkName = "Boat 3",
                link =
                LinkHealth(LinkState.CONNECTED, 2, 1, 3, 48_213, 10_480, 0, 4, 87, "read failed, socket might closed"),
                board = BoardReport(5_210, 3, 0, BoardState.STANDBY, 15.26, oxygen = 8.71, celsius = 19.4),
                fix = PhoneFix(LatLon(45.33, -73.15), 3.2f, 0.9f, 12f, 0),
                fixAgeSeconds = 0.4,
                headingDeg = 12f,
                preflight = PreflightCheck.entries.map { PreflightItem(it, it != PreflightCheck.BATTERY_SAVER) },
            )
        val lost =
            running.copy(
                activity = BoatActivity.RECOVERED,
                board = BoardReport(),
                link = running.link.copy(state = LinkState.WAITING, drops = 2, quietMillis = null),
                fixAgeSeconds = 41.0,
                preflight =
                PreflightCheck.entries.map { PreflightItem(it, it !in setOf(PreflightCheck.LINK, PreflightCheck.FIX)) },
            )
    }
}
