package stillwater.io

import stillwater.model.Conditions
import kotlin.test.Test
import kotlin.test.assertContains
import kotlin.test.assertEquals
import kotlin.test.assertNull

class FarFixesTest {
    private val used = ArrayList<Long>()
    private val fixes = FarFixes { used += it.line }

    private fun take(xs: List<Double>) {
        xs.forEachIndexed { i, x -> fixes.take(TimedRow(i + 2L, i.toDouble(), x, 0.0, 8.0, Conditions.NONE)) }
        fixes.end()
    }

    @Test
    fun aFixFarOffAndBackIsLeftOutAndNamed() {
        take(listOf(0.0, 1.0, 189_000.0, 3.0, 4.0, -5_000.0, 6.0))
        assertEquals(listOf(2L, 3L, 5L, 6L, 8L), used)
        assertEquals(2, fixes.count)
        assertContains(fixes.note.orEmpty(), "line 4: a single fix 189 km off")
    }

    /** A log that goes on elsewhere, a boat on a trailer, a receiver that is off by some metres. */
    @Test
    fun whatDoesNotComeBackOrIsNearStays() {
        take(listOf(0.0, 1.0, 5_000.0, 5_001.0, 5_002.0, 5_300.0, 5_003.0, 9_000.0))
        assertEquals(8, used.size)
        assertNull(fixes.note)
    }
}
