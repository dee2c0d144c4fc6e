package stillwater.report

import java.io.ByteArrayOutputStream
import java.util.Locale
import kotlin.math.abs
import kotlin.random.Random
import kotlin.test.Test
import kotlin.test.assertEquals
import kotlin.test.assertFailsWith

class CsvTableTest {
    private fun csv(vararg header: String, rows: CsvTable.() -> Unit): String =
        ByteArrayOutputStream().also { out -> CsvTable(out, header.toList()).use(rows) }.toString(Charsets.UTF_8)

    @Test
    fun fieldsAreQuotedOnlyWhereNeeded() {
        val text = csv("name", "note") {
            row("plain", "a,b")
            row("quote \" inside", "two\nlines")
        }
        assertEquals("name,note\nplain,\"a,b\"\n\"quote \"\" inside\",\"two\nlines\"\n", text)
    }

    @Test
    fun missingValuesAreEmptyAndNumbersAreTheSameInEveryLocale() {
        val before = Locale.getDefault()
        try {
            Locale.setDefault(Locale.GERMANY)
            assertEquals("a,b,c,d\n0.1,,,7\n", csv("a", "b", "c", "d") { row(0.1, Double.NaN, null, 7L) })
        } finally {
            Locale.setDefault(before)
        }
    }

    @Test
    fun aRowOfTheWrongLengthIsRefused() {
        csv("a", "b") { assertFailsWith<IllegalArgumentException> { row(1) } }
        assertFailsWith<IllegalArgumentException> { CsvTable(ByteArrayOutputStream(), emptyList()) }
    }

    @Test
    fun numbersReadBackTheSame() {
        val random = Random(5)
        val values = listOf(0.1 + 0.2, 1e15, 2e23, Double.MIN_VALUE, Double.MAX_VALUE, Double.NEGATIVE_INFINITY) +
            List(2000) { Double.fromBits(random.nextLong()) }.filter { it.isFinite() } +
            List(2000) { random.nextDouble() }
        val text = csv("a") { values.forEach { row(it) } }
        assertEquals(values, text.lines().drop(1).dropLast(1).map { it.toDouble() })
    }

    @Test
    fun significantDigitsAreKeptWhateverTheSize() {
        val three = SignificantDigits(3)
        val known = mapOf(
            0.0 to "0", 1.0 to "1.00", -0.0396 to "-0.0396", 0.17012 to "0.170", 9.999 to "10.0", 99.96 to "100",
            123456.789 to "123457", 1.2e-7 to "1.20e-7", 9.9999e9 to "1.00e10", Double.NaN to "–",
            Double.NEGATIVE_INFINITY to "−∞",
        )
        for ((value, text) in known) assertEquals(text, three.format(value), "$value")
        assertEquals("0.2", SignificantDigits(1).format(0.15 + abs(-1e-9)))
        assertFailsWith<IllegalArgumentException> { SignificantDigits(0) }
    }
}
