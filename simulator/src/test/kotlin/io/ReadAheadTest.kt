package stillwater.io

import org.junit.jupiter.api.Test
import java.io.IOException
import java.io.InterruptedIOException
import java.io.Reader
import java.io.StringReader
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class ReadAheadTest {
    /** [length] characters in uneven pieces, then the end or a failing disk. */
    private class Source(length: Int, private val fails: Boolean = false) : Reader() {
        private val random = Random(length)
        val content = String(CharArray(length) { 'a' + it % 26 })
        private val text = StringReader(content)

        @Volatile
        var isClosed = false

        override fun read(into: CharArray, offset: Int, length: Int): Int {
            val count = text.read(into, offset, 1 + random.nextInt(length))
            if (count < 0 && fails) throw IOException("the disk is gone")
            return count
        }

        override fun close() {
            isClosed = true
        }
    }

    @Test
    fun theTextIsTheSourcesHoweverMuchIsAskedForAtATime() {
        for (length in listOf(0, 1, 65_536, 1_000_000)) {
            for (most in listOf(1_000, 100_000)) {
                val source = Source(length)
                val text = StringBuilder()
                ReadAhead(source).use { ahead ->
                    val buffer = CharArray(most)
                    while (true) {
                        val count = ahead.read(buffer)
                        if (count < 0) break
                        text.appendRange(buffer, 0, count)
                    }
                    assertEquals(-1, ahead.read(buffer), "the end stays the end")
                }
                assertEquals(source.content, text.toString(), "$length characters, $most at a time")
                assertTrue(source.isClosed)
            }
        }
    }

    @Test
    fun aFailingDiskIsToldAfterWhatWasRead() {
        val source = Source(100_000, fails = true)
        ReadAhead(source).use { ahead ->
            val text = CharArray(100_000)
            var at = 0
            while (at < text.size) at += ahead.read(text, at, text.size - at)
            assertEquals(source.content, String(text))
            repeat(2) { assertEquals("the disk is gone", assertFailsWith<IOException> { ahead.read() }.message) }
        }
        assertTrue(source.isClosed)
    }

    @Test
    fun aReaderThatIsInterruptedHasWhatIsThereAndThenAnIOException() {
        ReadAhead(Source(1_000_000)).use { ahead ->
            ahead.read()
            Thread.currentThread().interrupt()
            try {
                assertTrue(ahead.read(CharArray(100_000)) > 0)
                assertFailsWith<InterruptedIOException> { ahead.read() }
            } finally {
                assertTrue(Thread.interrupted())
            }
        }
    }

    @Test
    fun closingBeforeTheEndClosesTheSource() {
        val source = Source(10_000_000)
        ReadAhead(source).use { assertEquals('a'.code, it.read()) }
        assertTrue(source.isClosed)
    }
}
