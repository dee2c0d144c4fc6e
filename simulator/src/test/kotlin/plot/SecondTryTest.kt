package stillwater.plot

import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith

/** A figure that failed by chance is drawn all the same; one that cannot be drawn says why. */
class SecondTryTest {
    private var tries = 0

    @Test
    fun whatFailsOnceIsDrawn() {
        val drawn = SecondTry.of { if (tries++ == 0) throw NullPointerException("by chance") else "drawn" }
        assertEquals("drawn", drawn)
        assertEquals(2, tries)
    }

    @Test
    fun whatFailsTwiceFailsAsAtFirst() {
        val thrown = assertFailsWith<IllegalArgumentException> {
            SecondTry.of<String> { throw IllegalArgumentException("try ${tries++}") }
        }
        assertEquals("try 0", thrown.message)
        assertEquals(listOf("try 1"), thrown.suppressedExceptions.map { it.message })
        assertEquals(2, tries)
    }
}
