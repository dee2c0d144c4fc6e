package stillwater.io

import stillwater.model.Conditions
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertNull
import kotlin.test.assertTrue

class FarFixesTest {
    private val used = ArrayList<Long>()
    private val fixes = FarFixes { used += it.line }

    private fun take(xs: List<Double>) {
        xs.forEachIndexed { i, x -> fixes.take(row(i, x)) }
        fixes.end()
    }

    private fun row(i: Int, x: Double) = TimedRow(i + 2L, i.toDouble(), x, 0.0, 8.0, Conditions.NONE)

    @Test
    fun aFixFarOffAndBackIsLeftOutAndNamed() {
        take(listOf(0.0, 1.0, 189_000.0, 3.0, 4.0, -5_000.0, 6.0))
        assertEquals(listOf(2L, 3L, 5L, 6L, 8L), used)
        assertEquals(2, fixes.count)
        assertContains(fixes.note.orEmpty(), "line 4: a single fix 189 km off")
    }

    /** The commonest wild fix of all is a receiver's first. */
    @Test
    fun wildFixesAtTheEndsAreLeftOutAndNamed() {
        val way = List(12) { it.toDouble() }
        take(listOf(80_000.0, 80_001.0) + way + listOf(-7_000.0))
        assertEquals((4L..15L).toList(), used)
        assertEquals(3, fixes.count)
        assertContains(
            fixes.note.orEmpty(),
            "line 2: 2 fixes 80 km off the rows after, the first of 3 such rows: left out",
        )
    }

    @Test
    fun wildFixesNeedNotBeAtOnePlace() {
        val way = List(12) { it.toDouble() }
        take(way + listOf(300_000.0, -300_000.0, 500_000.0) + way)
        assertEquals((2L..13L) + (17L..28L), used)
        used.clear()
        val early = FarFixes { used += it.line }
        (listOf(500_000.0, 300_000.0, 100_000.0) + way).forEachIndexed { i, x -> early.take(row(i, x)) }
        early.end()
        assertEquals((5L..16L).toList(), used)
    }

    /** Two wild fixes at one place, with two good ones between them, are not the place where the boat is. */
    @Test
    fun whereTheLogIsTellMostOfItsRows() {
        val way = List(12) { it.toDouble() }
        take(listOf(500_000.0) + way.take(2) + 500_000.0 + way)
        assertTrue(used.containsAll((3L..4L) + (6L..17L)), "$used")
    }

    @Test
    fun threeInARowAreLeftOutAndFourAreAPlace() {
        val way = List(12) { it.toDouble() }
        take(way + List(3) { 40_000.0 + it } + way)
        assertEquals(24, used.size)
        used.clear()
        val other = FarFixes { used += it.line }
        (way + List(4) { 40_000.0 + it } + way).forEachIndexed { i, x ->
            other.take(row(i, x))
        }
        other.end()
        assertEquals((2L..29L).toList(), used)
    }

    /** A log that goes on elsewhere, a boat on a trailer, a receiver that is off by some metres. */
    @Test
    fun whatDoesNotComeBackOrIsNearStays() {
        take(listOf(0.0, 1.0, 5_000.0, 5_001.0, 5_002.0, 5_300.0, 5_003.0, 9_000.0))
        assertEquals(8, used.size)
        assertNull(fixes.note)
    }
}
