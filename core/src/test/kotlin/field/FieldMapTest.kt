package stillwater.field

import org.junit.jupiter.api.Test
import stillwater.model.Grid
import stillwater.model.Interval
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertSame
import kotlin.test.assertTrue

class FieldMapTest {
    private val grid = Grid.unit(3, 2)
    private val prior = Interval(75.0, 85.0)

    @Test
    fun startsWithThePriorInEveryCell() {
        val map = FieldMap(grid, prior)
        for (cell in 0 until grid.size) {
            assertEquals(80.0, map.value(cell), 0.0)
            assertEquals(75.0, map.lower(cell), 0.0)
            assertEquals(85.0, map.upper(cell), 0.0)
            assertEquals(0, map.visits(cell) + map.readings(cell) + map.conflicts(cell))
        }
        assertEquals(0L, map.outside + map.rejected)
    }

    @Test
    fun keepsEachNumberOfEachCellApart() {
        val map = FieldMap(grid, prior)
        for (cell in 0 until grid.size) fill(map, cell)
        for (cell in 0 until grid.size) {
            assertEquals(100.0 + cell, map.value(cell), 0.0)
            assertEquals(200.0 + cell, map.lower(cell), 0.0)
            // Bounds may cross.
            assertEquals(-300.0 - cell, map.upper(cell), 0.0)
            assertEquals(cell, map.visits(cell))
            assertEquals(2 * cell, map.readings(cell))
            assertEquals(3 * cell, map.conflicts(cell))
        }
    }

    @Test
    fun knowsHowFarItsBoundsHaveNarrowedAndWhatWasMeasured() {
        val map = FieldMap(grid, Interval(0.0, 20.0))
        assertEquals(null, map.measuredRange())
        assertTrue(map.isUnknown(0))
        assertEquals(0.0, map.certainty(0))
        map.setBounds(0, 4.0, 9.0)
        assertEquals(0.75, map.certainty(0))
        assertFalse(map.isUnknown(0), "its neighbours may have told of it")
        for ((cell, value) in listOf(1 to 7.0, 2 to 5.0, 3 to Double.NaN)) {
            map.setValue(cell, value)
            map.countReading(cell)
        }
        assertFalse(map.isUnknown(1))
        assertEquals(Interval(5.0, 7.0), map.measuredRange(), "what was not measured counts for nothing")
    }

    @Test
    fun countsWhatHasNoCell() {
        val map = FieldMap(grid, prior)
        repeat(3) { map.countOutside() }
        repeat(2) { map.countRejected() }
        assertEquals(3L, map.outside)
        assertEquals(2L, map.rejected)
    }

    @Test
    fun aCopyHasAllAndStandsOnItsOwn() {
        val map = FieldMap(grid, prior)
        for (cell in 0 until grid.size) fill(map, cell)
        map.countOutside()
        repeat(2) { map.countRejected() }
        val copy = map.copy()
        assertSame(grid, copy.grid)
        assertSame(prior, copy.prior)
        val before = content(map)
        assertEquals(before, content(copy))
        for (cell in 0 until grid.size) {
            fill(map, grid.size - 1 - cell)
        }
        map.countOutside()
        map.countRejected()
        assertEquals(before, content(copy))
    }

    @Test
    fun countsAreClearedAndAdded() {
        val map = FieldMap(grid, prior)
        for (cell in 0 until grid.size) fill(map, cell)
        map.countOutside()
        map.countRejected()
        val sum = FieldMap(grid, prior)
        repeat(2) { sum.addCounts(map) }
        for (cell in 0 until grid.size) {
            assertEquals(
                listOf(2 * cell, 4 * cell, 6 * cell),
                listOf(sum.visits(cell), sum.readings(cell), sum.conflicts(cell)),
            )
            assertEquals(80.0, sum.value(cell), 0.0)
        }
        assertEquals(listOf(2L, 2L), listOf(sum.outside, sum.rejected))
        sum.clearCounts()
        assertEquals(content(FieldMap(grid, prior)), content(sum))
    }

    private fun fill(map: FieldMap, cell: Int) {
        map.setValue(cell, 100.0 + cell)
        map.setBounds(cell, 200.0 + cell, -300.0 - cell)
        repeat(cell) { map.countVisit(cell) }
        repeat(2 * cell) { map.countReading(cell) }
        repeat(3 * cell) { map.countConflict(cell) }
    }

    private fun content(map: FieldMap): List<Any> = List(grid.size) {
        listOf(map.value(it), map.lower(it), map.upper(it), map.visits(it), map.readings(it), map.conflicts(it))
    } + map.outside + map.rejected
}
