package stillwater.io

import kotlinx.serialization.json.Json
import org.junit.jupiter.api.Test
import stillwater.mission.PlaceSpec
import stillwater.model.WaterArea
import java.io.Reader
import java.io.StringReader
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith
import kotlin.test.assertTrue

class BoundedLinesTest {
    /** Gives at most [most] characters at a time. */
    private class Pieces(text: String, private val most: Int) : Reader() {
        private val text = StringReader(text)

        override fun read(into: CharArray, offset: Int, length: Int) = text.read(into, offset, minOf(length, most))

        override fun close() = text.close()
    }

    private fun lines(text: String, most: Int = 1000, longest: Int = 100) =
        BoundedLines(Pieces(text, most), longest).use { it.asSequence().toList() }

    @Test
    fun shortLinesAreThoseOfAnyReader() {
        val random = Random(20_261_124)
        repeat(2000) {
            val text = String(CharArray(random.nextInt(30)) { "ab\r\n".random(random) })
            val expected = text.reader().buffered().readLines()
            for (most in listOf(1, 2, 1000)) assertEquals(expected, lines(text, most), text.replace('\r', '#'))
        }
    }

    /** A mission's log begins with the mission, on one line. */
    @Test
    fun theLargestAreaOfAMissionIsReadWhole() {
        val corner = Json.encodeToString(PlaceSpec.serializer(), PlaceSpec(-12345.678901234567, -12345.678901234567))
        val line = "$corner,".repeat(WaterArea.MAX_EDGES)
        assertTrue(line.length > 1_000_000)
        assertEquals(listOf(line), BoundedLines(StringReader(line)).use { it.asSequence().toList() })
    }

    @Test
    fun ofALongLineOnlyTheBeginIsKeptAndItIsMarked() {
        val long = "x".repeat(300_000)
        for (most in listOf(7, 10_000)) {
            assertEquals(
                listOf("a", "x".repeat(100), "x".repeat(100) + BoundedLines.MARK, "", "b"),
                lines("a\n${"x".repeat(100)}\n$long\r\n\nb", most),
            )
        }
        val none = BoundedLines(StringReader(""))
        assertFailsWith<NoSuchElementException> { none.next() }
    }
}
