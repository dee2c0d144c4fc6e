package stillwater.plot

import org.junit.jupiter.api.Test
import java.math.BigDecimal
import java.math.RoundingMode
import kotlin.random.Random
import kotlin.test.assertEquals

class CompactSvgTest {
    /** Decimal arithmetic is the oracle: binary fractions would round some halves the other way. */
    private fun rounded(number: String) =
        BigDecimal(number).setScale(2, RoundingMode.HALF_EVEN).stripTrailingZeros().toPlainString()

    private fun compacted(number: String) = CompactSvg(" x=\"$number\"", emptyMap()).text()

    @Test
    fun numbersKeepTwoDecimalsRoundedHalfToEven() {
        val odd = listOf("0.0", "-0.0", "-0.004", "-0.005", "0.005", "0.015", "0.025000", "0.0250001", "9.995", "99.999")
        val long = listOf("1234567890123456.789", "0.12345678901234567", "1.0E-5", "-1.25E10", "1.5E3", "12.5")
        for (number in odd + long) assertEquals(" x=\"${rounded(number)}\"", compacted(number), number)
        val random = Random(SEED)
        repeat(RANDOM_NUMBERS) {
            val digits = List(random.nextInt(1, 12)) { random.nextInt(10) }.joinToString("")
            val sign = if (random.nextBoolean()) "-" else ""
            val number = "$sign${random.nextInt(1000)}.$digits"
            assertEquals(" x=\"${rounded(number)}\"", compacted(number), "$number, seed $SEED")
        }
    }

    private companion object {
        const val SEED = 7
        const val RANDOM_NUMBERS = 2000
    }
}
