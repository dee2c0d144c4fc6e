package stillwater.wire

import org.junit.jupiter.api.Test
import kotlin.random.Random
import kotlin.test.assertEquals

class LineFramerTest {
    private val lines = mutableListOf<String>()
    private val framer = LineFramer(
        { bytes, start, end -> lines += String(bytes, start, end - start, Charsets.ISO_8859_1) },
        longest = 20,
    )

    private fun feed(text: String) = framer.accept(text.toByteArray(Charsets.ISO_8859_1))

    @Test
    fun linesEndInEitherMarkOrBoth() {
        feed("a\rb\nc\r\n\n\r\nd")
        assertEquals(listOf("a", "b", "c"), lines)
        feed("e\n")
        assertEquals("de", lines.last())
    }

    @Test
    fun anyCutGivesTheSameLines() {
        val text =
            "first\r\n\u0000\u00ffbinary\n" + "x".repeat(21) + "\nexactly twenty bytes\r" + "y".repeat(99) + "\nend\n"
        feed(text)
        val whole = lines.toList()
        val random = Random(5)
        repeat(200) {
            lines.clear()
            val pieces = LineFramer({ b, s, e -> lines += String(b, s, e - s, Charsets.ISO_8859_1) }, longest = 20)
            val bytes = text.toByteArray(Charsets.ISO_8859_1)
            var at = 0
            while (at < bytes.size) {
                val length = random.nextInt(1, 9).coerceAtMost(bytes.size - at)
                pieces.accept(bytes, at, length)
                at += length
            }
            assertEquals(whole, lines)
            assertEquals(2, pieces.oversized)
            assertEquals(bytes.size.toLong(), pieces.bytesTaken)
        }
        assertEquals(listOf("first", "\u0000\u00ffbinary", "exactly twenty bytes", "end"), whole)
    }

    @Test
    fun aResetForgetsTheBegunLine() {
        feed("begun")
        framer.reset()
        feed("new\n")
        assertEquals(listOf("new"), lines)
    }
}
