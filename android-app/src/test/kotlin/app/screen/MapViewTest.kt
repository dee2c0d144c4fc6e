package stillwater.app.screen

import android.graphics.Bitmap
import android.graphics.Canvas
import android.graphics.Color
import android.os.Parcelable
import android.util.SparseArray
import android.view.MotionEvent
import android.view.View
import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.RobolectricTestRunner
import org.robolectric.RuntimeEnvironment
import org.robolectric.annotation.Config
import stillwater.app.R
import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.Position
import kotlin.math.abs
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertNotNull
import kotlin.test.assertNull
import kotlin.test.assertTrue

@RunWith(RobolectricTestRunner::class)
@Config(sdk = [35])
class MapViewTest {
    private val map = mapView()

    @Test
    fun whatIsTouchedIsSaid() {
        val scene = Scenes.halfSurveyed()
        map.scene = scene
        val said = mutableListOf<String>()
        map.onCell = said::add
        val field = scene.map!!
        val (x, y) = assertNotNull(map.projection()).run { x(field.grid.center(25)) to y(field.grid.center(25)) }
        map.finger(MotionEvent.ACTION_DOWN, x, y, 0)
        map.finger(MotionEvent.ACTION_UP, x, y, 50)
        val bounds = "%.3f mg/L, at least %.3f".format(field.value(25), field.lower(25))
        assertEquals(listOf("$bounds; 10 readings; 2 min 5 s ago"), said)
        val unmeasured = field.grid.center(field.grid.size - 1)
        assertEquals("Not measured; anything from 4.000 to 12.000 mg/L", map.tap(unmeasured))
        assertNull(map.tap(Position(-500.0, 0.0)), "no cell there")
    }

    /** An end of the water's own range says nothing about a cell, and is not told as if it were measured. */
    @Test
    fun boundsAreToldAsFarAsTheyAreKnown() {
        val field = FieldMap(Grid(Position(0.0, 0.0), 4, 1, 10.0), Interval(0.0, 10.0))
        val known = listOf(2.0 to 3.0, 0.0 to 3.0, 2.0 to 10.0, 0.0 to 10.0)
        known.forEachIndexed { cell, (lower, upper) ->
            field.countReading(cell)
            field.setValue(cell, 2.5)
            field.setBounds(cell, lower, upper)
        }
        map.scene = MapScene(map = field, unit = "m")
        val said = known.indices.map { map.tap(field.grid.center(it)).orEmpty().substringAfter(", ") }
        val oneSided = listOf("at most 3.000", "at least 2.000")
        val expected = listOf("between 2.000 and 3.000") + oneSided + "anything from 0.000 to 10.000"
        assertEquals(expected.map { "$it; 1 reading" }, said)
    }

    /** Two cells of one value: the one that is known less of is nearer to the ground's colour. */
    @Test
    fun whatIsLessCertainIsFainter() {
        val grid = Grid(Position(0.0, 0.0), 3, 1, 10.0)
        val field = FieldMap(grid, Interval(0.0, 10.0))
        for ((cell, value) in listOf(0 to 8.0, 1 to 2.0, 2 to 2.0)) {
            field.countVisit(cell)
            field.countReading(cell)
            field.setValue(cell, value)
        }
        field.setBounds(1, 1.9, 2.1)
        map.scene = MapScene(map = field)
        val drawn = Bitmap.createBitmap(map.width, map.height, Bitmap.Config.ARGB_8888)
        drawn.eraseColor(Color.WHITE)
        map.draw(Canvas(drawn))
        val projection = assertNotNull(map.projection())
        val (certain, vague) = listOf(1, 2).map { cell ->
            val at = grid.center(cell)
            Color.luminance(drawn.getPixel(projection.x(at).toInt(), projection.y(at).toInt()))
        }
        assertTrue(vague > certain + 0.1f, "$certain, $vague")
    }

    @Test
    fun itSaysWhatItShows() {
        assertEquals("Map, empty: no position and no map yet", map.contentDescription)
        map.scene = Scenes.halfSurveyed()
        val givenUp = "3 cells that the boat did not get into (crosses)."
        val said = "Map: 140 of 240 cells measured. Tap a cell for its bounds."
        assertEquals("$said $givenUp", map.contentDescription)
        map.scene = MapScene(map = map.scene.map)
        assertEquals(said, map.contentDescription)
    }

    /** Edges are drawn with a little of the ground in them. */
    private fun isOfTheFence(pixel: Int): Boolean {
        val fence = map.context.getColor(R.color.fence)
        return listOf(Color::red, Color::green, Color::blue).all { abs(it(pixel) - it(fence)) <= 24 }
    }

