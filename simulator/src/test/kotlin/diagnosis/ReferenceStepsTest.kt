package stillwater.diagnosis

import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class ReferenceStepsTest {
    /** A log of a row a second, of which those have a reference that [isKnown]. */
    private fun steps(isKnown: (Int) -> Boolean) =
        ReferenceSteps().also { steps -> repeat(ROWS) { steps.add(it.toDouble(), isKnown(it)) } }

    @Test
    fun aReferenceThatComesWithEveryFourthReadingIsSparse() {
        val steps = steps { it % 4 == 0 }
        assertTrue(steps.isSparse)
        assertEquals(ROWS * 3 / 4, steps.missing)
    }

    @Test
    fun aRowMissingHereAndThereDoesNotMakeAReferenceSparse() {
        val steps = steps { it % 20 != 7 }
        assertFalse(steps.isSparse)
        assertEquals(ROWS / 20, steps.missing)
    }

    @Test
    fun aReferenceThatStopsHalfWayIsNotSparse() {
        assertFalse(steps { it < ROWS / 2 }.isSparse)
        assertFalse(steps { true }.isSparse)
        assertFalse(steps { false }.isSparse)
    }

    private companion object {
        const val ROWS = 200
    }
}
