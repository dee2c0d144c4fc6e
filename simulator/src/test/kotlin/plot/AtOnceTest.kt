package stillwater.plot

import java.util.concurrent.CountDownLatch
import java.util.concurrent.TimeUnit
import java.util.concurrent.atomic.AtomicInteger
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith

class AtOnceTest {
    @Test
    fun doesAll() {
        val done = AtomicInteger()
        atOnce(List(100) { { done.addAndGet(it) } })
        assertEquals(4950, done.get())
    }

    /** With one core the first task is done before the second fails; with more both run. */
    @Test
    fun throwsWhenNoTaskRunsAnyMore() {
        val running = AtomicInteger()
        val failed = CountDownLatch(1)
        val slow = {
            running.incrementAndGet()
            failed.await(100, TimeUnit.MILLISECONDS)
            Thread.sleep(100)
            running.decrementAndGet()
            Unit
        }
        val failing = {
            failed.countDown()
            error("no room on the disk")
        }
        val thrown = assertFailsWith<IllegalStateException> { atOnce(listOf(slow, failing)) }
        assertEquals(0, running.get())
        assertEquals("no room on the disk", thrown.message)
    }

    @Test
    fun whatOthersThrowIsSuppressed() {
        val begun = CountDownLatch(2)
        fun failing(name: String): () -> Unit = {
            begun.countDown()
            // Both fail, unless there is one core only.
            begun.await(1, TimeUnit.SECONDS)
            error(name)
        }
        val thrown = assertFailsWith<IllegalStateException> { atOnce(listOf(failing("first"), failing("second"))) }
        assertEquals("first", thrown.message)
        val others = if (begun.count == 0L) listOf("second") else emptyList()
        assertEquals(others, thrown.suppressed.map { it.message })
    }
}