    /** On the map and off it; of the arms of a cross, the middle is drawn over by both. */
    @Test
    fun whereTheBoatDidNotGetInIsACross() {
        val scene = Scenes.halfSurveyed()
        map.scene = scene
        val (cells, offMap) = scene.givenUp
        val grid = scene.map!!.grid
        val projection = assertNotNull(map.projection())
        val drawn = Bitmap.createBitmap(map.width, map.height, Bitmap.Config.ARGB_8888)
        map.draw(Canvas(drawn))
        for (at in cells.map(grid::center) + offMap) {
            val pixel = drawn.getPixel(projection.x(at).toInt(), projection.y(at).toInt())
            assertTrue(isOfTheFence(pixel), "$at")
        }
        val next = grid.center(cells.last() + 1)
        assertFalse(isOfTheFence(drawn.getPixel(projection.x(next).toInt(), projection.y(next).toInt())), "$next")
        assertEquals(
            "Not measured; anything from 4.000 to 12.000 mg/L; the boat did not get in",
            map.tap(grid.center(cells[0])),
        )
    }

    @Test
    fun aFingerMovesItAndWhatIsUnderTheMiddleStaysThereWhenZoomed() {
        map.scene = Scenes.halfSurveyed()
        val before = assertNotNull(map.projection())
        map.finger(MotionEvent.ACTION_DOWN, 200f, 300f, 0)
        for (step in 1..10) map.finger(MotionEvent.ACTION_MOVE, 200f + 10 * step, 300f, step * 20L)
        map.finger(MotionEvent.ACTION_UP, 300f, 300f, 220)
        val moved = assertNotNull(map.projection())
        assertTrue(moved.centre.x < before.centre.x - 0.8 * 100 / before.scale, "to the right is to the west")
        assertEquals(before.centre.y, moved.centre.y, 1e-9)
        map.zoom(2f)
        val zoomed = assertNotNull(map.projection())
        assertEquals(2 * before.scale, zoomed.scale, before.scale * 1e-6f)
        assertEquals(moved.centre.x, zoomed.centre.x, 1e-9)
        map.showAll()
        assertEquals(before.centre, assertNotNull(map.projection()).centre)
    }

    @Test
    fun itFollowsTheBoatUntilAFingerMovesIt() {
        map.scene = Scenes.halfSurveyed()
        map.zoom(4f)
        map.isFollowing = true
        assertEquals(map.scene.boat, assertNotNull(map.projection()).centre)
        map.scene = MapScene(map = map.scene.map, boat = Position(12.0, 34.0))
        assertEquals(Position(12.0, 34.0), assertNotNull(map.projection()).centre)
        var moved = 0
        map.onMoved = { moved++ }
        map.finger(MotionEvent.ACTION_DOWN, 200f, 300f, 0)
        map.finger(MotionEvent.ACTION_MOVE, 300f, 300f, 50)
        assertTrue(!map.isFollowing && moved > 0)
    }

    @Test
    fun whatIsInSightOutlivesATurnOfThePhone() {
        map.scene = Scenes.halfSurveyed()
        map.zoom(3f)
        val before = assertNotNull(map.projection())
        val state = SparseArray<Parcelable>()
        map.id = View.generateViewId()
        map.saveHierarchyState(state)
        val other = mapView().apply {
            id = map.id
            restoreHierarchyState(state)
            scene = Scenes.halfSurveyed()
        }
        val after = assertNotNull(other.projection())
        assertEquals(before.centre, after.centre)
        assertEquals(before.scale, after.scale, before.scale * 1e-6f)
    }

    @Test
    fun northIsUpAndBothAxesHaveOneScale() {
        val projection = MapProjection.fitting(listOf(Position(0.0, 0.0), Position(100.0, 50.0)), 400f, 600f, 20f)
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
        val projection = MapProjection.fitting(listOf(Position(7.0, 7.0)), 400f, 600f, 20f)
        assertTrue(projection.scale.isFinite() && projection.scale > 0)
        // A view that is smaller than its margins, as while a keyboard comes up.
        assertTrue(MapProjection.fitting(listOf(Position(7.0, 7.0)), 30f, 10f, 20f).scale > 0)
    }

    private fun MapView.finger(action: Int, x: Float, y: Float, millis: Long) {
        val event = MotionEvent.obtain(0, millis, action, x, y, 0)
        dispatchTouchEvent(event)
        event.recycle()
    }

    private fun mapView() =
        MapView(RuntimeEnvironment.getApplication()).apply {
            measure(exactly(400), exactly(600))
            layout(0, 0, 400, 600)
        }

    private fun exactly(size: Int) = View.MeasureSpec.makeMeasureSpec(size, View.MeasureSpec.EXACTLY)
}
