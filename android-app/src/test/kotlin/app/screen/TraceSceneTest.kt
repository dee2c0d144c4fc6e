package stillwater.app.screen

import org.junit.Test
import org.junit.runner.RunWith
import org.robolectric.RobolectricTestRunner
import stillwater.model.Grid
import kotlin.test.assertEquals

@RunWith(RobolectricTestRunner::class)
class TraceSceneTest {
    /** Two cells, a way outside of the map, and the first cell again. */
    @Test
    fun eachCrossingOfACellHasWhatWasKnownAtItsEnd() {
        val moments =
            listOf(3 to 0.0, 3 to 1.0, 3 to 2.0, 4 to 0.5, Grid.OUTSIDE to Double.NaN, 3 to 2.5, 3 to 2.75)
                .mapIndexed { second, (cell, lower) ->
                    TraceMoment(second.toDouble(), 7.0 + second, 0.1, cell, lower + 1, lower, lower + 2)
                }
        val settled = TraceScene(moments).settled
        val expected = listOf(2.0, 2.0, 2.0, 0.5, Double.NaN, 2.75, 2.75)
        assertEquals(expected, settled.map { it.lower })
        assertEquals(expected.map { it + 1 }, settled.map { it.corrected })
        assertEquals(expected.map { it + 2 }, settled.map { it.upper })
        assertEquals(moments.map { it.seconds to it.reading }, settled.map { it.seconds to it.reading }, "as said")
        assertEquals(emptyList(), TraceScene().settled)
    }
}
