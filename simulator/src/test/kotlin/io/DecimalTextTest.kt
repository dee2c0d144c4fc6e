package stillwater.io

import org.junit.jupiter.api.Test
import kotlin.random.Random
import kotlin.test.assertEquals
import kotlin.test.assertTrue

class DecimalTextTest {
    @Test
    fun readsEveryNumberAsTheStandardLibraryDoes() {
        val random = Random(SEED)
        repeat(200_000) {
            val text = when (it % 4) {
                0 -> Double.fromBits(random.nextLong()).let { number -> if (number.isFinite()) "$number" else "0" }
                1 -> "${random.nextInt(-99_999, 99_999)}.${random.nextInt(0, 9_999_999)}"
                2 -> "${random.nextLong()}e${random.nextInt(-340, 310)}"
                else -> "+.${random.nextLong(0, Long.MAX_VALUE)}E-${random.nextInt(0, 30)}"
            }
            assertEquals(text.toDouble(), DecimalText.parse(text), "seed $SEED: $text")
        }
    }

    @Test
    fun keepsTheSignOfZeroAndBlanksAround() {
        assertEquals("-0.0", DecimalText.parse(" -0 ").toString())
        assertEquals(1.5, DecimalText.parse("\t1.5 "))
    }

    @Test
    fun findsNoNumberInOtherTexts() {
        val others = listOf("", " ", "-", "+", ".", "e5", "1e", "1e+", "1e5x", "1.2.3", "1,5", "NaN", "inf", "0x10")
        for (text in others + listOf("1f", "1d", "Infinity", "1 2", "--1", "١٢", "1\u0000", "\u00001")) {
            assertTrue(DecimalText.parse(text).isNaN(), text)
        }
    }

    private companion object {
        const val SEED = 11
    }
}
