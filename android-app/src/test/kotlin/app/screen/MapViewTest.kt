package stillwater.app.screen

import android.view.MotionEvent
import android.view.View
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.RobolectricTestRunner
import org.robolectric.RuntimeEnvironment
import org.robolectric.annotation.Config
import stillwater.model.Position
import kotlin.test.assertEquals
import kotlin.test.assertNull
import kotlin.test.assertTrue

@RunWith(RobolectricTestRunner::class)
@Config(sdk = [26, 35])
class MapViewTest {
    private val map =
        MapView(RuntimeEnvironment.getApplication()).apply {
            measure(exactly(400), exactly(600))
            layout(0, 0, 400, 600)
        }

    @Test
    fun whatIsTappedIsSaid() {
        val scene = Scenes.halfSurveyed()
        map.scene = scene
        val said = mutableListOf<String>()
        map.onCell = said::add
        val projection = MapProjection(scene.extent(), 400f, 600f, 28f)
        val field = scene.map!!
        val measured = field.grid.center(25)
        map.touch(projection.x(measured), projection.y(measured))
        val expected =
            "%.3f mg/L, between %.3f and %.3f; 10 readings".format(field.value(25), field.lower(25), field.upper(25))
        assertEquals(listOf(expected), said)
        val unmeasured = field.grid.center(field.grid.size - 1)
        assertEquals(
            "Not measured; between 4.000 and 12.000 mg/L",
            map.tap(projection.x(unmeasured), projection.y(unmeasured)),
        )
        assertNull(map.tap(1f, 1f), "no cell there")
    }

    @Test
    fun itSaysWhatItShows() {
        assertEquals("Map, empty: no position and no map yet", map.contentDescription)
        map.scene = Scenes.halfSurveyed()
        assertEquals("Map: 140 of 240 cells measured. Tap a cell for its bounds.", map.contentDescription)
    }

    @Test
    fun northIsUpAndBothAxesHaveOneScale() {
        val projection = MapProjection(listOf(Position(0.0, 0.0), Position(100.0, 50.0)), 400f, 600f, 20f)
        val middle = Position(50.0, 25.0)
        assertEquals(200f, projection.x(middle), 1e-3f) // px; single precision of numbers below 1000
        assertEquals(300f, projection.y(middle), 1e-3f)
        assertEquals(3.6f, projection.scale, 1e-6f)
        assertTrue(projection.y(Position(50.0, 30.0)) < projection.y(middle))
        val back = projection.position(projection.x(Position(12.0, 34.0)), projection.y(Position(12.0, 34.0)))
        assertEquals(12.0, back.x, 1e-3) // m; a thousandth of a pixel is less
        assertEquals(34.0, back.y, 1e-3)
    }

    @Test
    fun aBoatThatHasNotMovedIsInSight() {
        val projection = MapProjection(listOf(Position(7.0, 7.0)), 400f, 600f, 20f)
        assertTrue(projection.scale.isFinite() && projection.scale > 0)
    }

    private fun MapView.touch(x: Float, y: Float) {
        val up = MotionEvent.obtain(0, 0, MotionEvent.ACTION_UP, x, y, 0)
        dispatchTouchEvent(up)
        up.recycle()
    }

    private fun exactly(size: Int) = View.MeasureSpec.makeMeasureSpec(size, View.MeasureSpec.EXACTLY)
}
