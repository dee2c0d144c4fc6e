package stillwater.survey

import org.junit.jupiter.api.Test
import stillwater.field.FieldMap
import stillwater.model.Grid
import stillwater.model.Interval
import stillwater.model.Position
import stillwater.run.FilterKind
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class CellStatusTest {
    private val field = FieldMap(Grid(Position(0.0, 0.0), 7, 1, 1.0, 1.0, 0.0), Interval(0.0, 10.0)).apply {
        for (cell in 1 until 7) countVisit(cell)
        setBounds(1, 3.0, 4.0)
        setBounds(2, 4.0, 3.0)
        setBounds(3, 3.0, 10.0)
        setBounds(4, 0.0, 3.0)
        // A reading above the range, as a lower bound.
        setBounds(6, 11.0, 10.0)
        countConflict(2)
    }

    private fun statuses(kind: FilterKind) = (0 until 7).map { field.status(kind, it) }

    @Test
    fun tellsCrossedBoundsFromThoseInOrder() {
        val expected = listOf(
            CellStatus.UNVISITED,
            CellStatus.BOTH,
            CellStatus.CROSSED,
            CellStatus.ONE_SIDED,
            CellStatus.ONE_SIDED,
            CellStatus.NONE,
            CellStatus.CROSSED,
        )
        assertEquals(expected, statuses(FilterKind.BOUNDED))
        val counts = BoundCounts(6, both = 1, crossed = 2, oneSided = 2, measured = 0, none = 1, 1)
        assertEquals(counts, BoundCounts.of(field, FilterKind.BOUNDED))
    }

    @Test
    fun countsOfAFilterWithValuesOfItsOwnAreThoseOfItsCells() {
        for (kind in FilterKind.entries.filter { it.givesBounds }) {
            val counts = BoundCounts.of(field, kind)
            assertEquals(statuses(kind).count { it == CellStatus.MEASURED }, counts.measured, kind.label)
            assertEquals(statuses(kind).count { it == CellStatus.NONE }, counts.none, kind.label)
        }
    }

    @Test
    fun anAverageIsMeasuredWhereTheBoatWas() {
        val expected = listOf(CellStatus.UNVISITED) + List(6) { CellStatus.MEASURED }
        assertEquals(expected, statuses(FilterKind.AVERAGING))
    }

    @Test
    fun whatIsNotMeasuredHasNoValue() {
        assertTrue(field.measuredValue(FilterKind.BOUNDED, 0).isNaN())
        assertTrue(field.measuredValue(FilterKind.BOUNDED, 5).isNaN())
        assertTrue(field.measuredValue(FilterKind.AVERAGING, 0).isNaN())
        assertTrue(field.measuredValue(FilterKind.BOUNDED, 3).isFinite())
    }
}
