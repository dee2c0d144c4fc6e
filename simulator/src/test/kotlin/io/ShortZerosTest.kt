package stillwater.io

import org.junit.jupiter.api.Test
import java.io.Reader
import java.io.StringReader
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class ShortZerosTest {
    /** At most [most] characters at a time, as a decoder hands them out. */
    private class Piecewise(private val text: Reader, private val most: Int) : Reader() {
        override fun read(buffer: CharArray, offset: Int, length: Int) = text.read(buffer, offset, minOf(length, most))

        override fun close() = text.close()
    }

    private fun short(text: String, most: Int) = ShortZeros(Piecewise(StringReader(text), most)).use { it.readText() }

    private fun zeros(count: Int) = "\u0000".repeat(count)

    @Test
    fun textAndShortRunsStayAsTheyAre() {
        val text = "a,b\n1,2\n" + zeros(ShortZeros.MOST) + "3,4\n" + zeros(7) + "\n" + zeros(1)
        for (most in listOf(3, 1000, 8192)) assertEquals(text, short(text, most))
    }

    @Test
    fun longRunsStayLongerThanTheMostAndEndWhereTheyDid() {
        val long = zeros(4 * ShortZeros.MOST)
        for (most in listOf(7, 1000, 8192)) {
            val left = short("head\n8" + long + "9\nrow\n" + long, most)
            val runs = left.split("9\nrow\n")
            assertEquals("head\n8", runs[0].trimEnd('\u0000'))
            for (run in runs) {
                val count = run.count { it == '\u0000' }
                // What is left of the first and the last buffer of the run comes on top.
                assertTrue(count > ShortZeros.MOST && count <= ShortZeros.MOST + 3 * most, "$count by $most")
            }
        }
    }
}
