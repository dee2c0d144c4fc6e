package stillwater.plot

import java.math.BigDecimal
import kotlin.math.abs
import kotlin.math.floor
import kotlin.math.log10
import kotlin.math.pow

/** Where an axis is marked, and with which words. */
internal object Ticks {
    private val mantissas = listOf(
        doubleArrayOf(1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0),
        doubleArrayOf(1.0, 2.0, 3.0, 5.0),
        doubleArrayOf(1.0, 2.0, 5.0),
        doubleArrayOf(1.0, 3.0),
        doubleArrayOf(1.0),
    )
    private const val MOST = 9

    /** Round numbers on a logarithmic axis from [from] to [to] (both positive), and their labels. */
    fun log(from: Double, to: Double): Pair<List<Double>, List<String>> {
        val first = floor(log10(from)).toInt()
        val last = floor(log10(to)).toInt()
        val candidates = mantissas.map { digits ->
            (first..last).flatMap { power -> digits.map { it * TEN.pow(power) } }
                .filter { it >= from * (1 - ROUNDING) && it <= to * (1 + ROUNDING) }
        }
        val marks = candidates.firstOrNull { it.size <= MOST } ?: candidates.last().let { powers ->
            powers.filterIndexed { index, _ -> index % (powers.size / MOST + 1) == 0 }
        }
        val chosen = marks.ifEmpty { listOf(from) }
        return chosen to chosen.map(::label)
    }

    /** The library's number format for a linear axis from [from] to [to]. */
    fun format(from: Double, to: Double): String? {
        val largest = maxOf(abs(from), abs(to))
        return if (largest >= LARGE || (largest > 0 && largest < SMALL)) ".3~e" else null
    }

    private fun label(value: Double): String =
        if (value >= LARGE || value < SMALL) {
            val power = floor(log10(value) + ROUNDING).toInt()
            val digits = plain(value / TEN.pow(power))
            "${digits}e$power"
        } else {
            plain(value)
        }

    private fun plain(value: Double) =
        BigDecimal(value).round(java.math.MathContext(DIGITS)).stripTrailingZeros().toPlainString()

    private const val TEN = 10.0
    private const val ROUNDING = 1e-9
    private const val LARGE = 1e6
    private const val SMALL = 1e-4
    private const val DIGITS = 4
}
