package stillwater.estimate

import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertFalse
import kotlin.test.assertTrue

class PartsTest {
    private val parts = Parts()
    private val done = mutableListOf<Int>()

    /** Ten pieces of work of 3 each. */
    private fun begin() = parts.begin {
        for (piece in 0 until 10) {
            done += piece
            parts.spend(3.0)
        }
    }

    @Test
    fun restsWhereItsPartIsUsedUpAndGoesOnFromThere() {
        begin()
        assertTrue(parts.isBusy && done.isEmpty())
        val counts = generateSequence { parts.go(7.0).let { done.size } }.takeWhile { parts.isBusy }.toList()
        assertEquals(listOf(3, 6, 9), counts)
        assertEquals((0 until 10).toList(), done)
        assertFalse(parts.isBusy)
        parts.go(7.0)
        assertEquals(10, done.size)
    }

    @Test
    fun withoutEndItIsDoneAtOnce() {
        begin()
        parts.go(Double.POSITIVE_INFINITY)
        assertFalse(parts.isBusy)
        assertEquals(10, done.size)
    }

    @Test
    fun oneAtATime() {
        begin()
        assertFailsWith<IllegalStateException> { begin() }
    }

    @Test
    fun whatItThrowsIsThrownAtWhoGoesOnWithIt() {
        parts.begin {
            parts.spend(1.0)
            throw ArithmeticException("of the task")
        }
        parts.go(1.0)
        assertEquals("of the task", assertFailsWith<ArithmeticException> { parts.go(1.0) }.message)
        assertFalse(parts.isBusy)
    }
}
